/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Velocities that the nodes don't get from the points. */
  template <int dim>
  class Projection : public Diagnosis<dim>
  {
  public:
    void
    step_converged(const ConvergedStep<dim> &step) override
    {
      const double error = step.scene.inertia.projection_error();
      if (!(error < 1e-8))
        this->warn("velocities or accelerations of the points are projected to "
                   "the nodes to " +
                   rounded(error) +
                   " of their size only. Use more <Material points/Points per "
                   "cell>, larger steps or, with CPDI, <Dynamics/Acceleration "
                   "= carried>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    Projection,
    "projection of velocities",
    ISOCHOR_ESSENTIAL,
    "dynamics: conjugate gradients for the projection of velocities or "
    "accelerations to the nodes stop above 1e-8 of the load",
    "more `Material points/Points per cell`, larger steps, or "
    "`Dynamics/Acceleration = carried` with CPDI")
} // namespace isochor
