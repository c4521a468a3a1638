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
   * cells, holes, and what the cells hold. Known to each rank for its own cells
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
     * @p compares_with_seeding: points may come into cells that are smaller
     * than those that they were seeded in. @p periodic_vertices are all of
     * those on periodic sides. */
    template <typename FreePart>
    void
    initialize(const FreePart                  &free_part,
               const bool                       compares_with_seeding,
               const std::vector<unsigned int> &periodic_vertices);

    /**
     * Take stock of @p points. If @p find_holes, a few empty cells in a row
     * that occupied ones enclose face by face become holes; these then count
     * as occupied. Where cells are smaller than those that the points were
     * seeded in, a gap between few of them is many cells: if that may be, it
     * also is a hole if it isn't larger than a few points as they were seeded.
     * Collective.
     */
    void
    update(const PointArrays<dim> &points,
           const MixedKernel<dim> &kernel,
           const bool              find_holes);

    /** The content of an occupied cell, over all ranks. */
    struct Content
    {
      unsigned int cell             = 0;
      double       volume           = 0; ///< Σ J V_0 at t_n
      double       reference_volume = 0; ///< Σ V_0
      double       volume_times_G   = 0; ///< Σ V_0 G
      double       volume_over_G    = 0; ///< Σ V_0 / G, not of holes
      /** Σ J V_0 J V_s, with the volumes V_s of the points as they were seeded
       * (DomainCorners::seeded_volume). */
      double volume_times_seeded = 0;
      /** Without points: the measure of the cell is its volume, with J and G in
       * the mean of the cells around the hole. */
      bool is_hole = false;
    };

    /** Whether an enclosed gap is too large for a hole and counts as outside;
     * where gaps are compared with the seeding, of those of at most most_cells.
     * Collective. */
    bool
    has_cavities() const;

    /** Whether gaps of more than a few cells may be holes, if they are compared
     * with the seeding: not before it is known that the body has no cavities of
     * its own. */
    void
    allow_large_holes(const bool are_allowed)
    {
      large_holes_are_allowed = are_allowed;
    }

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

    /** Whether one of the cells at @p vertex is empty. */
    bool
    is_at_empty_cell(const unsigned int vertex) const
    {
      return n_occupied_at[vertex] < n_cells_at[vertex];
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

    /** Whether the body surely fills the occupied @p cell. */
    bool
    is_interior(const unsigned int cell) const;

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
    void
    find_hole_cells();
    /** @p cell and the empty cells connected with it, as far as needed to see
     * whether they are more than a hole has. */
    std::set<unsigned int>
    empty_cells_around(const unsigned int cell) const;
    /** The content of each cell of a gap, in units of the cell's measure: J and
     * G in the mean of the cells around. Not a hole if the gap is too large or
     * not enclosed. */
    Content
    fill_of_gap(const std::set<unsigned int> &gap);
    double
    volume_of(const std::set<unsigned int> &gap) const;
    /** Whether an enclosed gap between points, one of which has the volume
     * @p point as it was seeded, is as small as a hole. */
    bool
    is_small(const std::set<unsigned int> &gap, const double point) const;
    /** Whether each cell of @p gap can be reached from each other one in at
     * most largest_extent steps to neighbours. */
    bool
    is_compact(const std::set<unsigned int> &gap) const;
    /** How many layers of cells around its own a rank has to know to agree with
     * the others on all holes in them. */
    unsigned int
    n_near_layers() const
    {
      return (compares_with_seeding ? largest_extent : largest_hole) + 2;
    }

    /** Cells of a hole, at most, as long as the points are in the cells that
     * they were seeded for. */
    static constexpr unsigned int largest_hole = (dim == 2 ? 6 : 2);
    /** If it is compared with the seeding, otherwise: its volume, in those of
     * points as they were seeded, its cells, and the steps from one to another.
     * The volume is that of two cells of the original grid with the usual
     * number of points, less than largest_hole allows there. */
    static constexpr unsigned int most_points    = (dim == 2 ? 8 : 16);
    static constexpr unsigned int most_cells     = 128;
    static constexpr unsigned int largest_extent = (dim == 2 ? 12 : 6);
    bool compares_with_seeding = false, large_holes_are_allowed = false;

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
    bool                       has_cavity = false; ///< as this rank knows
    std::vector<unsigned int>  entry_of_cell;
    std::vector<unsigned char> vertex_active;
    std::vector<unsigned int>  active_list;
    std::vector<unsigned int>  n_occupied_at;
  };



  template <int dim>
  template <typename FreePart>
  void
  CellOccupancy<dim>::initialize(
    const FreePart                  &free_part,
    const bool                       compare_with_seeding,
    const std::vector<unsigned int> &periodic_vertices)
  {
    compares_with_seeding         = compare_with_seeding;
    const unsigned int n_vertices = grid.triangulation().n_vertices();
    contents.clear();
    active_list.clear();
    near_ranks.clear();
    entry_of_cell.assign(grid.geometry().n_cells(),
                         numbers::invalid_unsigned_int);
    vertex_active.assign(n_vertices, 0);
    n_occupied_at.assign(n_vertices, 0);
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
