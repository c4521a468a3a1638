/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_boundary_points_h
#define isochor_boundary_points_h

#include <isochor/boundary_condition/surface_forces.h>
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
   * They are for quadratures whose material points have no faces (all but
   * CPDI), on grids that do not adapt. A point acts on the nodes of the cell it
   * lies in, if that is occupied. On the surface it may as well lie in an empty
   * cell: it then acts on the nearest occupied one, with the shape functions
   * extrapolated. Where several cells are equally near (a point on a face, or
   * next to a vertex) it acts on all of them, N_I and ∇N_I being the means; so
   * that the choice depends neither on numbering nor on rounding. Each rank
   * holds the points of its cells.
   */
  template <int dim>
  class BoundaryPoints
  {
  public:
    /** @p grid must outlive this object.
     * @param points_per_face See surface_rule(). */
    BoundaryPoints(const BackgroundGrid<dim> &grid,
                   const unsigned int         points_per_face);

    /** Begin on @p faces at t = 0, the same on all ranks. */
    void
    seed(const std::vector<SurfaceFace<dim>> &faces);

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

    /** Valid after locate(). */
    typename SurfaceForces<dim>::Place
    place(const unsigned int b) const;

    /** Append the vertices of all points' nodes. */
    void
    touch_vertices(std::vector<unsigned int> &vertices) const;

    /** All points of all ranks. Collective. */
    std::string
    save_state() const;
    /** To be called with the same state on all ranks; leaves each rank its own.
     */
    void
    load_state(const std::string &state);

  private:
    /** Entries of a point's payload. */
    static constexpr unsigned int surface_entry      = 0;
    static constexpr unsigned int displacement_entry = 1;
    static constexpr unsigned int area_entry         = 1 + dim;
    static constexpr unsigned int F_entry            = 1 + 2 * dim;
    static constexpr unsigned int n_entries          = F_entry + dim * dim;

    /** The cells that point @p b acts on, of the @p occupied ones (ascending,
     * of all ranks). */
    std::vector<unsigned int>
    find_cells(const unsigned int               b,
               const std::vector<unsigned int> &occupied) const;
    void
    clear_stencils();
    void
    add_stencil(const unsigned int b, const std::vector<unsigned int> &cells);

    const BackgroundGrid<dim>         &grid;
    std::unique_ptr<PointLocator<dim>> locator;
    PointRecords<dim>                  records;
    const Quadrature<dim - 1>          rule;

    std::vector<std::size_t>    stencil_start;
    std::vector<unsigned int>   stencil_vertex;
    std::vector<double>         stencil_shape;
    std::vector<Tensor<1, dim>> stencil_gradient;
  };
} // namespace isochor

#endif
