/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/rounding.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/grid/simplex_coordinates.h>
#include <isochor/material_points/sparse_cells.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace isochor
{
  namespace
  {
    /** How many faces away domains are looked for: more cells meet at a vertex
     * in space. */
    template <int dim>
    constexpr unsigned int n_rings = (dim == 2 ? 3 : 5);

    template <int dim>
    bool
    covers(const PointDomain<dim> &domain, const Point<dim> &x)
    {
      // most are far from it
      for (unsigned int d = 0; d < dim; ++d)
        {
          double lower = domain.current[0][d], upper = lower;
          for (unsigned int c = 1; c <= dim; ++c)
            {
              lower = std::min(lower, domain.current[c][d]);
              upper = std::max(upper, domain.current[c][d]);
            }
          const double slack = rounding::places * (upper - lower);
          if (x[d] < lower - slack || x[d] > upper + slack)
            return false;
        }
      const auto lambda = simplex_coordinates<dim>(domain.current, x);
      // a place on the face between two domains is covered
      return *std::min_element(lambda.begin(), lambda.end()) >=
             -rounding::accumulated;
    }
  } // namespace



  template <int dim>
  SparseCells<dim>::SparseCells(const SimplexGeometry<dim> &geometry,
                                const unsigned int          least,
                                const MPI_Comm              comm)
    : geometry(geometry)
    , least(least)
    , comm(comm)
  {}



  template <int dim>
  void
  SparseCells<dim>::visit_cells_around(
    const unsigned int                             cell,
    const std::function<bool(const unsigned int)> &visit)
  {
    ++n_visits;
    visited[cell] = n_visits;
    queue.assign(1, cell);
    std::size_t begin = 0;
    for (unsigned int ring = 0; ring <= n_rings<dim>; ++ring)
      {
        const std::size_t end = queue.size();
        for (; begin < end; ++begin)
          {
            if (visit(queue[begin]))
              return;
            for (const unsigned int next : geometry.neighbours(queue[begin]))
              if (ring < n_rings<dim> &&
                  next != SimplexGeometry<dim>::no_cell &&
                  visited[next] != n_visits)
                {
                  visited[next] = n_visits;
                  queue.push_back(next);
                }
          }
      }
  }



  template <int dim>
  void
  SparseCells<dim>::collect_cells(const Domains &domains)
  {
    first.assign(geometry.n_cells() + 1, 0);
    for (const PointDomain<dim> *domain : domains)
      ++first[domain->cell + 1];
    n_points.assign(first.begin() + 1, first.end());
    std::partial_sum(first.begin(), first.end(), first.begin());
    domains_by_cell.resize(domains.size());
    std::vector<unsigned int> next(first.begin(), first.end() - 1);
    for (unsigned int i = 0; i < domains.size(); ++i)
      domains_by_cell[next[domains[i]->cell]++] = i;

    // ring by ring around all of them
    visited.resize(geometry.n_cells(), 0);
    ++n_visits;
    cells_nearby.clear();
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      if (n_points[cell] > 0)
        {
          visited[cell] = n_visits;
          cells_nearby.push_back(cell);
        }
    std::size_t begin = 0;
    for (unsigned int ring = 0; ring < n_rings<dim>; ++ring)
      for (const std::size_t end = cells_nearby.size(); begin < end; ++begin)
        for (const unsigned int next : geometry.neighbours(cells_nearby[begin]))
          if (next != SimplexGeometry<dim>::no_cell &&
              visited[next] != n_visits)
            {
              visited[next] = n_visits;
              cells_nearby.push_back(next);
            }
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      Utilities::MPI::sum(n_points, comm, n_points);
  }



  template <int dim>
  unsigned int
  SparseCells<dim>::find_domain(const Domains     &domains,
                                const unsigned int cell,
                                const Point<dim>  &x)
  {
    unsigned int found = domains.size();
    visit_cells_around(cell, [&](const unsigned int near) {
      for (unsigned int i = first[near]; i < first[near + 1]; ++i)
        if (covers<dim>(*domains[domains_by_cell[i]], x))
          {
            found = domains_by_cell[i];
            return true;
          }
      return false;
    });
    return found;
  }



  template <int dim>
  bool
  SparseCells<dim>::is_worth_it(const PointDomain<dim> &domain,
                                const unsigned int      cell) const
  {
    return domain.volume > smallest_share / least * geometry.measure(cell);
  }



  template <int dim>
  void
  SparseCells<dim>::fill_empty_cells(const Domains              &domains,
                                     std::vector<unsigned char> &flags)
  {
    for (const unsigned int cell : cells_nearby)
      if (n_points[cell] == 0)
        {
          const unsigned int i =
            find_domain(domains, cell, cell_centroid(geometry, cell));
          if (i < domains.size() && is_worth_it(*domains[i], cell))
            flags[i] = 1;
        }
  }



  template <int dim>
  void
  SparseCells<dim>::fill_sparse_cells(const Domains              &domains,
                                      std::vector<unsigned char> &flags)
  {
    // what domains of any rank cover
    std::vector<unsigned int> is_covered(geometry.n_cells() * n_places, 0);
    for (const unsigned int cell : cells_nearby)
      if (n_points[cell] > 0 && n_points[cell] < least)
        {
          const Point<dim> centre = cell_centroid(geometry, cell);
          for (unsigned int i = 0; i < n_places; ++i)
            {
              const Point<dim> place =
                i == 0 ?
                  centre :
                  centre +
                    (geometry.vertices()[geometry.vertex_indices(cell)[i - 1]] -
                     centre) /
                      2;
              is_covered[cell * n_places + i] =
                (find_domain(domains, cell, place) < domains.size());
            }
        }
    std::vector<double> largest(geometry.n_cells(), 0.);
    for (const PointDomain<dim> *domain : domains)
      largest[domain->cell] = std::max(largest[domain->cell], domain->volume);
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        Utilities::MPI::max(is_covered, comm, is_covered);
        Utilities::MPI::max(largest, comm, largest);
      }
    for (unsigned int i = 0; i < domains.size(); ++i)
      {
        const unsigned int cell   = domains[i]->cell;
        const auto         places = is_covered.begin() + cell * n_places;
        if (std::all_of(places,
                        places + n_places,
                        [](const unsigned int covered) {
                          return covered == 1;
                        }) &&
            domains[i]->volume > (1 - rounding::places) * largest[cell] &&
            is_worth_it(*domains[i], cell))
          flags[i] = 1;
      }
  }



  template <int dim>
  std::vector<unsigned char>
  SparseCells<dim>::find_domains(const Domains &domains)
  {
    std::vector<unsigned char> flags(domains.size(), 0);
    if (least == 0)
      return flags;
    collect_cells(domains);
    fill_empty_cells(domains, flags);
    if (least > 1)
      fill_sparse_cells(domains, flags);
    return flags;
  }



  template class SparseCells<2>;
  template class SparseCells<3>;
} // namespace isochor
