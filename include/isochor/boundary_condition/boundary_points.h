/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_boundary_points_h
#define isochor_boundary_points_h

#include <isochor/equations/body_surface.h>
#include <isochor/equations/equation_term.h>
#include <isochor/material_points/relocation.h>
#include <isochor/material_points/surface_seeding.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * Boundary material points: massless points that lie on the surface of the
   * body and follow it through the grid. Each carries a piece of the surface as
   * the area vector A_0 (outward normal times area) of the reference
   * configuration; the present one is Nanson's a = det F F^{-T} A_0 with the
   * deformation gradient F of the body at the point.
   *
   * Where the material points see functions that are linear on their domains
   * (CPDI), boundary points are made anew at each reset of the grid, on the
   * outer faces of the domains (BodySurface) as these are then, and see the
   * functions of their domain: loads are integrated like stresses, and a
   * homogeneous stress is in equilibrium with its traction wherever the surface
   * lies. Place, displacement and F are those of the domain there. Each rank
   * holds those of its domains.
   *
   * Other points act on the nodes of the cell they lie in, if that is occupied.
   * On the surface they may as well lie in an empty cell: they then act on the
   * nearest occupied one, with the shape functions extrapolated. Where several
   * cells are equally near (a point on a face, or next to a vertex) a point
   * acts on all of them, N_I and ∇N_I being the means; so that the choice
   * depends neither on numbering nor on rounding. With points whose domains
   * reach beyond their cells (CPDI), what counts is not whether a cell is
   * occupied but whether all of its nodes are active. Each rank holds the
   * points of its cells.
   */
  template <int dim>
  class BoundaryPoints
  {
  public:
    /** @p grid must outlive this object.
     * @param points_per_face See surface_rule(). */
    BoundaryPoints(const BackgroundGrid<dim> &grid,
                   const unsigned int         points_per_face);

    const BackgroundGrid<dim> &
    background_grid() const
    {
      return grid;
    }

    /** Whether points lie on faces of domains when @p body has been set up; see
     * above. Collective. */
    bool
    are_on_domains(const PointArrays<dim> &body) const;
    /** These faces at t = 0 (but for SurfaceFace::area and cell), by the
     * centres of which @p regions have them; what is between bodies belongs to
     * none. The same on all ranks. Collective.
     * @throws ExcMessage if a region has none. */
    SeededSurfaces<dim>
    find_on_domains(const std::vector<SurfaceRegion<dim>> &regions,
                    const PointArrays<dim>                &body) const;

    /** Begin on the surfaces of the @p regions at t = 0: on faces of domains,
     * or, without, on @p faces, the same on all ranks. Collective. */
    void
    seed(const std::vector<SurfaceRegion<dim>> &regions,
         const std::vector<SurfaceFace<dim>>   &faces,
         const PointArrays<dim>                &body);

    /** The grid has been replaced: go to the new cells. Points in cells that
     * are too large for these are split in two (2D) or four (3D) side by side,
     * each with its part of the area; force and moment of a uniform load stay.
     * Collective. */
    void
    change_grid();

    /** Find the nodes each point acts on, and bring the points to the ranks
     * that own their cells. For a step on a grid that was reset; while the grid
     * is kept (see GridReset) they stay. Collective. */
    void
    locate(const PointArrays<dim> &body);

    /** Move with the displacement increments in @p unknowns. At the end of a
     * step. */
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns);

    unsigned int
    size() const
    {
      return records.size();
    }

    /** Index of the surface of point @p b. */
    unsigned int
    surface(const unsigned int b) const
    {
      return static_cast<unsigned int>(records.payload(b)[surface_entry]);
    }

    Point<dim>
    reference_location(const unsigned int b) const
    {
      return Point<dim>(records.locations[b] - displacement(b));
    }

    /** Total displacement up to the start of the step. */
    Tensor<1, dim>
    displacement(const unsigned int b) const;

    /** A_0 (m^(dim-1)). */
    Tensor<1, dim>
    reference_area(const unsigned int b) const;

    /** F at the start of the step. */
    Tensor<2, dim>
    F(const unsigned int b) const;

    /** The nodes of a point, by vertex, with N_I and, with respect to the grid
     * at the start of the step, ∇_n N_I. */
    struct Stencil
    {
      unsigned int          n_nodes;
      const unsigned int   *vertex;
      const double         *shape;
      const Tensor<1, dim> *gradient;
    };

    /** Valid after locate(). */
    Stencil
    stencil(const unsigned int b) const
    {
      const std::size_t begin = stencil_start[b];
      return {static_cast<unsigned int>(stencil_start[b + 1] - begin),
              stencil_vertex.data() + begin,
              stencil_shape.data() + begin,
              stencil_gradient.data() + begin};
    }

    /** Append the vertices of all points' nodes. */
    void
    touch_vertices(std::vector<unsigned int> &vertices) const;

    /** All points of all ranks as text. Collective. */
    std::string
    save_state() const;
    /** To be called with the same text on all ranks, with the @p regions of
     * seed(); leaves each rank its own. */
    void
    load_state(const std::vector<SurfaceRegion<dim>> &regions,
               const std::string                     &state);

  private:
    /** Split points that are too large; how many there were. */
    unsigned int
    split();
    /** Bring them to the ranks that own their cells, and find their nodes. */
    void
    locate_in_cells(const PointArrays<dim> &body);
    static bool
    is_of(const typename BodySurface<dim>::Face &face,
          const SurfaceRegion<dim>              &region)
    {
      return !face.meets_other_body &&
             region.contains(BodySurface<dim>::centre(face));
    }
    /** Make points on faces of domains. */
    void
    add_points_on_domains(const PointArrays<dim> &body);
    /** A new id for each of @p n points of this rank, the first of them.
     * Collective. */
    types::particle_index
    new_ids(const std::size_t n) const;

    /** Entries of a point's payload. */
    static constexpr unsigned int surface_entry      = 0;
    static constexpr unsigned int displacement_entry = 1;
    static constexpr unsigned int area_entry         = 1 + dim;
    static constexpr unsigned int F_entry            = 1 + 2 * dim;
    static constexpr unsigned int n_entries          = F_entry + dim * dim;

    class Candidates;

    std::vector<unsigned int>
    find_cells(const unsigned int b, const Candidates &candidates) const;
    void
    clear_stencils();
    void
    add_stencil(const unsigned int b, const std::vector<unsigned int> &cells);

    const BackgroundGrid<dim>         &grid;
    std::unique_ptr<PointLocator<dim>> locator;
    PointRecords<dim>                  records;
    const Quadrature<dim - 1>          rule;
    bool                               on_domains = false;
    std::vector<SurfaceRegion<dim>>    regions; ///< of points on domains

    std::vector<std::size_t>    stencil_start;
    std::vector<unsigned int>   stencil_vertex;
    std::vector<double>         stencil_shape;
    std::vector<Tensor<1, dim>> stencil_gradient;
  };
} // namespace isochor

#endif
