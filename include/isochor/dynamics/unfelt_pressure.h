/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_unfelt_pressure_h
#define isochor_unfelt_pressure_h

#include <isochor/equations/equation_term.h>
#include <isochor/equations/nodal_constraints.h>

namespace isochor
{
  /**
   * The pressures of the points come from the nodes of the last grid. Let
   * their forces in @p force, a field with dim entries per node, be those of
   * the nearest pressure that the nodes of this grid can have, p_h = Σ N_I p_I,
   *   Σ_p V_p s N_I (p_h - p_p) = 0.
   * The pressure equation says what work such a pressure does in the step;
   * the rest of p_p does work on changes of volume that no pressure of this
   * grid feels and nothing but the shear stiffness resists. They grow by it,
   * and with them the rest of p_p. p_I goes to @p unknowns. @p constraints are
   * those of the start of the step. Collective.
   */
  template <int dim>
  void
  leave_out_unfelt_pressure(const StepContext<dim> &step,
                            const NodalConstraints &constraints,
                            NodalField             &unknowns,
                            NodalField             &force);
} // namespace isochor

#endif
