/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_cell_filling_h
#define isochor_cell_filling_h

#include <isochor/cut_cells/cell_occupancy.h>
#include <isochor/equations/mixed_kernel.h>

#include <map>

namespace isochor
{
  // What the quadratures that fill cells share.

  /** The weights of the points of each interior cell e share its measure:
   * V0_p ← V0_p |e| / Σ_{q∈e} J_q V0_q, with J at t_n. */
  template <int dim>
  void
  fill_interior_cells(PointArrays<dim>         &points,
                      const CellOccupancy<dim> &occupancy);

  /**
   * Integrate holes, which are interior cells that lost all their points, and
   * @p cells by the volumes given, by a massless point each. It has the state
   * of the points around, in the mean over each vertex and then over the
   * vertices; of several materials that with the largest volume. Collective.
   */
  template <int dim>
  void
  add_hole_points(PointArrays<dim>              &points,
                  const CellOccupancy<dim>      &occupancy,
                  const MixedKernel<dim>        &kernel,
                  std::map<unsigned int, double> cells);
} // namespace isochor

#endif
