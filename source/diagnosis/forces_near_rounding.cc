/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Loads in other units than the stiffness. */
  template <int dim>
  class ForcesNearRounding : public Diagnosis<dim>
  {
  public:
    void
    points_moved(const ConvergedStep<dim> &step) override
    {
      constexpr double    small = 0.01, large = 1e6;
      const NewtonReport &newton   = step.result.newton;
      const double        residual = newton.iterations.back().displacement;
      // a body at rest, or carried along, has no other forces
      if (step.scene.has_inertia() || residual <= small ||
          newton.force_scale <= large * step.zero_force)
        return;
      this->warn("at t = " + rounded(step.result.step.time) +
                 " residual forces of " + rounded(100 * residual) +
                 " % of the forces can't be told from rounding: the forces are "
                 "tiny beside the stiffness. Are loads and <Material/Young "
                 "modulus> in the same units?");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    ForcesNearRounding,
    "forces near rounding",
    ISOCHOR_ESSENTIAL,
    "statics: Newton's method has stopped at residual forces of more than 1 % "
    "of the forces, since rounding errors of the stiffness are larger "
    "(`Relative residual of forces` in the statistics). Not of forces of "
    "strains below some 1e-8, which rounding errors of a body that is carried "
    "along may be",
    "loads in the units of the stiffness")
} // namespace isochor
