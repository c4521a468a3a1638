/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_idle_pressures_h
#define isochor_idle_pressures_h

#include <isochor/equations/equation_term.h>
#include <isochor/equations/nodal_constraints.h>

namespace isochor
{
  /**
   * Where points see pressures of other nodes than displacements
   * (DomainCorners::pressure_shape; in statics), a node may have a pressure
   * that no point and no stabilisation feels. Its equation is 0 = 0: @p
   * constraints, which have the ties by now, hold it at zero. Collective.
   */
  template <int dim>
  void
  hold_idle_pressures(const StepContext<dim> &step,
                      NodalConstraints       &constraints);
} // namespace isochor

#endif
