/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Points that ask for cells which are not allowed. */
  template <int dim>
  class MaximumLevel : public Diagnosis<dim>
  {
  public:
    void
    step_converged(const ConvergedStep<dim> &step) override
    {
      const auto &limited = step.scene.adaptation.limited();
      if (limited.time == step.result.step.time && limited.share > 0.01)
        this->warn("at t = " + rounded(limited.time) + " " +
                   rounded(100 * limited.share) +
                   " % of the points ask for smaller cells (down to " +
                   rounded(limited.smallest) +
                   " m) than <Adaptive grid/Maximum level = " +
                   std::to_string(limited.maximum_level) +
                   "> allows. Raise it, or ask for less.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    MaximumLevel,
    "grid at its maximum level",
    ISOCHOR_ADVICE,
    "adaptive grid: more than 1 % of the material points ask for smaller "
    "cells than `Adaptive grid/Maximum level` allows, by a criterion that "
    "depends on the solution (not by formulas)",
    "raise it, or ask for less (`Target of relative error`, `Cell size in "
    "plastic zones`, ...)")
} // namespace isochor
