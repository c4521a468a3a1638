/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/linear_solver/matrix_scaling.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace isochor
{
  namespace
  {
    /** 2^(-e/2), e the exponent of @p value > 0, halves rounded towards 0:
     * std::ldexp(1., -std::ilogb(value) / 2), whose calls took longer than all
     * the rest. */
    double
    inverse_root_by_power_of_two(const double value)
    {
      static_assert(std::numeric_limits<double>::is_iec559);
      constexpr int n_fraction = 52, bias = 1023; // bits of IEEE 754
      std::int64_t  bits;
      std::memcpy(&bits, &value, sizeof(bits));
      const int exponent = static_cast<int>(bits >> n_fraction) - bias;
      bits = static_cast<std::int64_t>(bias - exponent / 2) << n_fraction;
      double result;
      std::memcpy(&result, &bits, sizeof(result));
      return result;
    }
  } // namespace



  std::vector<double>
  matrix_scaling(const SparseSystem &A)
  {
    Assert(!A.row_start.empty(), ExcInternalError());
    AssertDimension(A.values.size(), A.column.size());
    AssertDimension(A.field.size(), A.row_start.size() - 1);
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
      if (std::isnormal(pivot[i]))
        scale[i] = inverse_root_by_power_of_two(pivot[i]);
    return scale;
  }
} // namespace isochor
