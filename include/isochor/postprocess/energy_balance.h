/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_energy_balance_h
#define isochor_energy_balance_h

#include <isochor/postprocess/postprocessor.h>

namespace isochor
{
  /** At the end of a step (J). */
  struct EnergyBalance
  {
    double kinetic   = 0;
    double internal  = 0; ///< strain energy and plastic work
    double supplied  = 0; ///< external work, and what there was at t = 0
    double stiffness = 0; ///< Σ_p V_p G
  };

  /** A post-processor that knows where the energy of the body is. */
  template <int dim>
  class HasEnergyBalance
  {
  public:
    virtual ~HasEnergyBalance() = default;

    /** After evaluate_points() for @p result; null if it isn't known, as in
     * statics for materials that dissipate. */
    virtual const EnergyBalance *
    energy_balance(const StepResult<dim> &result) const = 0;
  };
} // namespace isochor

#endif
