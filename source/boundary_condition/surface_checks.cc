/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/condition.h>
#include <isochor/base/expression.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/surface_checks.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  warn_of_uncovered_faces(const StepContext<dim>       &step,
                          const SurfaceConditions<dim> &conditions,
                          const std::vector<double>    &covered_area,
                          const std::vector<double>    &candidate_area,
                          const std::string            &mesh_parameter)
  {
    const std::string unit = dim == 2 ? " m" : " m^2";
    for (unsigned int s = 0; s < covered_area.size(); ++s)
      {
        const SurfaceCondition<dim> &surface = conditions.surfaces[s];
        const SurfaceRegion<dim>    &place   = surface.place;
        const double share = covered_area[s] / candidate_area[s];
        if (place.on_grid_boundary || share > 0.99)
          continue;
        step.warnings.add(
          "surface in part off the body",
          "The body covers only " + rounded(100 * share) +
            " % of the faces of cells that the surface <" + place.name +
            "> of <" + place.parameter + "> consists of, " +
            rounded(covered_area[s]) + " of " + rounded(candidate_area[s]) +
            unit + ". " +
            "Its load acts on this part, and is too small by the rest, if "
            "all of these faces are meant: smaller cells do not cure that, "
            "as steps of cells along an inclined or curved surface stay "
            "steps. If the body's surface does not lie on faces of the grid there, "
            "give the body's mesh in <Material points/Body mesh> and <" +
            mesh_parameter + ">.");
      }
  }



  template <int dim>
  void
  warn_of_loads_beside_domains(const StepContext<dim>       &step,
                               const SurfaceConditions<dim> &conditions,
                               const std::vector<double>    &share_on_domains,
                               const std::string            &mesh_parameter)
  {
    constexpr double enough = 0.95;
    for (unsigned int s = 0; s < share_on_domains.size(); ++s)
      {
        const SurfaceCondition<dim> &surface = conditions.surfaces[s];
        if (share_on_domains[s] > enough)
          continue;
        step.warnings.add(
          "a load beside the domains of the points",
          "Only " + rounded(100 * share_on_domains[s]) +
            " % of the area of the surface <" + surface.place.name + "> of <" +
            surface.place.parameter +
            "> consist of faces of the points' domains, which <Quadrature/Type> "
            "makes of the body at t = 0. Elsewhere its load is not in balance "
            "with the stress of the points below, by 5 to 20 per cent, once the "
            "surface lies inside of cells. Faces count if they are in one "
            "plane to 1e-6 of their size: if nearly none are, coordinates may "
            "be rounded in a mesh, the region or the grid. Let the surface be "
            "that of the points' domains (the mesh of <Material points/Body "
            "mesh> in <" +
            mesh_parameter +
            ">, or a <Material points/Region> that ends where cells do), or "
            "choose <Quadrature/Type = cell-filled + boundary>.");
      }
  }



  template <int dim>
  void
  warn_of_places_without_comparison(const StepContext<dim>       &step,
                                    const SurfaceConditions<dim> &conditions)
  {
    const auto is_doubtful = [&step](const SurfaceRegion<dim> &place) {
      return step.grid.boundary_names().count(place.condition) == 0 &&
             compares_nothing(place.condition);
    };
    if (std::none_of(conditions.named.begin(),
                     conditions.named.end(),
                     is_doubtful))
      return;
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    std::vector<unsigned char>  touched(geometry.vertices().size(), 0);
    for (const unsigned int cell :
         union_over_ranks(step.points.cell, step.grid.communicator()))
      for (const unsigned int vertex : geometry.vertex_indices(cell))
        touched[vertex] = 1;
    for (const SurfaceRegion<dim> &place : conditions.named)
      if (is_doubtful(place))
        {
          std::vector<double> values;
          try
            {
              const Expression<dim> formula(place.condition, place.parameter);
              for (unsigned int v = 0; v < touched.size(); ++v)
                if (touched[v])
                  values.push_back(formula(geometry.vertices()[v], 0.));
            }
          catch (const StandardExceptions::ExcMessage &)
            {
              continue; // it need have values at the surface only
            }
          warn_of_formula_for_condition(place.condition,
                                        place.parameter,
                                        values,
                                        step.warnings);
        }
  }



  template <int dim>
  void
  warn_of_doubled_loads(const StepContext<dim>       &step,
                        const SurfaceConditions<dim> &conditions,
                        const BoundaryPoints<dim>    *points)
  {
    if (points == nullptr)
      return;
    const unsigned int n = conditions.surfaces.size();
    // by surface: where its points are, and which loads act there, a bit each:
    // tractions by component, and a pressure
    using Place = std::pair<std::array<double, dim>, unsigned int>;
    std::vector<std::vector<Place>> places(n);
    for (unsigned int b = 0; b < points->size(); ++b)
      {
        const unsigned int           s       = points->surface(b);
        const SurfaceCondition<dim> &surface = conditions.surfaces[s];
        const Point<dim>             X       = points->reference_location(b);
        Place                        place{{}, 0};
        for (unsigned int a = 0; a < dim; ++a)
          place.first[a] = X[a];
        for (unsigned int a = 0; a < surface.traction.size(); ++a)
          if (surface.traction[a](X, step.time) != 0)
            place.second |= 1 << a;
        if (!surface.pressure.empty() &&
            surface.pressure.front()(X, step.time) != 0)
          place.second |= 1 << dim;
        places[s].push_back(place);
      }
    for (auto &of_surface : places)
      std::sort(of_surface.begin(), of_surface.end());
    std::vector<unsigned int> differ(n * n, 0), doubled(n * n, 0);
    for (unsigned int s = 0; s < n; ++s)
      for (unsigned int r = 0; r < s; ++r)
        {
          const bool same   = std::equal(places[s].begin(),
                                       places[s].end(),
                                       places[r].begin(),
                                       places[r].end(),
                                       [](const Place &a, const Place &b) {
                                         return a.first == b.first;
                                       });
          differ[n * s + r] = same ? 0 : 1;
          for (std::size_t i = 0; same && i < places[s].size(); ++i)
            if ((places[s][i].second & places[r][i].second) != 0)
              doubled[n * s + r] = 1;
        }
    const MPI_Comm comm = step.grid.communicator();
    Utilities::MPI::max(differ, comm, differ);
    Utilities::MPI::max(doubled, comm, doubled);
    for (unsigned int s = 0; s < n; ++s)
      for (unsigned int r = 0; r < s; ++r)
        {
          if (doubled[n * s + r] != 0 && differ[n * s + r] == 0)
            step.warnings.add(
              "loads that count twice",
              "The surfaces <" + conditions.surfaces[r].place.name + "> of <" +
                conditions.surfaces[r].place.parameter + "> and <" +
                conditions.surfaces[s].place.name + "> of <" +
                conditions.surfaces[s].place.parameter +
                "> are the same place, and each has a load of the same kind "
                "there: their sum acts. If it is meant to act once, leave one "
                "of them out, or change its place.");
        }
  }



  namespace
  {
    /** The part of the area of a surface that points away from the rest of it,
     * which is nearly flat, and lies at its rim; 0 if there is none, or if
     * such pieces lie between others, as steps do. Collective. */
    template <int dim>
    double
    part_round_an_edge(const std::vector<SurfacePiece<dim>> &pieces,
                       const MPI_Comm                        comm)
    {
      // cosines, and parts of the area and of its extent
      constexpr double nearly_flat = 0.79, away = 0.5, most = 0.2, same = 1e-6,
                       round = 0.9;
      Tensor<1, dim> sum;
      double         area = 0;
      for (const SurfacePiece<dim> &piece : pieces)
        {
          sum += piece.area * piece.n;
          area += piece.area;
        }
      sum  = Utilities::MPI::sum(sum, comm);
      area = Utilities::MPI::sum(area, comm);
      if (!(sum.norm() > nearly_flat * area))
        return 0;
      const Tensor<1, dim> normal  = sum / sum.norm();
      const auto           is_away = [&](const SurfacePiece<dim> &piece) {
        return piece.n * normal < away;
      };
      // the edge is sharp
      const bool is_rounded =
        std::any_of(pieces.begin(),
                    pieces.end(),
                    [&](const SurfacePiece<dim> &piece) {
                      return !is_away(piece) && piece.n * normal < round;
                    });
      if (Utilities::MPI::max(is_rounded ? 1 : 0, comm) == 1)
        return 0;
      // of those: place and direction along the surface
      std::vector<double> mine;
      double              of_edge = 0;
      for (const SurfacePiece<dim> &piece : pieces)
        if (is_away(piece))
          {
            Tensor<1, dim> along = piece.n - (piece.n * normal) * normal;
            along /= along.norm();
            for (unsigned int a = 0; a < dim; ++a)
              mine.push_back(piece.x[a]);
            for (unsigned int a = 0; a < dim; ++a)
              mine.push_back(along[a]);
            of_edge += piece.area;
          }
      of_edge = Utilities::MPI::sum(of_edge, comm);
      if (of_edge == 0 || of_edge > most * area)
        return 0;
      const auto   all       = Utilities::MPI::all_gather(comm, mine);
      const double length    = std::pow(area, 1. / (dim - 1));
      bool         are_steps = false;
      for (const auto &of_rank : all)
        for (std::size_t i = 0; i < of_rank.size() && !are_steps; i += 2 * dim)
          are_steps = std::any_of(
            pieces.begin(), pieces.end(), [&](const SurfacePiece<dim> &piece) {
              double beyond = 0;
              for (unsigned int a = 0; a < dim; ++a)
                beyond += (piece.x[a] - of_rank[i + a]) * of_rank[i + dim + a];
              return !is_away(piece) && beyond > same * length;
            });
      return Utilities::MPI::max(are_steps ? 1 : 0, comm) == 1 ? 0. :
                                                                 of_edge / area;
    }
  } // namespace



  template <int dim>
  void
  warn_of_faces_round_an_edge(const StepContext<dim>               &step,
                              const SurfaceRegion<dim>             &place,
                              const std::vector<SurfacePiece<dim>> &pieces)
  {
    const double part =
      part_round_an_edge<dim>(pieces, step.grid.communicator());
    if (part > 0)
      step.warnings.add(
        "a surface that goes round an edge",
        "The surface <" + place.name + "> of <" + place.parameter +
          "> is nearly flat, but " + rounded(100 * part) +
          " % of its area are faces at its rim that point elsewhere: its "
          "condition holds in the middle of the last faces of the sides beside it, "
          "too, and what acts on the surface acts there as well. If that isn't "
          "meant, let the condition begin nearer to the flat part, by less "
          "than half of a cell.");
  }



  template <int dim>
  void
  warn_of_loads_on_supports(const StepContext<dim>       &step,
                            const NodalField             &unknowns,
                            const SurfaceConditions<dim> &conditions,
                            const BoundaryPoints<dim>    &points,
                            const SurfaceForces<dim>     &forces,
                            const NodalConstraints       &constraints)
  {
    // normals of faces along an axis have some
    constexpr double nearly_all = 0.99, rounding = 1e-9;
    // by surface and component: what is on supports, and all
    std::vector<double> sums(2 * dim * conditions.surfaces.size());
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        const Tensor<1, dim> load    = forces.load(step, unknowns, b);
        const auto           stencil = points.stencil(b);
        double *const        sum     = &sums[2 * dim * points.surface(b)];
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          for (unsigned int a = 0; a < dim; ++a)
            {
              const double       part = std::abs(stencil.shape[I] * load[a]);
              const unsigned int i =
                step.nodes.node(stencil.vertex[I]) * step.n_components + a;
              if (constraints.constrained[i] == NodalConstraints::prescribed)
                sum[2 * a] += part;
              sum[2 * a + 1] += part;
            }
      }
    Utilities::MPI::sum(sums, step.grid.communicator(), sums);
    for (unsigned int s = 0; s < conditions.surfaces.size(); ++s)
      {
        double load = 0;
        for (unsigned int a = 0; a < dim; ++a)
          load += sums[2 * (dim * s + a) + 1];
        for (unsigned int a = 0; a < dim; ++a)
          if (const double *const sum = &sums[2 * (dim * s + a)];
              sum[1] > rounding * load && sum[0] > nearly_all * sum[1])
            step.warnings.add(
              "a load on a support",
              "The load on <" + conditions.surfaces[s].place.name + "> of <" +
                conditions.surfaces[s].place.parameter + "> acts in " +
                "xyz"[a] +
                " where this component is prescribed: it goes straight into "
                "the support, and the body doesn't feel it. Leave the "
                "component free there, or put the load elsewhere.");
      }
  }



  template void
  warn_of_uncovered_faces(const StepContext<2> &,
                          const SurfaceConditions<2> &,
                          const std::vector<double> &,
                          const std::vector<double> &,
                          const std::string &);
  template void
  warn_of_loads_beside_domains(const StepContext<2> &,
                               const SurfaceConditions<2> &,
                               const std::vector<double> &,
                               const std::string &);
  template void
  warn_of_uncovered_faces(const StepContext<3> &,
                          const SurfaceConditions<3> &,
                          const std::vector<double> &,
                          const std::vector<double> &,
                          const std::string &);
  template void
  warn_of_loads_beside_domains(const StepContext<3> &,
                               const SurfaceConditions<3> &,
                               const std::vector<double> &,
                               const std::string &);
  template void
  warn_of_places_without_comparison(const StepContext<2> &,
                                    const SurfaceConditions<2> &);
  template void
  warn_of_places_without_comparison(const StepContext<3> &,
                                    const SurfaceConditions<3> &);
  template void
  warn_of_doubled_loads(const StepContext<2> &,
                        const SurfaceConditions<2> &,
                        const BoundaryPoints<2> *);
  template void
  warn_of_doubled_loads(const StepContext<3> &,
                        const SurfaceConditions<3> &,
                        const BoundaryPoints<3> *);
  template void
  warn_of_faces_round_an_edge(const StepContext<2> &,
                              const SurfaceRegion<2> &,
                              const std::vector<SurfacePiece<2>> &);
  template void
  warn_of_faces_round_an_edge(const StepContext<3> &,
                              const SurfaceRegion<3> &,
                              const std::vector<SurfacePiece<3>> &);
  template void
  warn_of_loads_on_supports(const StepContext<2> &,
                            const NodalField &,
                            const SurfaceConditions<2> &,
                            const BoundaryPoints<2> &,
                            const SurfaceForces<2> &,
                            const NodalConstraints &);
  template void
  warn_of_loads_on_supports(const StepContext<3> &,
                            const NodalField &,
                            const SurfaceConditions<3> &,
                            const BoundaryPoints<3> &,
                            const SurfaceForces<3> &,
                            const NodalConstraints &);
} // namespace isochor
