/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nearest_cells_h
#define isochor_nearest_cells_h

#include <isochor/grid/simplex_geometry.h>

#include <functional>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** From @p x to the nearest place of the simplex @p cell (m), zero inside. */
  template <int dim>
  Tensor<1, dim>
  way_to_cell(const SimplexGeometry<dim> &geometry,
              const unsigned int          cell,
              const Point<dim>           &x);

  /** Euclidean distance between @p x and the simplex @p cell (m), zero
   * inside. */
  template <int dim>
  double
  distance_to_cell(const SimplexGeometry<dim> &geometry,
                   const unsigned int          cell,
                   const Point<dim>           &x);

  /** Edge of the cube of which @p cell is the part that a simplex with dim
   * edges along the axes cuts off: (dim! |e|)^(1/dim) (m). */
  template <int dim>
  double
  cell_size(const SimplexGeometry<dim> &geometry, const unsigned int cell);

  template <int dim>
  Point<dim>
  cell_centroid(const SimplexGeometry<dim> &geometry, const unsigned int cell);

  /**
   * Of the cells that @p is_candidate accepts, those nearest to @p x, ascending
   * by number: the nearest one and all others that are as near, but for 1e-8 of
   * its size. What follows from all of them alike depends neither on the
   * numbering of cells nor on rounding; one of them alone would. Empty if none
   * is nearer than @p largest_distance.
   *
   * The search goes from neighbour to neighbour in the order of their distance,
   * beginning at @p start, best a cell near x.
   */
  template <int dim>
  std::vector<unsigned int>
  nearest_cells(const SimplexGeometry<dim>                    &geometry,
                const Point<dim>                              &x,
                const unsigned int                             start,
                const std::function<bool(const unsigned int)> &is_candidate,
                const double largest_distance);
} // namespace isochor

#endif
