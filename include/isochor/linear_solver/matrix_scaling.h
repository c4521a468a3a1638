/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_matrix_scaling_h
#define isochor_matrix_scaling_h

#include <isochor/linear_solver/sparse_system.h>

#include <vector>

namespace isochor
{
  /**
   * Factors s_i > 0 by which rows and columns of @p A are multiplied before
   * they are factorised, so that pivots of any field and in any units compare:
   * s_i² is about 1/|a_ii| for displacements and, for pressures,
   * 1/(|a_ii| + Σ_j a_ij² s_j²), that of their Schur complement, which holds
   * without compressibility and stabilisation, too. Powers of two, which leave
   * all digits of the entries as they are. Serial: @p A is the whole matrix.
   */
  std::vector<double>
  matrix_scaling(const SparseSystem &A);
} // namespace isochor

#endif
