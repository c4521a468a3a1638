/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/mpi.h>

#include <isochor/linear_solver/linear_solver.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  void
  assert_finite(const SparseSystem &A)
  {
    Assert(A.values.size() == A.column.size() || A.values.empty(),
           ExcInternalError());
    const bool is_finite =
      std::all_of(A.values.begin(), A.values.end(), [](const double a) {
        return std::isfinite(a);
      });
    AssertThrow(Utilities::MPI::min(is_finite ? 1 : 0, A.comm) == 1,
                ExcLinearSolverFailed(
                  "the matrix has entries that are infinite or not numbers."));
  }
} // namespace isochor
