/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_bare_cells_h
#define isochor_bare_cells_h

#include <isochor/grid/background_grid.h>
#include <isochor/material_points/point_arrays.h>

#include <set>

namespace isochor
{
  /** Cells inside of the body that hold no points and resist nothing. */
  struct BareCells
  {
    /** The largest point, as a part of its cell. */
    double largest_point = 0;
    /** Those of this rank; of all, their number and the part of the body's
     * volume that they have. None if that doesn't matter. */
    std::set<unsigned int> cells;
    double                 n = 0, part = 0;
  };

  /**
   * The cells without points whose centroids lie in what a point stands for,
   * the ball of the point's volume at t = 0, deformed by F. A few are the
   * method's own error; they are to be expected as soon as points of half a
   * cell's volume move through the grid. Collective.
   */
  template <int dim>
  BareCells
  find_bare_cells(const BackgroundGrid<dim> &grid,
                  const PointArrays<dim>    &points);

  /** @throws ExcMessage if the cells that hold the body fall into more pieces,
   * not connected by any face, than with bare cells. Collective. */
  template <int dim>
  void
  assert_in_one_piece(const BackgroundGrid<dim> &grid,
                      const PointArrays<dim>    &points);
} // namespace isochor

#endif
