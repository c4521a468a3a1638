/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/early_contact.h>
#include <isochor/equations/final_state.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::max();

    /** The gaps between the body and the nodes that walls hold. */
    template <int dim>
    class Gaps
    {
    public:
      using Node = typename WallContacts<dim>::Node;

      Gaps(const StepContext<dim>               &step,
           const NodalField                     &unknowns,
           const std::vector<WallContacts<dim>> &walls)
        : step(step)
        , geometry(step.grid.geometry())
        , nodal(step, unknowns)
      {
        for (const auto &wall : walls)
          for (const Node &node : wall.nodes)
            nodes.push_back(node);
        gap.assign(nodes.size(), unknown);
        cell_sizes.assign(nodes.size(), unknown);
        chain();
        find_places();
        for (unsigned int k = 0; k < step.points.cell.size(); ++k)
          for (unsigned int q = step.points.cell_start[k];
               q < step.points.cell_start[k + 1];
               ++q)
            look_at_point(k, q);
        const MPI_Comm comm = step.grid.communicator();
        Utilities::MPI::min(gap, comm, gap);
        Utilities::MPI::min(cell_sizes, comm, cell_sizes);
        finish();
      }

      /** By nodes of all walls one after the other: the gap (m), 0 if there is
       * none or nothing is known, and the size of a cell there (m). */
      std::vector<double> gap, cell_sizes;

    private:
      static constexpr unsigned int none = numbers::invalid_unsigned_int;

      /** By vertex the nodes there: there may be several, with other normals.
       */
      void
      chain()
      {
        first.assign(step.grid.triangulation().n_vertices(), none);
        next.assign(nodes.size(), none);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            next[i]                = first[nodes[i].vertex];
            first[nodes[i].vertex] = i;
          }
      }

      /** Where the nodes are at the start of the step: on a grid that is kept
       * those know that have a cell with points there. */
      void
      find_places()
      {
        for (const Node &node : nodes)
          place.push_back(geometry.vertices()[node.vertex]);
        if (!step.grid_is_kept)
          return;
        std::vector<double> x(dim * nodes.size(), -unknown);
        for (unsigned int k = 0; k < step.points.cell.size(); ++k)
          for (unsigned int v = 0; v <= dim; ++v)
            for (unsigned int i =
                   first[geometry.vertex_indices(step.points.cell[k])[v]];
                 i != none;
                 i = next[i])
              for (unsigned int a = 0; a < dim; ++a)
                x[dim * i + a] = step.points.corner(geometry, k, v)[a];
        Utilities::MPI::max(x, step.grid.communicator(), x);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int a = 0; a < dim; ++a)
            place[i][a] = x[dim * i + a];
      }

      void
      look_at_point(const unsigned int k, const unsigned int q)
      {
        const PointArrays<dim> &points  = step.points;
        const auto              stencil = points.stencil(geometry, k, q);
        bool                    is_near = false;
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          is_near = is_near || first[stencil.vertex[I]] != none;
        if (!is_near)
          return;
        const Point<dim> x = points.location(geometry, k, q);
        if (k < points.n_occupied_cells && !points.domain.empty())
          for (const Tensor<1, dim> &r : points.domain[q])
            look_at_place(k, stencil, x, points.F[q] * r, 0. * points.F[q]);
        else
          {
            // massless points have no volume but that which they integrate
            const double V = (k < points.n_occupied_cells ? points.volume[q] :
                                                            points.weight[q]);
            const double radius = 0.75 * std::pow(V, 1. / dim);
            look_at_place(
              k, stencil, x, Tensor<1, dim>(), radius * points.F[q]);
          }
      }

      /** Let the nodes of the @p stencil of a point at @p x know of the place
       * x + @p r, with the sphere of unit radius that @p extent makes an
       * ellipsoid around it. */
      void
      look_at_place(const unsigned int                        k,
                    const typename PointArrays<dim>::Stencil &stencil,
                    const Point<dim>                         &x,
                    const Tensor<1, dim>                     &r,
                    const Tensor<2, dim>                     &extent)
      {
        constexpr double    no_support = 1e-6;
        const bool          is_exact   = !step.points.displacement.empty();
        const unsigned int *vertex     = stencil.vertex;
        const auto          N          = [&](const unsigned int I) {
          return stencil.shape[I] + stencil.gradient[I] * r;
        };
        Point<dim> at = x + r;
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          at += N(I) * nodal.increment(vertex[I]);
        const double size = cell_size(geometry, step.points.cell[k]);
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          if (!is_exact || N(I) > no_support)
            for (unsigned int i = first[vertex[I]]; i != none; i = next[i])
              {
                const Tensor<1, dim> &n = nodes[i].normal;
                const double          distance =
                  n * (at - place[i] - nodal.increment(vertex[I])) -
                  (transpose(extent) * n).norm();
                gap[i]        = std::min(gap[i], distance);
                cell_sizes[i] = std::min(cell_sizes[i], size);
              }
      }

      void
      finish()
      {
        // of a cell, what rounding may leave of nothing
        constexpr double rounding = 1e-6;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          if (gap[i] == unknown || place[i][0] == -unknown ||
              gap[i] < rounding * cell_sizes[i])
            gap[i] = 0;
      }

      const StepContext<dim>     &step;
      const SimplexGeometry<dim> &geometry;
      const NodalUnknowns<dim>    nodal;
      std::vector<Node>           nodes;
      std::vector<unsigned int>   first, next;
      std::vector<Point<dim>>     place;
    };



    /** Of this rank's points at the end of the step: Σ_p V_p |τ:ε|, and
     * Σ_p V_p G (J). */
    template <int dim>
    std::array<double, 2>
    deformation_work(const StepContext<dim> &step, const NodalField &unknowns)
    {
      const PointArrays<dim>         &points = step.points;
      const NodalUnknowns<dim>        nodal(step, unknowns);
      std::array<double, max_history> history;
      std::array<double, 2>           sums{};
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const auto state =
              final_state<dim>(step, nodal, points, k, q, history.data());
            const Tensor<2, dim> b       = state.F * transpose(state.F);
            const Tensor<2, dim> inverse = invert(b);
            double               work    = 0;
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                work += state.cauchy_stress[a][c] * (b[a][c] - inverse[a][c]);
            const double hoop = Utilities::fixed_power<2>(
              step.kernel.hoop_stretch(history.data()));
            work += state.cauchy_stress[2][2] * (hoop - 1 / hoop);
            sums[0] += 0.25 * points.measure(q) * state.J * std::abs(work);
            sums[1] +=
              points.measure(q) *
              step.kernel.materials[points.material[q]]->shear_modulus();
          }
      return sums;
    }



    /** What a wall does through gaps. */
    struct Through
    {
      double force = 0, ///< N, of all of its nodes that press
        early      = 0, ///< N, of those that the body has not reached
        work       = 0, ///< Σ F_I g_I
        cells      = 0; ///< Σ F_I g_I / h
    };



    template <int dim>
    void
    warn(const StepContext<dim>  &step,
         const WallContacts<dim> &wall,
         const Through           &through,
         const double             share)
    {
      step.warnings.add(
        "a wall that acts before the body reaches it",
        "At t = " + rounded(step.time) + " s " +
          rounded(100 * through.early / through.force) +
          " % of the force of the one-sided wall <" + wall.boundary + "> (<" +
          wall.parameter + ">), " + rounded(through.force) +
          " N, act at nodes of the grid that the surface of the body has not "
          "reached: in the mean of the force the body is " +
          rounded(through.work / through.force) + " m away from the wall, " +
          rounded(through.cells / through.force) +
          " cells, since a node is held as soon as a cell around it holds "
          "material. Where motions are given, forces of contact are therefore "
          "too large, by an estimated " +
          (share > 0.5 ?
             "half or more" :
             rounded(100 * share) + " to " + rounded(200 * share) + " %") +
          " by what the body is deformed by now; where forces are, it stays "
          "away from the wall by so much. That "
          "falls as the body is pressed further (column <Share of gaps in "
          "contact> of the statistics) and with the cells. Use smaller cells "
          "at the wall (<Adaptive grid/Cell size at boundaries>), put a flat "
          "side of the body on a line of the grid, or keep a grid that fits the "
          "surface of the body (<Grid reset/Steps between resets = 0>).");
    }
  } // namespace



  template <int dim>
  void
  check_early_contact(const StepContext<dim>               &step,
                      const NodalField                     &unknowns,
                      const std::vector<WallContacts<dim>> &walls,
                      Statistics                           &statistics)
  {
    // smaller strains are rounding errors of a body that is carried along
    constexpr double considerable = 0.03, no_strain = 1e-8;
    if (walls.empty())
      return;
    const MPI_Comm      comm = step.grid.communicator();
    const Gaps<dim>     gaps(step, unknowns, walls);
    std::vector<double> sums(4 * walls.size());
    unsigned int        i = 0;
    for (unsigned int w = 0; w < walls.size(); ++w)
      for (const auto &node : walls[w].nodes)
        {
          const double F = std::max(node.force, 0.), g = gaps.gap[i];
          sums[4 * w] += F;
          sums[4 * w + 1] += (g > 0 ? F : 0.);
          sums[4 * w + 2] += F * g;
          sums[4 * w + 3] += (g > 0 ? F * g / gaps.cell_sizes[i] : 0.);
          ++i;
        }
    Utilities::MPI::sum(sums, comm, sums);
    double       work = 0;
    unsigned int most = 0;
    for (unsigned int w = 0; w < walls.size(); ++w)
      {
        work += sums[4 * w + 2];
        if (sums[4 * w + 2] > sums[4 * most + 2])
          most = w;
      }
    double share = 0;
    if (work > 0)
      {
        std::array<double, 2> of_body = deformation_work(step, unknowns);
        sum_over_ranks(of_body, comm);
        if (of_body[0] > no_strain * no_strain * of_body[1])
          share = work / of_body[0];
      }
    statistics.set("Share of gaps in contact", share);
    if (share > considerable)
      warn(step,
           walls[most],
           {sums[4 * most],
            sums[4 * most + 1],
            sums[4 * most + 2],
            sums[4 * most + 3]},
           share);
  }



  template void
  check_early_contact(const StepContext<2> &,
                      const NodalField &,
                      const std::vector<WallContacts<2>> &,
                      Statistics &);
  template void
  check_early_contact(const StepContext<3> &,
                      const NodalField &,
                      const std::vector<WallContacts<3>> &,
                      Statistics &);
} // namespace isochor
