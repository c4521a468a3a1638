/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_seeding_h
#define isochor_surface_seeding_h

#include <deal.II/base/quadrature.h>

#include <isochor/material_points/body_shape.h>
#include <isochor/material_points/surface_region.h>

#include <functional>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Length (2D) or area (3D). */
  template <int dim>
  double
  measure(const FaceCorners<dim> &face);

  template <int dim>
  Point<dim>
  centre_of(const FaceCorners<dim> &face)
  {
    Point<dim> centre;
    for (const Point<dim> &corner : face)
      centre += corner / static_cast<double>(dim);
    return centre;
  }

  /**
   * Simplices that make up the part of @p face where @p inside holds. Edges of
   * the part are followed by 16 (2D) or 8 (3D) samples along a side, and
   * exactly between these if they are straight.
   */
  template <int dim>
  std::vector<FaceCorners<dim>>
  covered_part(const FaceCorners<dim>                        &face,
               const std::function<bool(const Point<dim> &)> &inside);

  /** A face of the body's surface at t = 0, or a part of one. */
  template <int dim>
  struct SurfaceFace
  {
    FaceCorners<dim> corners;
    Tensor<1, dim>   area; ///< outward
    unsigned int     surface;
    unsigned int     cell; ///< where to begin the search for its points
  };

  /**
   * Where boundary points are put on a face, with fractions of its area.
   * @param n_points A Gauss rule in 2D; in 3D as material_point_rule<2>.
   */
  template <int dim>
  Quadrature<dim - 1>
  surface_rule(const unsigned int n_points);

  /** The place on @p face that has the coordinates @p x on the unit segment
   * (triangle). */
  template <int dim>
  Point<dim>
  place_on_face(const FaceCorners<dim> &face, const Point<dim - 1> &x)
  {
    Point<dim> place = face[0];
    for (unsigned int d = 0; d + 1 < dim; ++d)
      place += x[d] * (face[d + 1] - face[0]);
    return place;
  }

  /** What seed_surfaces() has found. */
  template <int dim>
  struct SeededSurfaces
  {
    std::vector<SurfaceFace<dim>> faces;
    /** By surface: the area that the body covers, and that of all faces that
     * were in question (m^(dim-1)). */
    std::vector<double> covered, candidate;
  };

  /**
   * The surfaces of the body at t = 0, as parts of faces. A surface on a
   * boundary of the grid consists of the faces there; one with a condition, of
   * the faces between the @p occupied cells (ascending, of all ranks) and the
   * rest, or, if @p body_mesh is not empty, of the boundary faces of this gmsh
   * mesh. Of faces of the grid only what belongs to the body counts. The same
   * on all ranks.
   * @throws ExcMessage if the body has nothing on a surface.
   */
  template <int dim>
  SeededSurfaces<dim>
  seed_surfaces(const BackgroundGrid<dim>             &grid,
                const BodyShape<dim>                  &shape,
                const std::vector<unsigned int>       &occupied,
                const std::vector<SurfaceRegion<dim>> &surfaces,
                const std::string                     &body_mesh);

  /** What was found of each of the @p surfaces, a line each: its area (2D: its
   * length, of the section) at t = 0, and the box around it. */
  template <int dim>
  std::string
  describe_surfaces(const SeededSurfaces<dim>             &seeded,
                    const std::vector<SurfaceRegion<dim>> &surfaces);
} // namespace isochor

#endif
