/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_sudden_motions_h
#define isochor_sudden_motions_h

#include <isochor/boundary_condition/boundary_condition.h>

namespace isochor
{
  /**
   * In dynamics: warn if a motion that @p condition prescribes starts or stops
   * suddenly in @p step, but at t = 0. The formulas are looked at between the
   * step's ends: a velocity that changes as much over ever shorter times jumps,
   * however large the accelerations are elsewhere. Collective.
   */
  template <int dim>
  void
  warn_of_sudden_motion(const StepContext<dim>       &step,
                        const BoundaryCondition<dim> &condition);
} // namespace isochor

#endif
