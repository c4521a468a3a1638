/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_cell_occupancy_h
#define isochor_cell_occupancy_h

#include <isochor/equations/mixed_kernel.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace isochor
{
  /**
   * Which cells the body occupies in a step, and where it ends: full and cut
   * cells, and what the cells hold. Known to each rank for its own cells
   * and some layers of cells around them. What a step does here is
   * proportional to the number of occupied cells.
   *
   * The body ends at vertices with an empty cell around them, and at *open*
   * boundary faces of the grid, those that no condition holds in their normal
   * direction. A held boundary is a wall that the body touches, or a symmetry
   * plane.
   */
  template <int dim>
  class CellOccupancy
  {
  public:
    CellOccupancy(const BackgroundGrid<dim> &grid);

    /** With a new grid. @p free_part(vertex, n) is the square of the part of
     * the unit vector n that displacements are free along at the vertex.
     * @p periodic_vertices are all of those on periodic sides. */
    template <typename FreePart>
    void
    initialize(const FreePart                  &free_part,
               const std::vector<unsigned int> &periodic_vertices);

    /** Take stock of @p points. Collective. */
    void
    update(const PointArrays<dim> &points, const MixedKernel<dim> &kernel);

    /** The content of an occupied cell, over all ranks. */
    struct Content
    {
      unsigned int cell             = 0;
      double       reference_volume = 0; ///< Σ V_0
      double       volume_over_G    = 0; ///< Σ V_0 / G
    };

    /** What @p cell holds; null if it is empty (or far from this rank). */
    const Content *
    content(const unsigned int cell) const
    {
      return entry_of_cell[cell] == numbers::invalid_unsigned_int ?
               nullptr :
               &contents[entry_of_cell[cell]];
    }

    const std::vector<Content> &
    occupied_cells() const
    {
      return contents;
    }

    /** Whether some point touches the node at @p vertex. */
    bool
    is_active(const unsigned int vertex) const
    {
      return vertex_active[vertex] != 0;
    }

    /** Whether an open face of the grid's boundary meets @p vertex. */
    bool
    is_at_open_boundary(const unsigned int vertex) const
    {
      return is_open[vertex] != 0;
    }

    /** Whether a cell at @p vertex has another one on a periodic side. */
    bool
    is_near_periodic_side(const unsigned int vertex) const
    {
      return !near_periodic.empty() && near_periodic[vertex] != 0;
    }

    /** Whether all nodes of @p cell are active. */
    bool
    is_closed(const unsigned int cell) const;

    /** The cells around a vertex. */
    ArrayView<const unsigned int>
    cells_at(const unsigned int vertex) const
    {
      return ArrayView<const unsigned int>(cells_at_vertices.data() +
                                             cells_at_start[vertex],
                                           cells_at_start[vertex + 1] -
                                             cells_at_start[vertex]);
    }

    /** Other ranks with cells within some layers around @p vertex. What one
     * rank knows there, they have to be told. */
    ArrayView<const unsigned int>
    ranks_near(const unsigned int vertex) const
    {
      const unsigned int number = near_number.empty() ? 0 : near_number[vertex];
      if (number == 0)
        return {};
      const std::vector<unsigned int> &near = near_ranks[number - 1];
      return {near.data(), near.size()};
    }

    /** The same for the vertices of @p cell, ascending. */
    std::vector<unsigned int>
    ranks_near_cell(const unsigned int cell) const;

    const BackgroundGrid<dim> &grid;

    /** The cells have other owners. Collective. */
    void
    owners_changed()
    {
      find_near_ranks();
    }

  private:
    /** The rank of one of the cells at a vertex; where there is no other one,
     * of all. */
    unsigned int
    owner_at(const unsigned int vertex) const
    {
      return grid.geometry().owner(cells_at_vertices[cells_at_start[vertex]]);
    }
    void
    find_cells_at_vertices();
    void
    find_near_ranks();
    void
    clear();
    void
    activate(const unsigned int vertex);
    Content &
    entry(const unsigned int cell);
    void
    add_own(const PointArrays<dim> &points, const MixedKernel<dim> &kernel);
    void
    exchange();
    void
    add_received(const std::vector<double> &message);
    /** How many layers of cells around its own a rank has to know, to find the
     * same ties as the others (DiscreteExtension). */
    static constexpr unsigned int n_near_layers = (dim == 2 ? 8 : 4);

    std::vector<unsigned int>  cells_at_start, cells_at_vertices;
    std::vector<unsigned int>  n_cells_at;
    std::vector<unsigned char> is_open, near_periodic; ///< by vertex
    /** Lists of other ranks: first those of one rank only, in order. */
    std::vector<std::vector<unsigned int>> near_ranks;
    /** By vertex, the number from 1 of the list that has the other ranks with
     * cells within n_near_layers around it; 0 if there are none. Empty if there
     * is one rank. */
    std::vector<unsigned int> near_number;

    std::vector<Content>       contents;
    std::vector<unsigned int>  entry_of_cell;
    std::vector<unsigned char> vertex_active;
    std::vector<unsigned int>  active_list;
  };



  template <int dim>
  template <typename FreePart>
  void
  CellOccupancy<dim>::initialize(
    const FreePart                  &free_part,
    const std::vector<unsigned int> &periodic_vertices)
  {
    const unsigned int n_vertices = grid.triangulation().n_vertices();
    contents.clear();
    active_list.clear();
    near_ranks.clear();
    entry_of_cell.assign(grid.geometry().n_cells(),
                         numbers::invalid_unsigned_int);
    vertex_active.assign(n_vertices, 0);
    is_open.assign(n_vertices, 0);
    find_cells_at_vertices();
    find_near_ranks();

    near_periodic.assign(periodic_vertices.empty() ? 0 : n_vertices, 0);
    for (const unsigned int v : periodic_vertices)
      for (const unsigned int cell : cells_at(v))
        for (const unsigned int other : grid.geometry().vertex_indices(cell))
          near_periodic[other] = 1;

    for (const BoundaryFace &face : grid.boundary_faces())
      {
        const SimplexGeometry<dim> &geometry = grid.geometry();
        Tensor<1, dim> n = geometry.gradients(face.cell)[face.opposite_vertex];
        n /= n.norm();
        double largest = 0;
        for (unsigned int v = 0; v <= dim; ++v)
          if (v != face.opposite_vertex)
            largest =
              std::max(largest,
                       free_part(geometry.vertex_indices(face.cell)[v], n));
        for (unsigned int v = 0; v <= dim && largest > 0.5; ++v)
          if (v != face.opposite_vertex)
            is_open[geometry.vertex_indices(face.cell)[v]] = 1;
      }
  }
} // namespace isochor

#endif
