/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** A first step in which nothing happens. */
  template <int dim>
  class UnloadedScene : public Diagnosis<dim>
  {
  public:
    void
    points_moved(const ConvergedStep<dim> &step) override
    {
      // in dynamics the trial steps may have left nothing to iterate on
      if (step.scene.time.step == 0 && step.result.newton.n_iterations() == 0 &&
          step.result.unknowns.linfty_norm() == 0)
        this->warn("the first step, to t = " + rounded(step.result.step.time) +
                   ", needed no iteration: no load and no displacement acts up "
                   "to then. Set some in <Boundary conditions>, if they don't "
                   "begin later.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    UnloadedScene,
    "nothing loads the scene",
    ISOCHOR_ESSENTIAL,
    "the first step needed no iteration, and nothing moves",
    "set loads; nothing if they begin later")
} // namespace isochor
