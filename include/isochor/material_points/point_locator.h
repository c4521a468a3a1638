/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_point_locator_h
#define isochor_point_locator_h

#include <deal.II/base/array_view.h>

#include <isochor/grid/simplex_geometry.h>

#include <memory>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Where a point is. */
  template <int dim>
  struct LocateResult
  {
    /** Active cell index; SimplexGeometry::no_cell if not found. */
    unsigned int cell = SimplexGeometry<dim>::no_cell;

    /** Barycentric coordinates in that cell: none negative, of sum one. Zero
     * if not found. */
    typename SimplexGeometry<dim>::Barycentric barycentric{};

    /** False if the point is outside the grid (or not a number). */
    bool found = false;
  };

  /**
   * Finds the cell of a point: from a hint, the cell that held the point
   * before, by a walk across the face behind which the barycentric coordinate
   * is most negative. The walk can get stuck at a concave boundary or a hole,
   * and may circle; then a search tree over the cells' bounding boxes decides,
   * so that a point of the grid is found whatever the hint.
   *
   * A point on a face or vertex belongs to the hint if that is adjacent;
   * without a hint, to the cell that contains it best, of equals the first. A
   * point outside by rounding, with no barycentric coordinate below
   * -clamp_tolerance, belongs to the cell and gets coordinates clamped to the
   * cell; its location is left alone. Far from the origin, from 1e3 times the
   * height of a cell on, the tolerances grow with the coordinates' rounding.
   *
   * On a grid of several layers (SimplexGeometry::set_layers()) the cell is of
   * the layer of the hint; without a hint, of the first one.
   *
   * locate() may be called concurrently.
   */
  template <int dim>
  class PointLocator
  {
  public:
    /** Inside, in the sense that an adjacent cell needs no look. */
    static constexpr double inside_tolerance = 1e-12;
    /** Inside, if no cell fits better. */
    static constexpr double clamp_tolerance = 1e-10;
    /** Cells a walk visits before the search tree takes over, which then is
     * the cheaper way. */
    static constexpr unsigned int max_steps = 64;

    /** @p geometry is kept by reference, and may be updated at any time
     * between calls of locate(). */
    explicit PointLocator(const SimplexGeometry<dim> &geometry);
    ~PointLocator();

    /** Find the cell of @p x. @p hint_cell is an active cell index or
     * SimplexGeometry::no_cell. */
    LocateResult<dim>
    locate(const Point<dim> &x, const unsigned int hint_cell) const;

    /** Find the cell of x + r for @p x in the grid and near @p cell; if that is
     * outside of the grid, r is shortened until it is inside. */
    LocateResult<dim>
    locate_towards(const Point<dim>  &x,
                   const unsigned int cell,
                   Tensor<1, dim>    &r) const;

    /** The same, but if x + r is outside of the grid, r leads to the place of
     * the grid nearest to it: the same from all @p x that share x + r. */
    LocateResult<dim>
    locate_nearest(const Point<dim>  &x,
                   const unsigned int cell,
                   Tensor<1, dim>    &r) const;

    /** The result for a cell that is already known to hold @p x: found is false
     * if a barycentric coordinate is below -clamp_tolerance. */
    LocateResult<dim>
    locate_in(const Point<dim> &x, const unsigned int cell) const;

    const SimplexGeometry<dim> &
    geometry() const;

  private:
    struct SearchTree;

    LocateResult<dim>
    search(const Point<dim> &x, const unsigned int layer) const;

    const SimplexGeometry<dim>       &simplices;
    const std::unique_ptr<SearchTree> tree;
  };



  /** The outcome of relocate_points(). */
  template <int dim>
  struct Relocation
  {
    /** By point: its new cell; SimplexGeometry::no_cell if lost. */
    std::vector<unsigned int> cells;
    /** By point: as LocateResult::barycentric. */
    std::vector<typename SimplexGeometry<dim>::Barycentric> barycentrics;
    /** Ascending indices of the points that were found in a new cell. */
    std::vector<std::size_t> changed;
    /** Ascending indices of the points outside the grid. */
    std::vector<std::size_t> lost;
  };

  /**
   * Locate many points, @p hint_cells being their previous cells.
   * @throws ExcMessage if the two sizes differ.
   */
  template <int dim>
  Relocation<dim>
  relocate_points(const PointLocator<dim>             &locator,
                  const ArrayView<const Point<dim>>   &locations,
                  const ArrayView<const unsigned int> &hint_cells);


  // ----------------------------------------------------- inline functions

  template <int dim>
  inline const SimplexGeometry<dim> &
  PointLocator<dim>::geometry() const
  {
    return simplices;
  }
} // namespace isochor

#endif
