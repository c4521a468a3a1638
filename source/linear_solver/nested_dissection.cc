/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/linear_solver/linear_solver.h>
#include <isochor/linear_solver/nested_dissection.h>

#include <metis.h>

#include <algorithm>

namespace isochor
{
  std::vector<int>
  nested_dissection(const unsigned int                   n,
                    const std::vector<std::vector<int>> &rows,
                    const std::vector<std::vector<int>> &columns)
  {
    const auto for_each_edge = [&](const auto &action) {
      for (unsigned int rank = 0; rank < rows.size(); ++rank)
        for (std::size_t k = 0; k < rows[rank].size(); ++k)
          if (rows[rank][k] != columns[rank][k])
            {
              action(rows[rank][k] - 1, columns[rank][k] - 1);
              action(columns[rank][k] - 1, rows[rank][k] - 1);
            }
    };
    std::vector<std::size_t> start(n + 1, 0);
    for_each_edge([&](const int i, const int) { ++start[i + 1]; });
    for (unsigned int i = 0; i < n; ++i)
      start[i + 1] += start[i];
    std::vector<idx_t> neighbour(start[n]);
    {
      std::vector<std::size_t> next(start.begin(), start.end() - 1);
      for_each_edge(
        [&](const int i, const int j) { neighbour[next[i]++] = j; });
    }

    std::vector<idx_t> row_start(n + 1, 0);
    std::size_t        end = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto first = neighbour.begin() + start[i];
        const auto last  = neighbour.begin() + start[i + 1];
        std::sort(first, last);
        const auto last_unique = std::unique(first, last);
        std::copy(first, last_unique, neighbour.begin() + end);
        end += last_unique - first;
        row_start[i + 1] = end;
      }
    neighbour.resize(std::max<std::size_t>(end, 1));

    std::vector<idx_t> equation_at(n), position_of(n);
    idx_t              n_vertices = n;
    const int          status     = METIS_NodeND(&n_vertices,
                                    row_start.data(),
                                    neighbour.data(),
                                    nullptr,
                                    nullptr,
                                    equation_at.data(),
                                    position_of.data());
    AssertThrow(status == METIS_OK,
                ExcLinearSolverFailed("METIS could not order the equations "
                                      "(METIS_NodeND returned " +
                                      std::to_string(status) + ")."));
    std::vector<int> position(n);
    for (unsigned int i = 0; i < n; ++i)
      position[i] = position_of[i] + 1;
    return position;
  }
} // namespace isochor
