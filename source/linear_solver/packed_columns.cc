/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/linear_solver/packed_columns.h>

#include <algorithm>

namespace isochor
{
  PackedColumns::PackedColumns(SparseSystem &A)
    : A(A)
    , repeats(A.row_start.size() - 1, false)
  {
    const auto        begin  = A.column.begin();
    const auto       &start  = A.row_start;
    const std::size_t missed = A.symmetric ? 1 : 0;
    std::size_t       n_kept = A.column.size();
    for (std::size_t r = 1; r < repeats.size(); ++r)
      {
        const std::size_t n = start[r + 1] - start[r];
        repeats[r]          = n + missed == start[r] - start[r - 1] &&
                     std::equal(begin + start[r],
                                begin + start[r + 1],
                                begin + start[r - 1] + missed);
        if (repeats[r])
          n_kept -= n;
      }
    kept.reserve(n_kept);
    for (std::size_t r = 0; r < repeats.size(); ++r)
      if (!repeats[r])
        kept.insert(kept.end(), begin + start[r], begin + start[r + 1]);
    std::vector<unsigned int>().swap(A.column);
  }

  PackedColumns::~PackedColumns()
  {
    A.column.reserve(A.row_start.back());
    std::size_t next = 0;
    for (std::size_t r = 0; r < repeats.size(); ++r)
      for (std::size_t k = A.row_start[r]; k < A.row_start[r + 1]; ++k)
        A.column.push_back(
          repeats[r] ? A.column[k - (A.row_start[r + 1] - A.row_start[r])] :
                       kept[next++]);
  }
} // namespace isochor
