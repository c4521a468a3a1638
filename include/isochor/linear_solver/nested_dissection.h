/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nested_dissection_h
#define isochor_nested_dissection_h

#include <vector>

namespace isochor
{
  /**
   * A fill-reducing ordering by METIS' nested dissection of the graph of
   * the matrix whose entries are (row, column), 1-based, each off-diagonal
   * pair in one triangle or in both, duplicates allowed. Returns the
   * position of each equation, 1-based.
   */
  std::vector<int>
  nested_dissection(const unsigned int                   n,
                    const std::vector<std::vector<int>> &rows,
                    const std::vector<std::vector<int>> &columns);
} // namespace isochor

#endif
