/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_wall_surface_h
#define isochor_wall_surface_h

#include <isochor/grid/background_grid.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace isochor
{
  /** Faces of walls belong to one smooth surface if the cosine of the angle
   * between their normals is more: 40 degrees. */
  inline double
  cosine_of_smooth_walls()
  {
    return std::cos(40. / 180. * numbers::PI);
  }

  /**
   * A side of the grid as a surface with normals. At each vertex there is one
   * normal into the grid for each smooth piece of the side that ends there or
   * goes through: faces that meet at an angle of less than 40 degrees belong to
   * one piece. It is the mean over the faces of a piece by their area, which
   * makes the flux Σ_I u_I·n_I through a closed surface that of a field u
   * (Engelman, Sani & Gresho, Int. J. Numer. Meth. Fluids 2 (1982) 225-238).
   *
   * A surface may consist of several named boundaries. Each of them has its own
   * WallSurface, which knows the others that it goes on in: a piece across two
   * of them has one normal, and belongs to the one that is named first.
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

    /** Whether two boundaries (by their numbers in a list of ids) are parts of
     * one surface at a vertex if they meet there at less than 40 degrees. */
    using GoesOn = std::function<bool(const unsigned int first,
                                      const unsigned int second,
                                      const unsigned int vertex)>;

    /** How far a vertex is moved along its normal (m), by its number. */
    using Shift = std::function<double(const unsigned int vertex)>;

    /** A face of the surface. */
    struct Face
    {
      unsigned int                    boundary; ///< its number in the ids
      unsigned int                    cell;
      std::array<unsigned int, dim>   vertices;
      std::array<Point<dim>, dim>     corners;
      std::array<Tensor<1, dim>, dim> normals; ///< at the corners
      Tensor<1, dim>                  normal;  ///< of the plane face
    };

    /** The faces of @p id, with the vertices where they are on @p grid now. */
    void
    initialize(const BackgroundGrid<dim> &grid, const types::boundary_id id)
    {
      initialize(grid, {id}, 0, [](unsigned int, unsigned int, unsigned int) {
        return true;
      });
    }

    /** The same of number @p own of the boundaries @p ids, of which others may
     * be parts of the same surface. */
    void
    initialize(const BackgroundGrid<dim>             &grid,
               const std::vector<types::boundary_id> &ids,
               const unsigned int                     own,
               const GoesOn                          &goes_on)
    {
      initialize(grid, grid.geometry().vertices(), ids, own, goes_on, {});
    }

    /** The same with the @p vertices of the grid given; with a @p shift, those
     * of the surface are then moved along their normals. */
    void
    initialize(const BackgroundGrid<dim>             &grid,
               const std::vector<Point<dim>>         &vertices,
               const std::vector<types::boundary_id> &ids,
               const unsigned int                     own,
               const GoesOn                          &goes_on,
               const Shift                           &shift);

    /** Of what it goes on in, too. */
    const std::vector<Face> &
    faces() const
    {
      return all_faces;
    }

    /** By ascending vertex; a vertex on several pieces stands several times. A
     * piece that goes on in a boundary before this one is left out. */
    const std::vector<Node> &
    nodes() const
    {
      return all_nodes;
    }

    /** Whether all normals are the same, of what it goes on in, too. */
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
     * Only faces count whose normals are within 45 degrees of @p direction, if
     * there are any: beside a corner the others belong to another side.
     */
    Place
    locate(const Point<dim>     &x,
           const Tensor<1, dim> &direction = Tensor<1, dim>()) const;

  private:
    /** A face of one of the boundaries. */
    struct NamedFace
    {
      std::array<unsigned int, dim> vertices;
      Tensor<1, dim>                area; ///< over dim, into the grid
      unsigned int                  boundary, cell;
    };

    /** A smooth piece at a vertex. */
    struct Piece
    {
      unsigned int vertex   = numbers::invalid_unsigned_int;
      unsigned int boundary = numbers::invalid_unsigned_int; ///< the first one
      Tensor<1, dim>            normal;
      std::vector<unsigned int> faces;
    };

    /** Give the faces the normals of their pieces. */
    void
    set_normals(const std::vector<NamedFace> &named,
                std::vector<Piece>           &pieces);

    /** Move the corners of the faces along the normals of the pieces, which
     * then are those of the surface there. */
    void
    move_corners(const Shift            &shift,
                 std::vector<NamedFace> &named,
                 std::vector<Piece>     &pieces);

    /** In 2D: at an end of a curve the mean is that of one face only. What the
     * normal of the next vertex becomes if it is reflected at that of the face
     * is exact for a circle. */
    void
    improve_ends(const std::vector<NamedFace> &named,
                 std::vector<Piece>           &pieces);

    static std::vector<NamedFace>
    faces_of(const BackgroundGrid<dim>             &grid,
             const std::vector<Point<dim>>         &vertices,
             const std::vector<types::boundary_id> &ids);

    static std::vector<Piece>
    find_pieces(const std::vector<NamedFace> &named, const GoesOn &goes_on);

    /** Keep the faces of the surface that number @p own is part of. */
    static void
    leave_out_others(std::vector<NamedFace> &named,
                     const unsigned int      n_boundaries,
                     const unsigned int      own,
                     const GoesOn           &goes_on);

    std::vector<Node> all_nodes;
    std::vector<Face> all_faces;
    bool              flat = true;
  };
} // namespace isochor

#endif
