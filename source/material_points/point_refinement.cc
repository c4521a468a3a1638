/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/material_points/domain_collapse.h>
#include <isochor/material_points/domain_flips.h>
#include <isochor/material_points/point_refinement.h>

#include <algorithm>
#include <array>
#include <cmath>

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

    /** By point: whether its domain may change. */
    template <int dim>
    std::vector<unsigned char>
    find_flowing(const bool                                   is_needed,
                 const MaterialPoints<dim>                   &points,
                 const typename PointMerging<dim>::Materials &materials)
    {
      std::vector<unsigned char> flowing;
      if (!is_needed)
        return flowing;
      for (const auto &particle : points.handler())
        flowing.push_back(is_flowing<dim>(particle.get_properties().data(),
                                          points.layout(),
                                          materials));
      return flowing;
    }

    /** Flip and collapse what flows. How many points are gone, on all ranks.
     */
    unsigned int
    reshape_domains(MaterialPoints<2>                &points,
                    const BackgroundGrid<2>          &grid,
                    const PointLocator<2>            &locator,
                    const PointMerging<2>::Materials &materials)
    {
      FlowingTriangles   mesh(points, grid, materials);
      const unsigned int n_flips = DomainFlips(mesh).flip(),
                         n_gone  = DomainCollapse(mesh).collapse();
      if (n_flips + n_gone > 0)
        {
          mesh.store();
          points.relocate(locator);
        }
      return n_gone;
    }

    template <int dim>
    bool
    is_long(const PointDomain<dim>     &domain,
            const SimplexGeometry<dim> &geometry)
    {
      return length_in_cells<dim>(domain.current, geometry, domain.cell) >
             tolerated_length;
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
                      "else as 'if needed': those of the quadrature 'CPDI', "
                      "which integrates over domains. Others use them only "
                      "to split points.");
    prm.declare_entry("Split at share of cell",
                      "0",
                      Patterns::Double(0),
                      "Split points whose current volume is larger than this "
                      "share of the volume of the cell that they are in: "
                      "points with 'Domains' into halves, together with "
                      "neighbours, so that domains go on sharing faces, others "
                      "into 4 (2D) or 5 (3D) equal parts. 0: never; on an "
                      "adaptive grid 1.5 / 'Points per cell'. (Triangles of "
                      "material that flows are bisected anyway, where they "
                      "become longer than their cells.)");
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
  bool
  PointRefinement<dim>::domains_follow_flow(
    const MaterialPoints<dim>                   &points,
    const BackgroundGrid<dim>                   &grid,
    const typename PointMerging<dim>::Materials &materials) const
  {
    // those of the plane can be flipped, too, which alone keeps their shapes;
    // on adaptive grids what is bisected would be merged again
    return dim == 2 && have_to_fit && points.layout().with_domains &&
           points.layout().mixed() && !grid.is_adaptive() &&
           std::any_of(materials.begin(),
                       materials.end(),
                       [](const auto &material) {
                         return material->dissipates();
                       });
  }



  template <int dim>
  bool
  PointRefinement<dim>::refine(
    MaterialPoints<dim>                         &points,
    const BackgroundGrid<dim>                   &grid,
    const PointLocator<dim>                     &locator,
    const typename PointMerging<dim>::Materials &materials,
    const bool                                   merges)
  {
    const bool   with_domains = points.layout().with_domains;
    const double share =
      grid.is_adaptive() ? share_on_adaptive_grids : largest_share;
    const bool follows = domains_follow_flow(points, grid, materials);
    if (share == 0 && !follows)
      return false;
    const auto n_before = n_added + n_removed;
    // first, since splitting has the last word on how many are needed
    constexpr double              hysteresis = 0.8;
    std::vector<PointDomain<dim>> domains;
    const bool                    has_merged =
      grid.is_adaptive() && merges &&
      (merging == "always" || (merging == "with domains" && with_domains));
    if (has_merged)
      {
        PointMerging<dim> all(points,
                              grid,
                              locator,
                              materials,
                              hysteresis * share,
                              merging_tolerance,
                              least_points);
        n_removed += all.merge();
        domains = all.take_domains();
      }
    const auto insert_parts = [&](const std::vector<NewPoint> &parts) {
      const auto n = Utilities::MPI::sum(parts.size(), grid.communicator());
      if (n > 0)
        insert(points, grid, locator, parts);
      n_added += n;
      return n > 0;
    };
    if (with_domains)
      {
        if constexpr (dim == 2)
          if (follows)
            n_removed += reshape_domains(points, grid, locator, materials);
        const auto flowing  = find_flowing(follows, points, materials);
        const auto is_large = [&](const PointDomain<dim> &domain) {
          const auto &geometry = locator.geometry();
          return (share > 0 &&
                  domain.volume > share * geometry.measure(domain.cell)) ||
                 (follows && flowing[domain.point] &&
                  is_long(domain, geometry));
        };
        insert_parts(
          split_domains(points,
                        has_merged ? std::move(domains) : point_domains(points),
                        grid,
                        locator,
                        is_large,
                        follows,
                        share > 0 ? least_points : 0));
      }
    else
      // parts may still be too large; bounded, as each is a fourth or fifth
      for (unsigned int round = 0; round < 8; ++round)
        if (!insert_parts(split(points, locator, share)))
          break;
    return n_added + n_removed > n_before;
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
  void
  PointRefinement<dim>::insert(MaterialPoints<dim>         &points,
                               const BackgroundGrid<dim>   &grid,
                               const PointLocator<dim>     &locator,
                               const std::vector<NewPoint> &parts) const
  {
    types::particle_index id =
      points.handler().get_next_free_particle_index() +
      exclusive_and_total_sum(parts.size(), grid.communicator()).first;

    // into the cell of the old point; the place may be in another one
    std::vector<unsigned char> is_concerned(grid.geometry().n_cells(), 0);
    for (const NewPoint &part : parts)
      {
        is_concerned[part.cell]        = 1;
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
    points.relocate(locator, is_concerned);
  }



  template class PointRefinement<2>;
  template class PointRefinement<3>;
} // namespace isochor
