/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_wall_surface_h
#define isochor_wall_surface_h

#include <isochor/grid/background_grid.h>

#include <array>
#include <vector>

namespace isochor
{
  /**
   * A side of the grid as a surface with normals. At each vertex there is one
   * normal into the grid for each smooth piece of the side that ends there or
   * goes through: faces that meet at an angle of less than 40 degrees belong to
   * one piece. It is the mean over the faces of a piece by their area, which
   * makes the flux Σ_I u_I·n_I through a closed surface that of a field u
   * (Engelman, Sani & Gresho, Int. J. Numer. Meth. Fluids 2 (1982) 225-238).
   */
  template <int dim>
  class WallSurface
  {
  public:
    struct Node
    {
      unsigned int   vertex;
      Tensor<1, dim> normal; ///< unit vector
    };

    struct Place
    {
      Tensor<1, dim> normal;
      double         distance; ///< positive on the side of the grid (m)
    };

    /** The faces of @p id, with the vertices where they are on @p grid now. */
    void
    initialize(const BackgroundGrid<dim> &grid, const types::boundary_id id);

    /** By ascending vertex; a vertex on several pieces stands several times. */
    const std::vector<Node> &
    nodes() const
    {
      return all_nodes;
    }

    /** Whether all normals are the same. */
    bool
    is_flat() const
    {
      return flat;
    }

    /**
     * The normal and the distance of @p x from the smooth surface that the
     * faces and normals stand for. At the nearest place p = Σ_v λ_v X_v of the
     * nearest face, n = Σ λ_v n_v, and with d(y) = Σ_v λ_v n_v·(y - X_v) the
     * distance is d(x) - d(p)/2: with normals that are exact at the vertices,
     * that is exact for a surface which is a quadratic function over the face.
     */
    Place
    locate(const Point<dim> &x) const;

  private:
    struct Face
    {
      std::array<Point<dim>, dim>     corners;
      std::array<Tensor<1, dim>, dim> normals; ///< at the corners
    };

    /** In 2D: at an end of a curve the mean is that of one face only. What the
     * normal of the next vertex becomes if it is reflected at that of the face
     * is exact for a circle. */
    void
    improve_ends(const std::vector<std::array<unsigned int, dim>> &vertices);

    std::vector<Node> all_nodes;
    std::vector<Face> faces;
    bool              flat = true;
  };
} // namespace isochor

#endif
