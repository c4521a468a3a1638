/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_prescribed_motion_h
#define isochor_prescribed_motion_h

#include <isochor/expression.h>

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
} // namespace isochor

#endif
