/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_structured_grid_h
#define isochor_structured_grid_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/grid/tria_description.h>

#include <isochor/grid/grid_source.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Vertices and simplices of a lattice of n_1 x ... x n_dim boxes, each split
   * into dim! simplices. GridGenerator::
   * subdivided_hyper_rectangle_with_simplices() has no choice of the diagonals,
   * and five tetrahedra per box.
   */
  template <int dim>
  class StructuredGrid
  {
  public:
    /** @param offset By how much of a box the inner planes are moved along each
     * axis, in (-1, 1); none if empty. */
    explicit StructuredGrid(const std::vector<unsigned int> &subdivisions,
                            const std::vector<double>       &offset = {});

    /** All vertices; @p place maps the unit cube to the grid. */
    std::vector<Point<dim>>
    vertices(const std::function<Point<dim>(const Point<dim> &)> &place) const;

    /** All simplices, with positive volume at @p vertices. @p diagonals: "/",
     * "\" or "backslash", "alternating". */
    std::vector<CellData<dim>>
    cells(const std::vector<Point<dim>> &vertices,
          const std::string             &diagonals) const;

    /** The boxes, with the numbers of their simplices in cells(). */
    std::vector<Hypercube<dim>>
    boxes() const;

    /** Whether a vertex lies on a side: left, right, bottom, top, front, back
     * are 0 ... 5. */
    bool
    on_side(const unsigned int vertex, const unsigned int side) const;

  private:
    std::array<unsigned int, dim> n;      ///< boxes per direction
    std::array<unsigned int, dim> stride; ///< of vertex numbers
    std::vector<double>           offset; ///< empty or one per direction
    unsigned int                  n_vertices, n_boxes;

    std::array<unsigned int, dim>
    lattice_indices(unsigned int vertex) const;
    /** Along the axes, from 0. */
    std::array<unsigned int, dim>
    box_indices(unsigned int box) const;
    /** The vertex at corner @p corner, numbered in binary, of a box. */
    unsigned int
    box_vertex(const std::array<unsigned int, dim> &box,
               const unsigned int                   corner) const;
  };
} // namespace isochor

#endif
