/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_walls_at_place_h
#define isochor_walls_at_place_h

#include <isochor/cut_cells/cell_occupancy.h>

#include <vector>

namespace isochor
{
  /** Faces of the grid's boundary that a place lies on, or beside by a part of
   * a cell: a wall moves with the body, and a grid that is put back does not.
   */
  template <int dim>
  class WallsAtPlace
  {
  public:
    /** Those at @p x in or beside @p cell; of a place that is @p beyond x,
     * outside of the grid, without the faces that lie between. */
    WallsAtPlace(const CellOccupancy<dim> &occupancy,
                 const unsigned int        cell,
                 const Point<dim>         &x,
                 const Tensor<1, dim>     &beyond = Tensor<1, dim>());

    /** Whether the functions of @p cell, continued to the walls, are there
     * those of nodes on these: what holds the nodes has to hold the place. */
    bool
    are_those_of(const unsigned int cell) const;

    /** From the place to the walls (m). */
    double
    distance() const
    {
      return on_walls.distance(x);
    }

  private:
    const SimplexGeometry<dim> &geometry;
    const Point<dim>            x;
    std::vector<Tensor<1, dim>> normals;
    /** The place, moved onto them. */
    Point<dim> on_walls;
  };
} // namespace isochor

#endif
