/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_region_h
#define isochor_surface_region_h

#include <deal.II/numerics/rtree.h>

#include <isochor/base/expression.h>
#include <isochor/grid/background_grid.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The corners of a face of a cell, or of a part of it. */
  template <int dim>
  using FaceCorners = std::array<Point<dim>, dim>;

  /**
   * A named part of the bodies' surface at t = 0, and the rule which faces
   * belong to it: either those on a boundary of the grid or those at whose
   * centre a condition holds. For loads and interactions alike.
   */
  template <int dim>
  struct SurfaceRegion
  {
    /** The regions of "name: place; name: place", the text of @p parameter. */
    static std::vector<SurfaceRegion<dim>>
    parse(const std::string &text, const std::string &parameter);

    std::string name;
    /** The parameter that asks for it, for messages. */
    std::string parameter;
    /** Either a boundary of the grid, ... */
    bool               on_grid_boundary = false;
    types::boundary_id id               = 0;
    /** ... or where this formula in x, y(, z) is positive at the centre of a
     * face. */
    std::string condition;

    /** Find out whether the place is a boundary of @p grid, and prepare
     * contains(). @throws ExcMessage for the name of a boundary that there is
     * not. */
    void
    find_place(const BackgroundGrid<dim> &grid);

    /** Whether a face of a body's surface belongs to the region that has its
     * centre at @p X at t = 0, to ten digits. */
    bool
    contains(const Point<dim> &X) const;

  private:
    using Entry = std::pair<BoundingBox<dim>, FaceCorners<dim>>;

    std::optional<Expression<dim>> formula;
    /** Of the tenth digit of places in the grid: faces on the border of a
     * region are in it or not whatever the rounding of where they were at t =
     * 0. */
    double per_digit = 1;
    /** The faces of the boundary at t = 0. */
    RTree<Entry> faces;
  };
} // namespace isochor

#endif
