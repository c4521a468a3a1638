/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/vertex_owners.h>

#include <algorithm>
#include <map>
#include <utility>

namespace isochor
{
  namespace
  {
    /** The vertices, in order, that have cells of several ranks, by these
     * ranks. */
    template <int dim>
    std::map<std::vector<unsigned int>, std::vector<unsigned int>>
    shared_vertices(const SimplexGeometry<dim>      &geometry,
                    const std::vector<unsigned int> &some_owner)
    {
      std::vector<unsigned char> is_shared(some_owner.size(), 0);
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        for (const unsigned int v : geometry.vertex_indices(cell))
          if (geometry.owner(cell) != some_owner[v])
            is_shared[v] = 1;
      std::vector<std::pair<unsigned int, unsigned int>> owners;
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        for (const unsigned int v : geometry.vertex_indices(cell))
          if (is_shared[v])
            owners.emplace_back(v, geometry.owner(cell));
      std::sort(owners.begin(), owners.end());
      owners.erase(std::unique(owners.begin(), owners.end()), owners.end());

      std::map<std::vector<unsigned int>, std::vector<unsigned int>> groups;
      std::vector<unsigned int>                                      ranks;
      for (std::size_t i = 0; i < owners.size(); ++i)
        {
          ranks.push_back(owners[i].second);
          if (i + 1 == owners.size() || owners[i + 1].first != owners[i].first)
            {
              groups[ranks].push_back(owners[i].first);
              ranks.clear();
            }
        }
      return groups;
    }
  } // namespace



  template <int dim>
  std::vector<unsigned int>
  owners_of_vertices(const SimplexGeometry<dim> &geometry)
  {
    // the body may fill some part of what ranks share only
    constexpr std::size_t     n_rounds = 4;
    std::vector<unsigned int> owners(geometry.vertices().size(),
                                     numbers::invalid_unsigned_int);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      for (const unsigned int v : geometry.vertex_indices(cell))
        owners[v] = geometry.owner(cell);
    for (const auto &[ranks, vertices] : shared_vertices(geometry, owners))
      {
        const std::size_t n_parts = n_rounds * ranks.size();
        for (std::size_t i = 0; i < vertices.size(); ++i)
          owners[vertices[i]] =
            ranks[i * n_parts / vertices.size() % ranks.size()];
      }
    return owners;
  }



  template std::vector<unsigned int>
  owners_of_vertices(const SimplexGeometry<2> &);
  template std::vector<unsigned int>
  owners_of_vertices(const SimplexGeometry<3> &);
} // namespace isochor
