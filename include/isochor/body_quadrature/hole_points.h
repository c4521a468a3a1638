/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_hole_points_h
#define isochor_hole_points_h

#include <isochor/cut_cells/cell_occupancy.h>
#include <isochor/equations/mixed_kernel.h>

namespace isochor
{
  /**
   * Integrate holes, which are interior cells that lost all their points, by a
   * massless point each. It has the state of the points around, in the mean
   * over each vertex and then over the vertices; of several materials that with
   * the largest volume. Collective.
   */
  template <int dim>
  void
  add_hole_points(PointArrays<dim>         &points,
                  const CellOccupancy<dim> &occupancy,
                  const MixedKernel<dim>   &kernel);
} // namespace isochor

#endif
