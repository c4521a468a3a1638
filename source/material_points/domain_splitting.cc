/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of PointRefinement that are about domains.
#include <deal.II/base/mpi.h>

#include <isochor/grid/cells_near_ranks.h>
#include <isochor/material_points/domain_bisection.h>
#include <isochor/material_points/point_refinement.h>
#include <isochor/material_points/sparse_cells.h>

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

    template <int dim>
    typename SparseCells<dim>::Domains
    pointers(const std::vector<PointDomain<dim>> &domains)
    {
      typename SparseCells<dim>::Domains result(domains.size());
      for (unsigned int i = 0; i < domains.size(); ++i)
        result[i] = &domains[i];
      return result;
    }

    /** Which of the @p parts are to be bisected for @p sparse cells. They are
     * of those @p domains whose cells are near, the others are whole. */
    template <int dim>
    std::vector<unsigned char>
    find_sparse_parts(SparseCells<dim>                    &sparse,
                      const std::vector<PointDomain<dim>> &domains,
                      const std::vector<unsigned char>    &is_near,
                      const std::vector<PointDomain<dim>> &parts)
    {
      typename SparseCells<dim>::Domains all;
      all.reserve(domains.size() + parts.size());
      std::vector<unsigned int> places; // of the parts
      auto                      part = parts.begin();
      for (const PointDomain<dim> &domain : domains)
        if (!is_near[domain.cell])
          all.push_back(&domain);
        else
          for (; part != parts.end() && part->point == domain.point; ++part)
            {
              places.push_back(all.size());
              all.push_back(&*part);
            }
      const auto                 flags = sparse.find_domains(all);
      std::vector<unsigned char> asked;
      for (const unsigned int place : places)
        asked.push_back(flags[place]);
      return asked;
    }

    /** The parts of those of the @p domains, in cells that are near, that are
     * bisected: until none is large and no cell sparse. Collective. */
    template <int dim>
    std::vector<PointDomain<dim>>
    bisect_near(const std::vector<PointDomain<dim>>                  &domains,
                const std::vector<unsigned char>                     &is_near,
                const typename DomainBisection<dim>::DomainCondition &is_large,
                const PointLocator<dim>                              &locator,
                const PlaceScale<dim>                                &scale,
                const bool                                            flipped,
                SparseCells<dim>                                     &sparse,
                const MPI_Comm                                        comm)
    {
      AssertDimension(is_near.size(), locator.geometry().n_cells());
      std::vector<PointDomain<dim>> taking_part;
      taking_part.reserve(
        std::count_if(domains.begin(), domains.end(), [&](const auto &domain) {
          return is_near[domain.cell] != 0;
        }));
      for (const PointDomain<dim> &domain : domains)
        if (is_near[domain.cell])
          taking_part.push_back(domain);
      const auto is_near_others =
        cells_near_other_ranks(locator.geometry(), comm);
      DomainBisection<dim> bisection(std::move(taking_part),
                                     scale,
                                     flipped,
                                     comm,
                                     [&](const PointDomain<dim> &domain) {
                                       return is_near_others[domain.cell] != 0;
                                     });
      const auto is_large_in_its_cell = [&](PointDomain<dim> &domain) {
        if (domain.n_halvings > 0)
          locate_part(locator, domains[domain.point].cell, domain);
        return is_large(domain);
      };
      bisection.bisect(is_large_in_its_cell);
      constexpr unsigned int most_rounds = 12;
      for (unsigned int round = 0; round < most_rounds; ++round)
        if (!bisection.bisect(
              find_sparse_parts(sparse, domains, is_near, bisection.parts()),
              is_large_in_its_cell))
          break;
      std::vector<PointDomain<dim>> parts;
      for (const PointDomain<dim> &part : bisection.parts())
        if (part.n_halvings > 0)
          parts.push_back(part);
      return parts;
    }
  } // namespace



  template <int dim>
  std::vector<PointDomain<dim>>
  PointRefinement<dim>::bisect_domains(
    const std::vector<PointDomain<dim>> &domains,
    const BackgroundGrid<dim>           &grid,
    const PointLocator<dim>             &locator,
    const IsLarge                       &is_large,
    const bool                           flipped,
    const unsigned int                   least) const
  {
    const MPI_Comm            comm = grid.communicator();
    SparseCells<dim>          sparse(locator.geometry(), least, comm);
    const auto                asked = sparse.find_domains(pointers(domains));
    std::vector<unsigned int> distances(locator.geometry().n_cells(),
                                        most_faces + 1);
    bool                      is_any = false;
    for (unsigned int i = 0; i < domains.size(); ++i)
      if (asked[i] || is_large(domains[i]))
        {
          distances[domains[i].cell] = 0;
          is_any                     = true;
        }
    if (!Utilities::MPI::logical_or(is_any, comm))
      return {};
    std::vector<unsigned char> is_near(distances.size(), 1);
    const auto                 bisect = [&]() {
      return bisect_near<dim>(domains,
                              is_near,
                              is_large,
                              locator,
                              scale_of_places(grid),
                              flipped,
                              sparse,
                              comm);
    };
    if (have_to_fit)
      return bisect();
    count_faces(locator.geometry(), distances);
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      Utilities::MPI::min(distances, comm, distances);
    const auto set_near = [&](const unsigned int n_faces) {
      for (unsigned int cell = 0; cell < distances.size(); ++cell)
        is_near[cell] = (distances[cell] <= n_faces);
    };
    // mostly nothing far away is bisected, so that fewer cells do
    constexpr unsigned int few_faces = 5, margin = 2;
    set_near(few_faces);
    auto       parts = bisect();
    const bool is_enough =
      std::none_of(parts.begin(), parts.end(), [&](const auto &part) {
        return distances[domains[part.point].cell] + margin > few_faces;
      });
    if (!Utilities::MPI::logical_or(!is_enough, comm))
      return parts;
    set_near(most_faces);
    return bisect();
  }



  template <int dim>
  std::vector<typename PointRefinement<dim>::NewPoint>
  PointRefinement<dim>::split_domains(
    MaterialPoints<dim>                 &points,
    const std::vector<PointDomain<dim>> &domains,
    const BackgroundGrid<dim>           &grid,
    const PointLocator<dim>             &locator,
    const IsLarge                       &is_large,
    const bool                           flipped,
    const unsigned int                   least) const
  {
    const auto parts =
      bisect_domains(domains, grid, locator, is_large, flipped, least);
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



  template std::vector<typename PointRefinement<2>::NewPoint>
  PointRefinement<2>::split_domains(MaterialPoints<2> &,
                                    const std::vector<PointDomain<2>> &,
                                    const BackgroundGrid<2> &,
                                    const PointLocator<2> &,
                                    const IsLarge &,
                                    const bool,
                                    const unsigned int) const;
  template std::vector<typename PointRefinement<3>::NewPoint>
  PointRefinement<3>::split_domains(MaterialPoints<3> &,
                                    const std::vector<PointDomain<3>> &,
                                    const BackgroundGrid<3> &,
                                    const PointLocator<3> &,
                                    const IsLarge &,
                                    const bool,
                                    const unsigned int) const;
} // namespace isochor
