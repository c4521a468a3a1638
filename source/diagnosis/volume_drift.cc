/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/transfer/volume_error.h>

#include <algorithm>

namespace isochor
{
  /** Volumes of points that are not what the pressure asks for. */
  template <int dim>
  class VolumeDrift : public Diagnosis<dim>
  {
  public:
    void
    points_moved(const ConvergedStep<dim> &converged) override
    {
      const StepContext<dim> &step = converged.result.step;
      if (!step.mixed())
        return;
      constexpr double  tolerated = 0.05;
      const VolumeError error     = volume_error(step,
                                             converged.result.points,
                                             converged.volume_excess,
                                             tolerated);
      if (error.largest() > tolerated)
        this->warn(
          "at t = " + rounded(step.time) + " the volumes of points differ by " +
          rounded(100 * error.largest()) + " % (root mean square" +
          (error.in_body > tolerated ? "" :
                                       ", weighted with the shear strain") +
          ") from what the pressure asks for: stresses aren't to be "
          "trusted. Use smaller cells where the deformation is "
          "large.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    VolumeDrift,
    "volume drift",
    ISOCHOR_ESSENTIAL,
    "u-p: the volumes of the material points differ by more than 5 % (root "
    "mean square, over the body or weighted with the shear strain \\|dev "
    "b\\|/(tr b/3), b = F Fᵀ, which a neck or the soil beside a pile has) from "
    "those of the pressure, θ^e ≠ p/K: they differ from cell to cell more than "
    "the pressure can follow. Loads may still look right, displacements and "
    "stresses are not. With more than 20 % in material that flows the step "
    "fails",
    "smaller cells where the deformation is large")
} // namespace isochor
