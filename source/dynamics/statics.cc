/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/time_integrator.h>

namespace isochor
{
  /** Equilibrium at all times: velocities and accelerations do not exist. */
  class Statics : public TimeIntegrator
  {
  public:
    bool
    has_inertia() const override
    {
      return false;
    }

    double
    acceleration(const double /*increment*/,
                 const double /*v_n*/,
                 const double /*a_n*/,
                 const double /*dt*/) const override
    {
      return 0;
    }

    double
    velocity(const double /*v_n*/,
             const double /*a_n*/,
             const double /*a*/,
             const double /*dt*/) const override
    {
      return 0;
    }

    double
    stiffness(const double /*dt*/) const override
    {
      return 0;
    }
  };

  ISOCHOR_REGISTER(TimeIntegrator, Statics, "statics")
} // namespace isochor
