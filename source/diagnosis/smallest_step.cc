/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Steps that should be smaller, but may not. */
  template <int dim>
  class SmallestStep : public Diagnosis<dim>
  {
  public:
    void
    step_converged(const ConvergedStep<dim> &step) override
    {
      const LoadStepping &time = step.scene.time;
      if (!time.follows_error())
        return;
      if (time.exceeds_error() || time.cells_crossed > 1)
        this->warn("up to t = " + rounded(step.result.step.time) +
                   ", after a step of <Time/Minimum step size>, displacements "
                   "are wrong by " +
                   rounded(time.error) + " m, and the body has moved by " +
                   rounded(time.cells_crossed) +
                   " cells. Allow smaller steps, or a larger <Time/Tolerated "
                   "error>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    SmallestStep,
    "the smallest step is too large",
    ISOCHOR_ESSENTIAL,
    "dynamics with `Time/Tolerated error`: after a step that may not be "
    "smaller, displacements are wrong by more than that, or the body has moved "
    "by more than a cell and may go through what it should meet",
    "a smaller `Time/Minimum step size`, or a larger error: what jumps, as the "
    "velocity of nodes that meet a wall, isn't resolved by any step")
} // namespace isochor
