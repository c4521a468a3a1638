/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A scheme in time of one's own: the backward Euler method,
//   v_{n+1} = Δu / Δt,   a_{n+1} = (v_{n+1} - v_n) / Δt.
// It is of first order, and damps: for motions that come to rest.

#include <isochor/dynamics/time_integrator.h>

namespace isochor
{
  class BackwardEuler : public TimeIntegrator
  {
  public:
    double
    acceleration(const double increment,
                 const double v_n,
                 const double /*a_n*/,
                 const double dt) const override
    {
      return (increment / dt - v_n) / dt;
    }

    double
    velocity(const double v_n,
             const double /*a_n*/,
             const double a,
             const double dt) const override
    {
      return v_n + dt * a;
    }

    double
    stiffness(const double dt) const override
    {
      return 1 / (dt * dt);
    }
  };

  ISOCHOR_REGISTER(TimeIntegrator, BackwardEuler, "backward Euler")
} // namespace isochor
