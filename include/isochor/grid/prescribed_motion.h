/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_prescribed_motion_h
#define isochor_prescribed_motion_h

#include <isochor/base/expression.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochor
{
  /**
   * What a prescribed displacement u(x, t) adds in the step from @p old_time to
   * @p time. A formula gives the displacement since t = 0, where the body is as
   * it was seeded: nothing has been applied then, whatever the formula's value,
   * and the first step makes up for it.
   */
  template <int dim>
  double
  prescribed_increment(const Expression<dim> &displacement,
                       const Point<dim>      &x,
                       const double           old_time,
                       const double           time)
  {
    return displacement(x, time) -
           (old_time > 0 ? displacement(x, old_time) : 0.);
  }

  /** Velocity and acceleration at the start of a step of size @p dt, of the
   * parabola through the places at its start, middle and end: @p first and
   * @p second are the increments over its halves. */
  inline std::pair<double, double>
  parabola_at_start(const double first, const double second, const double dt)
  {
    double a = 4 * (second - first) / (dt * dt);
    if (std::abs(second - first) <=
        1e-12 * std::max(std::abs(first), std::abs(second)))
      a = 0; // rounding
    return {(first + second) / dt - a * dt / 2, a};
  }
} // namespace isochor

#endif
