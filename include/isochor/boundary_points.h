/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_boundary_points_h
#define isochor_boundary_points_h

#include <isochor/equation_term.h>
#include <isochor/expression.h>
#include <isochor/relocation.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** A named part of the body's surface at t = 0. */
  template <int dim>
  struct BodySurface
  {
    std::string name;
    /** Either a boundary of the grid, ... */
    bool               on_grid_boundary = false;
    types::boundary_id id               = 0;
    /** ... or where this formula in x, y(, z) is positive at the centre of a
     * face. */
    std::string condition;
  };

  /**
   * Boundary material points: massless points that lie on the surface of the
   * body and follow it through the grid. Each carries a piece of the surface as
   * the area vector A_0 (outward normal times area) of the reference
   * configuration; the present one is Nanson's a = det F F^{-T} A_0 with the
   * deformation gradient F of the body at the point.
   *
   * A point acts on the nodes of the occupied cell it lies in. On the surface
   * it may as well lie in an empty cell: it then acts on the nearest occupied
   * one, with the shape functions extrapolated. Each rank holds the points of
   * its cells.
   */
  template <int dim>
  class BoundaryPoints
  {
  public:
    /** @p grid must outlive this object. */
    explicit BoundaryPoints(const BackgroundGrid<dim> &grid);

    /**
     * Seed the faces between the occupied cells of the grid and the rest, as
     * the body is now (t = 0), or, if @p body_mesh is not empty, the boundary
     * faces of this gmsh mesh. @p points_per_face in 3D as for
     * material_point_rule<2>(), in 2D any. Collective.
     * @throws ExcMessage if a surface has no face.
     */
    void
    seed(const PointArrays<dim>              &body,
         const std::vector<BodySurface<dim>> &surfaces,
         const unsigned int                   points_per_face,
         const std::string                   &body_mesh);

    /** Find the points' cells and bring them to the ranks of these. At the
     * start of a step on a grid that was reset; while the grid is kept (see
     * GridReset) cells and shape functions stay. Collective. */
    void
    locate(const StepContext<dim> &step);

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

    /** The occupied cell point @p b acts on. Valid after locate(). */
    unsigned int
    cell(const unsigned int b) const
    {
      return records.cells[b];
    }

    /** The cell's N_I at point @p b. Valid after locate(). */
    const typename SimplexGeometry<dim>::Barycentric &
    shape(const unsigned int b) const
    {
      return shapes[b];
    }

    /** All points of all ranks as text. Collective. */
    std::string
    save_state() const;
    /** To be called with the same text on all ranks; leaves each its own. */
    void
    load_state(const std::string &state);

  private:
    /** Entries of a point's payload. */
    static constexpr unsigned int surface_entry      = 0;
    static constexpr unsigned int displacement_entry = 1;
    static constexpr unsigned int area_entry         = 1 + dim;
    static constexpr unsigned int F_entry            = 1 + 2 * dim;
    static constexpr unsigned int n_entries          = 1 + 2 * dim + dim * dim;

    void
    seed_face(const std::array<Point<dim>, dim> &corners,
              const Tensor<1, dim>              &area,
              const unsigned int                 surface,
              const unsigned int                 points_per_face,
              const unsigned int                 cell);
    std::vector<unsigned int>
    seed_faces_of(const SimplexGeometry<dim>          &geometry,
                  const std::vector<unsigned int>     &occupied,
                  const std::vector<BodySurface<dim>> &surfaces,
                  const unsigned int                   points_per_face,
                  const bool                           of_grid);
    unsigned int
    nearest_occupied(const Point<dim>                &x,
                     const unsigned int               start,
                     const std::vector<unsigned int> &occupied) const;

    const BackgroundGrid<dim>                              &grid;
    std::unique_ptr<PointLocator<dim>>                      locator;
    PointRecords<dim>                                       records;
    std::vector<typename SimplexGeometry<dim>::Barycentric> shapes;
  };
} // namespace isochor

#endif
