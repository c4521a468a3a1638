/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/grid/cells_near_ranks.h>
#include <isochor/material_points/domain_bisection.h>
#include <isochor/material_points/domain_collapse.h>
#include <isochor/material_points/domain_flips.h>
#include <isochor/material_points/point_refinement.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochor
{
  namespace
  {
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
    prm.declare_entry("Split at share of cell",
                      "0",
                      Patterns::Double(0),
                      "Bisect subdomains of points whose current volume is "
                      "larger than this share of the volume of the cell that "
                      "they are in, together with their neighbours. 0: "
                      "1.5 / 'Points per cell' on an adaptive grid and of "
                      "material that flows in the plane, else never. (There "
                      "subdomains are also bisected where they become longer "
                      "than their cells.)");
    prm.leave_subsection();
  }



  template <int dim>
  void
  PointRefinement<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    largest_share         = prm.get_double("Split at share of cell");
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
    usual_share = largest_share > 0 ? largest_share : 1.5 / per_cell;
  }



  template <int dim>
  bool
  PointRefinement<dim>::domains_follow_flow(
    const MaterialPoints<dim>                   &points,
    const typename PointMerging<dim>::Materials &materials) const
  {
    // those of the plane can be flipped, too, which alone keeps their shapes
    return dim == 2 && points.layout().with_domains &&
           points.layout().mixed() &&
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
    const double share   = grid.is_adaptive() ? usual_share : largest_share;
    const bool   follows = domains_follow_flow(points, materials);
    if (!points.layout().with_domains || (share == 0 && !follows))
      return false;
    const auto                    n_before = n_added + n_removed;
    std::vector<PointDomain<dim>> domains;
    if constexpr (dim == 2)
      if (follows)
        n_removed += reshape_domains(points, grid, locator, materials);
    // first, since splitting has the last word on how many are needed; what
    // flows is collapsed instead
    if (grid.is_adaptive() && merges && !follows)
      {
        PointMerging<dim> all(
          points, grid, locator, materials, hysteresis * share);
        n_removed += all.merge();
        domains = all.take_domains();
      }
    else
      domains = point_domains(points);
    const auto flowing  = find_flowing(follows, points, materials);
    const auto is_large = [&](const PointDomain<dim> &domain) {
      const auto  &geometry = locator.geometry();
      const double of_cell  = domain.volume / geometry.measure(domain.cell);
      return (share > 0 && of_cell > share) ||
             (follows && flowing[domain.point] &&
              (of_cell > usual_share || is_long(domain, geometry)));
    };
    const auto parts =
      split_domains(points, domains, grid, locator, is_large, follows);
    const auto n_parts = Utilities::MPI::sum(parts.size(), grid.communicator());
    if (n_parts > 0)
      insert(points, grid, locator, parts);
    n_added += n_parts;
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
  std::vector<PointDomain<dim>>
  PointRefinement<dim>::bisect_domains(
    const std::vector<PointDomain<dim>> &domains,
    const BackgroundGrid<dim>           &grid,
    const PointLocator<dim>             &locator,
    const IsLarge                       &is_large,
    const bool                           flipped) const
  {
    const MPI_Comm comm = grid.communicator();
    if (!Utilities::MPI::logical_or(
          std::any_of(domains.begin(), domains.end(), is_large), comm))
      return {};
    const auto is_near_others =
      cells_near_other_ranks(locator.geometry(), comm);
    DomainBisection<dim> bisection(std::vector<PointDomain<dim>>(domains),
                                   scale_of_places(grid),
                                   flipped,
                                   comm,
                                   [&](const PointDomain<dim> &domain) {
                                     return is_near_others[domain.cell] != 0;
                                   });
    bisection.bisect([&](PointDomain<dim> &domain) {
      if (domain.n_halvings > 0)
        locate_part(locator, domains[domain.point].cell, domain);
      return is_large(domain);
    });
    std::vector<PointDomain<dim>> parts;
    for (const PointDomain<dim> &part : bisection.parts())
      if (part.n_halvings > 0)
        parts.push_back(part);
    return parts;
  }



  template <int dim>
  std::vector<typename PointRefinement<dim>::NewPoint>
  PointRefinement<dim>::split_domains(
    MaterialPoints<dim>                 &points,
    const std::vector<PointDomain<dim>> &domains,
    const BackgroundGrid<dim>           &grid,
    const PointLocator<dim>             &locator,
    const IsLarge                       &is_large,
    const bool                           flipped) const
  {
    const auto parts =
      bisect_domains(domains, grid, locator, is_large, flipped);
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
        const auto values = particle->get_properties();
        if (is_first)
          whole.assign(values.begin(), values.end());
        std::vector<double> part   = whole;
        const double        factor = std::ldexp(1., -int(parts[i].n_halvings));
        part[points.layout().volume] *= factor;
        part[points.layout().mass] *=
          factor * (points.layout().axisymmetric ?
                      centroid<dim>(parts[i].current)[0] /
                        domains[parts[i].point].location[0] :
                      1.); // of rings
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
