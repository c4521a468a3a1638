/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_faceted_surface_h
#define isochor_faceted_surface_h

#include <isochor/rigid_body/rigid_shape.h>
#include <isochor/rigid_body/surface_mesh.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * A closed surface of segments (2D) or triangles (3D), and the signed
   * distance from it: a tree finds the nearest facet; the sign is that of the
   * angle weighted pseudo-normal of the nearest face, edge or vertex (Bærentzen
   * & Aanæs, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243-253).
   */
  template <int dim>
  class FacetedSurface
  {
  public:
    /** Facets are turned so that they look out of what they enclose; a closed
     * part within another one is a cavity.
     * @param subject What messages start with: "The mesh ... ".
     * @throws ExcMessage for a surface that is not closed or can't be turned
     * so.
     */
    FacetedSurface(SurfaceMesh<dim> mesh, const std::string &subject);
    ~FacetedSurface();

    ClosestPoint<dim>
    closest(const Point<dim> &x) const;

    std::vector<std::array<Point<dim>, dim>>
    facets() const;

    BoundingBox<dim>
    box() const;

  private:
    /** What separates two facets: a vertex in 2D, an edge in 3D. */
    using Ridge = std::array<unsigned int, dim - 1>;

    /** A vertex or an edge by the normals around it. */
    struct Corner
    {
      Tensor<1, dim> pseudo_normal;
      /** Whether all of its facets are in one plane; then it is a part of
       * it. */
      bool is_flat = false;
      /** The direction of the edge that it is, or is on; 0: none. */
      Tensor<1, dim> edge;
    };

    /** The nearest place of a facet; bit i of #corners says that it is not on
     * the face opposite of corner i. */
    struct Candidate
    {
      double       distance_square;
      Point<dim>   point;
      unsigned int corners;
    };

    static Ridge
    ridge(const std::array<unsigned int, dim> &facet, const unsigned int i);
    /** Whether the facets, which share the @p ridge, look to the same side. */
    bool
    agree(const unsigned int facet,
          const unsigned int other,
          const Ridge       &ridge) const;
    void
    find_neighbours(const std::string &subject);
    /** Returns the part of the surface that each facet belongs to. */
    std::vector<unsigned int>
    orient(const std::string &subject);
    void
    turn_outwards(const std::vector<unsigned int> &part);
    void
    turn(const unsigned int facet);
    /** The share of a full circle or of the full solid angle that the facets of
     * @p part appear under from @p x: 1 inside, 0 outside, if they look out. */
    double
    winding(const std::vector<unsigned int> &facets, const Point<dim> &x) const;
    void
    find_normals();
    static Corner
    make_corner(const std::vector<Tensor<1, dim>> &normals,
                const Tensor<1, dim>              &weighted_sum);
    /** The angle of a facet at corner @p i. */
    double
    angle(const unsigned int facet, const unsigned int i) const;
    Candidate
    nearest(const unsigned int facet, const Point<dim> &x) const;
    const Corner &
    corner(const unsigned int facet, const unsigned int corners) const;

    SurfaceMesh<dim>            mesh;
    std::vector<Tensor<1, dim>> normals; ///< of facets
    std::vector<Corner>         at_vertices, at_edges;
    /** By facet, the one behind the ridge opposite of each corner, and the
     * number of that ridge. */
    std::vector<std::array<unsigned int, dim>> neighbours, ridges;

    struct Tree;
    std::unique_ptr<Tree> tree;
  };
} // namespace isochor

#endif
