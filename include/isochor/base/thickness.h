/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_thickness_h
#define isochor_thickness_h

#include <deal.II/base/numbers.h>

namespace isochor
{
  /**
   * What integrals over a place in the grid are multiplied by: 1 or, in a body
   * of revolution, the circumference 2πr of the ring that the place stands for,
   * @p radius = r its distance from the axis (m).
   */
  inline double
  thickness(const bool axisymmetric, const double radius)
  {
    return axisymmetric ? 2 * dealii::numbers::PI * radius : 1.;
  }
} // namespace isochor

#endif
