/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_why_points_left_h
#define isochor_why_points_left_h

#include <isochor/scene/scene.h>

#include <string>
#include <vector>

namespace isochor
{
  /** Points have left the grid, as it was reset for the step to come, through
   * @p boundaries: what may be the cause, and what to change. @p walls knows
   * where conditions hold the body. */
  template <int dim>
  std::string
  why_points_left(const std::vector<std::string> &boundaries,
                  const Scene<dim>               &scene,
                  const CellOccupancy<dim>       &walls,
                  const GridReset<dim>           &reset);
} // namespace isochor

#endif
