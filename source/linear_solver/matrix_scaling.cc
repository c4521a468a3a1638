/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/linear_solver/matrix_scaling.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  std::vector<double>
  matrix_scaling(const SparseSystem &A)
  {
    const unsigned int n = A.row_start.size() - 1;
    // a displacement that nothing resists, or that wants to run away, is
    // measured by what it is connected with, like a pressure
    std::vector<double>        pivot(n, 0.);
    std::vector<unsigned char> has_pivot(n, 0);
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto begin = A.column.begin() + A.row_start[i],
                   end   = A.column.begin() + A.row_start[i + 1];
        const auto found = std::lower_bound(begin, end, i);
        if (found == end || *found != i)
          continue;
        const double diagonal = A.values[found - A.column.begin()];
        pivot[i]              = std::abs(diagonal);
        has_pivot[i] =
          diagonal > 0 && A.field[i] == SparseSystem::Field::displacement;
      }
    for (unsigned int i = 0; i < n; ++i)
      if (!has_pivot[i] || A.symmetric)
        for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          {
            const unsigned int j = A.column[k];
            if (has_pivot[i] == has_pivot[j])
              continue;
            const double square = A.values[k] * A.values[k];
            if (has_pivot[j])
              pivot[i] += square / pivot[j];
            else // the other half isn't stored
              pivot[j] += square / pivot[i];
          }

    std::vector<double> scale(n, 1.);
    for (unsigned int i = 0; i < n; ++i)
      if (pivot[i] > 0 && std::isfinite(pivot[i]))
        scale[i] = std::ldexp(1., -std::ilogb(pivot[i]) / 2);
    return scale;
  }
} // namespace isochor
