/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_condition_number_h
#define isochor_condition_number_h

#include <isochor/linear_solver/sparse_system.h>

namespace isochor
{
  /**
   * The 2-norm condition number of D A D with D_ii = |A_ii|^{-1/2} (1 where
   * A_ii = 0): of the matrix after the scaling that any solver can do, so that
   * units and cell sizes don't show. Infinite if a singular value vanishes.
   *
   * From dense singular values, thus for small systems (at most 3000
   * equations, otherwise an exception). Collective; the same on all ranks.
   */
  double
  scaled_condition_number(const SparseSystem &A);
} // namespace isochor

#endif
