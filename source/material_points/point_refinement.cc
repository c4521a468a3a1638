/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/material_points/domain_bisection.h>
#include <isochor/material_points/point_refinement.h>
#include <isochor/material_points/sparse_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochor
{
  namespace
  {
    /**
     * Where the new points of a split go, from the old one, in units of the
     * dim-th root of its volume: the corners of an equilateral triangle or
     * tetrahedron. At this distance the parts, as discs or balls around the
     * points, have the second moment of the whole: in 2D
     * 3/4 r² + V/4/(2π) = V/(2π), in 3D
     * 4/5 r² + 3/5 (V/5 3/(4π))^(2/3) = 3/5 (V 3/(4π))^(2/3).
     */
    template <int dim>
    std::array<Tensor<1, dim>, dim + 1>
    places_of_parts()
    {
      std::array<Tensor<1, dim>, dim + 1> places;
      if constexpr (dim == 2)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const double angle = numbers::PI * (0.5 + 2. / 3 * i);
            const double r     = std::sqrt(0.5 / numbers::PI);
            places[i][0]       = r * std::cos(angle);
            places[i][1]       = r * std::sin(angle);
          }
      else
        for (unsigned int i = 0; i < 4; ++i)
          {
            const double r = std::sqrt(0.75 * (1 - std::pow(5., -2. / 3))) *
                             std::cbrt(0.75 / numbers::PI) / std::sqrt(3.);
            for (unsigned int d = 0; d < 3; ++d) // every other corner of a cube
              places[i][d] = ((i ^ (i << 1)) >> d) % 2 ? r : -r;
          }
      return places;
    }

    /** Move parts at the @p shifts from @p x, in @p cell, closer to it until
     * all are in the grid: beside a wall along an axis along this axis only,
     * else in all directions, in the end to @p x itself. */
    template <int dim>
    void
    make_fit(const PointLocator<dim>             &locator,
             const unsigned int                   cell,
             const Point<dim>                    &x,
             std::array<Tensor<1, dim>, dim + 2> &shifts)
    {
      const auto fit = [&](const Tensor<1, dim> &factors) {
        return std::all_of(shifts.begin(),
                           shifts.end(),
                           [&](const auto &shift) {
                             Point<dim> place = x;
                             for (unsigned int d = 0; d < dim; ++d)
                               place[d] += factors[d] * shift[d];
                             return locator.locate(place, cell).found;
                           });
      };
      Tensor<1, dim> along; // which axes
      for (unsigned int d = 0; d < dim; ++d)
        along[d] = 1;
      Tensor<1, dim> factors = along;
      if (fit(factors))
        return;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          Tensor<1, dim> flat = factors;
          flat[axis]          = 0;
          if (!fit(flat))
            continue;
          along       = Tensor<1, dim>();
          along[axis] = 1;
          break;
        }
      constexpr unsigned int most_trials = 20;
      for (unsigned int trial = 1; trial <= most_trials && !fit(factors);
           ++trial)
        for (unsigned int d = 0; d < dim; ++d)
          if (along[d] > 0)
            factors[d] = (trial < most_trials ? 0.75 * factors[d] : 0);
      for (Tensor<1, dim> &shift : shifts)
        for (unsigned int d = 0; d < dim; ++d)
          shift[d] *= factors[d];
    }

    /** Add cells a few faces away to those for which @p is_near is 1: what is
     * bisected there hardly ever concerns domains further away. */
    template <int dim>
    void
    add_cells_around(const SimplexGeometry<dim> &geometry,
                     std::vector<unsigned char> &is_near)
    {
      constexpr unsigned int    n_faces = 8;
      std::vector<unsigned int> last;
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        if (is_near[cell])
          last.push_back(cell);
      for (unsigned int i = 0; i < n_faces; ++i)
        for (const unsigned int cell : std::exchange(last, {}))
          for (const unsigned int next : geometry.neighbours(cell))
            if (next != SimplexGeometry<dim>::no_cell &&
                !std::exchange(is_near[next], 1))
              last.push_back(next);
    }

    /** The cells at most a few faces away from those of other ranks. */
    template <int dim>
    std::vector<unsigned char>
    cells_near_other_ranks(const SimplexGeometry<dim> &geometry,
                           const MPI_Comm              comm)
    {
      std::vector<unsigned char> is_near(geometry.n_cells(), 0);
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        return is_near;
      const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        is_near[cell] = (geometry.owner(cell) != rank);
      add_cells_around(geometry, is_near);
      return is_near;
    }

    void
    set_on_all_ranks(std::vector<unsigned char> &flags, const MPI_Comm comm)
    {
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        return;
      std::vector<unsigned int> on_any(flags.begin(), flags.end());
      Utilities::MPI::max(on_any, comm, on_any);
      std::copy(on_any.begin(), on_any.end(), flags.begin());
    }

    /** Find location and cell of a part of a domain, which knows the location
     * of the whole. A part whose centroid is outside of the grid stays behind.
     * On a face between cells the answer depends on @p cell, that of the point
     * as it was: MaterialPoints::relocate() will begin there, too. */
    template <int dim>
    void
    locate_part(const PointLocator<dim> &locator,
                const unsigned int       cell,
                PointDomain<dim>        &part)
    {
      const Point<dim>     of_whole = part.location;
      const Tensor<1, dim> shift    = centroid<dim>(part.current) - of_whole;
      for (double factor = 1; factor > 1e-3; factor *= 0.75)
        {
          const Point<dim> x     = of_whole + factor * shift;
          const auto       place = locator.locate(x, cell);
          if (!place.found)
            continue;
          part.location = x;
          part.cell     = place.cell;
          return;
        }
    }
  } // namespace



  template <int dim>
  void
  PointRefinement<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    prm.declare_entry("Domains",
                      "auto",
                      Patterns::Selection("auto|always|if needed"),
                      "Which points have a domain, a triangle (tetrahedron) "
                      "that they carry along. 'auto': on adaptive grids all, "
                      "so that small cells get as many points as large ones, "
                      "else as 'if needed': those of the quadratures 'CPDI' "
                      "and 'cell-filled + boundary', which integrate over "
                      "domains. Others use them only to split points.");
    prm.declare_entry("Split at share of cell",
                      "0",
                      Patterns::Double(0),
                      "Split points whose current volume is larger than this "
                      "share of the volume of the cell that they are in: "
                      "points with 'Domains' into halves, together with "
                      "neighbours, so that domains go on sharing faces, others "
                      "into 4 (2D) or 5 (3D) equal parts. 0: never; on an "
                      "adaptive grid 1.5 / 'Points per cell'.");
    prm.declare_entry("Least points per cell",
                      "0",
                      Patterns::Integer(0, 1000),
                      "Where points with 'Domains' are split: as many as each "
                      "cell that domains cover has at least, whatever "
                      "their volumes. 0: one, so that nothing inside of the "
                      "body is empty, and none with quadratures that "
                      "integrate over domains ('CPDI', 'cell-filled + "
                      "boundary').");
    prm.declare_entry(
      "Merge points",
      "with domains",
      Patterns::Selection("never|with domains|always"),
      "On an adaptive grid: put together what was split, where "
      "that then is smaller than 0.8 times what would be split "
      "again. 'with domains': only points that have 'Domains'.");
    prm.declare_entry("Merging tolerance",
                      "0.1",
                      Patterns::Double(0),
                      "Merge what is strained alike: deformation gradients "
                      "differ by at most this times the strain. About a "
                      "quarter of its square is the part of the strain energy "
                      "that is lost by it.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  PointRefinement<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    largest_share         = prm.get_double("Split at share of cell");
    merging               = prm.get("Merge points");
    merging_tolerance     = prm.get_double("Merging tolerance");
    least_points          = prm.get_integer("Least points per cell");
    const double asked    = prm.get_integer("Points per cell");
    const double per_cell = asked > 0 ? asked : (1 << dim);
    prm.leave_subsection();
    // else parts of new parts would be split at once
    AssertThrow(largest_share == 0 || largest_share >= 0.1,
                ExcMessage("<Material points/Split at share of cell> must be 0 "
                           "or at least 0.1: more than ten points per cell are "
                           "a matter of seeding."));
    // no point of the rules for seeding is split in its own cell, all are
    // where cells have been halved
    share_on_adaptive_grids =
      largest_share > 0 ? largest_share : 1.5 / per_cell;
  }



  template <int dim>
  void
  PointRefinement<dim>::refine(
    MaterialPoints<dim>                         &points,
    const BackgroundGrid<dim>                   &grid,
    const PointLocator<dim>                     &locator,
    const typename PointMerging<dim>::Materials &materials,
    const bool                                   merges)
  {
    const double share =
      grid.is_adaptive() ? share_on_adaptive_grids : largest_share;
    if (share == 0)
      return;
    const bool with_domains = points.layout().with_domains;
    // first, since splitting has the last word on how many are needed
    constexpr double hysteresis = 0.8;
    if (grid.is_adaptive() && merges &&
        (merging == "always" || (merging == "with domains" && with_domains)))
      n_removed += PointMerging<dim>(points,
                                     grid,
                                     locator,
                                     materials,
                                     hysteresis * share,
                                     merging_tolerance,
                                     least_points)
                     .merge();
    // parts may still be too large; bounded, since each round divides by
    // four
    for (unsigned int round = 0; round < (with_domains ? 1 : 8); ++round)
      {
        const std::vector<NewPoint> parts =
          with_domains ? split_domains(points, grid, locator, share) :
                         split(points, locator, share);
        const auto n = Utilities::MPI::sum(parts.size(), grid.communicator());
        if (n == 0)
          break;
        n_added += n;
        insert(points, grid, parts);
        points.relocate(locator);
      }
  }



  template <int dim>
  void
  PointRefinement<dim>::evaluate(Statistics &statistics)
  {
    statistics.set("Points added by splitting", n_added);
    statistics.set("Points removed by merging", n_removed);
    n_added = n_removed = 0;
  }



  template <int dim>
  std::vector<typename PointRefinement<dim>::NewPoint>
  PointRefinement<dim>::split(MaterialPoints<dim>     &points,
                              const PointLocator<dim> &locator,
                              const double             share) const
  {
    const PointLayout    &l = points.layout();
    std::vector<NewPoint> parts;
    static const auto     places = places_of_parts<dim>();
    for (auto &particle : points.handler())
      {
        const unsigned int cell =
          particle.get_surrounding_cell()->active_cell_index();
        const ArrayView<double> values = particle.get_properties();
        const Tensor<2, dim>    F = deformation_gradient<dim>(values.data(), l);
        const double            volume = values[l.volume] * determinant(F);
        if (!(volume > share * locator.geometry().measure(cell)))
          continue;

        std::array<Tensor<1, dim>, dim + 2> shifts;
        for (unsigned int i = 0; i <= dim; ++i)
          shifts[i + 1] = std::pow(volume, 1. / dim) * places[i];
        const Point<dim> x = particle.get_location();
        make_fit(locator, cell, x, shifts);

        const Tensor<2, dim>      inverse = invert(F);
        const std::vector<double> old(values.begin(), values.end());
        for (unsigned int i = 0; i < shifts.size(); ++i)
          {
            // they move with the point's F, so that X = x - u is affine
            const Tensor<1, dim> &shift = shifts[i];
            const Tensor<1, dim>  u     = shift - inverse * shift;
            std::vector<double>   part  = old;
            part[l.volume] /= shifts.size();
            part[l.mass] /= shifts.size();
            if (l.with_ancestry && part[l.ancestry] == 0)
              part[l.ancestry] = old[l.volume];
            for (unsigned int d = 0; d < dim; ++d)
              part[l.displacement + d] += u[d];
            if (i > 0)
              {
                parts.push_back({cell, x + shift, part});
                continue;
              }
            std::copy(part.begin(), part.end(), values.begin());
            particle.set_location(x + shift);
          }
      }
    return parts;
  }



  template <int dim>
  std::vector<PointDomain<dim>>
  PointRefinement<dim>::bisect_domains(std::vector<PointDomain<dim>> &&domains,
                                       const BackgroundGrid<dim>      &grid,
                                       const PointLocator<dim>        &locator,
                                       const double share) const
  {
    const MPI_Comm comm     = grid.communicator();
    const auto     is_large = [&](const PointDomain<dim> &domain) {
      return domain.volume > share * locator.geometry().measure(domain.cell);
    };
    SparseCells<dim>           sparse(locator.geometry(), least_points, comm);
    const auto                 asked = sparse.find_domains(domains);
    std::vector<unsigned char> is_near(locator.geometry().n_cells(), 0);
    bool                       is_any = false;
    for (unsigned int i = 0; i < domains.size(); ++i)
      if (asked[i] || is_large(domains[i]))
        {
          is_near[domains[i].cell] = 1;
          is_any                   = true;
        }
    if (!Utilities::MPI::logical_or(is_any, comm))
      return std::move(domains);

    if (!have_to_fit)
      {
        add_cells_around(locator.geometry(), is_near);
        set_on_all_ranks(is_near, comm);
      }
    const auto is_near_others =
      cells_near_other_ranks(locator.geometry(), comm);
    std::vector<unsigned int> cell_of_point;
    for (const PointDomain<dim> &domain : domains)
      cell_of_point.push_back(domain.cell);
    DomainBisection<dim> bisection(
      std::move(domains),
      scale_of_places(grid),
      comm,
      [&](const PointDomain<dim> &domain) {
        return have_to_fit || is_near[domain.cell];
      },
      [&](const PointDomain<dim> &domain) {
        return is_near_others[domain.cell] != 0;
      });
    const auto is_large_in_its_cell = [&](PointDomain<dim> &domain) {
      if (domain.n_halvings > 0)
        locate_part(locator, cell_of_point[domain.point], domain);
      return is_large(domain);
    };
    bisection.bisect(is_large_in_its_cell);
    constexpr unsigned int most_rounds = 12;
    for (unsigned int round = 0; round < most_rounds; ++round)
      if (!bisection.bisect(sparse.find_domains(bisection.parts()),
                            is_large_in_its_cell))
        break;
    return bisection.parts();
  }



  template <int dim>
  std::vector<typename PointRefinement<dim>::NewPoint>
  PointRefinement<dim>::split_domains(MaterialPoints<dim>       &points,
                                      const BackgroundGrid<dim> &grid,
                                      const PointLocator<dim>   &locator,
                                      const double               share) const
  {
    const auto parts =
      bisect_domains(point_domains(points), grid, locator, share);
    std::vector<NewPoint> added;
    // the parts of a point follow each other; the first is what remains of
    // it
    auto                particle = points.handler().begin();
    unsigned int        point    = 0;
    std::vector<double> whole;
    for (std::size_t i = 0; i < parts.size(); ++i)
      {
        const bool is_first = (i == 0 || parts[i].point != parts[i - 1].point);
        for (; point < parts[i].point; ++point)
          ++particle;
        if (parts[i].n_halvings == 0)
          continue;
        const auto values = particle->get_properties();
        if (is_first)
          whole.assign(values.begin(), values.end());
        std::vector<double> part   = whole;
        const double        factor = std::ldexp(1., -int(parts[i].n_halvings));
        part[points.layout().volume] *= factor;
        part[points.layout().mass] *= factor;
        store_domain<dim>(parts[i], points.layout(), make_array_view(part));
        if (!is_first)
          {
            added.push_back(
              {particle->get_surrounding_cell()->active_cell_index(),
               parts[i].location,
               part});
            continue;
          }
        std::copy(part.begin(), part.end(), values.begin());
        particle->set_location(parts[i].location);
      }
    return added;
  }



  template <int dim>
  void
  PointRefinement<dim>::insert(MaterialPoints<dim>         &points,
                               const BackgroundGrid<dim>   &grid,
                               const std::vector<NewPoint> &parts) const
  {
    types::particle_index id =
      points.handler().get_next_free_particle_index() +
      exclusive_and_total_sum(parts.size(), grid.communicator()).first;

    // into the cell of the old point; the place may be in another one
    for (const NewPoint &part : parts)
      {
        std::vector<double> properties = part.properties;
        points.handler().insert_particle(
          part.location,
          SimplexGeometry<dim>::reference_location(
            grid.geometry().barycentric(part.cell, part.location)),
          id++,
          grid.geometry().cell_iterator(part.cell),
          make_array_view(properties));
      }
    points.handler().update_cached_numbers();
  }



  template class PointRefinement<2>;
  template class PointRefinement<3>;
} // namespace isochor
