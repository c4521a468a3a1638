/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_faceted_surface_h
#define isochor_faceted_surface_h

#include <deal.II/numerics/rtree.h>

#include <isochor/rigid_body/closed_mesh.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <array>
#include <string>
#include <utility>
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
    /** See ClosedMesh. */
    FacetedSurface(SurfaceMesh<dim> mesh, const std::string &subject);
    FacetedSurface(const FacetedSurface &) = delete;
    FacetedSurface &
    operator=(const FacetedSurface &) = delete;

    ClosestPoint<dim>
    closest(const Point<dim> &x) const;

    std::vector<std::array<Point<dim>, dim>>
    facets() const;

    BoundingBox<dim>
    box() const;

  private:
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

    ClosedMesh<dim>             closed;
    const SurfaceMesh<dim>     &mesh;
    std::vector<Tensor<1, dim>> normals; ///< of facets
    std::vector<Corner>         at_vertices, at_edges;

    using Value = std::pair<BoundingBox<dim>, unsigned int>;
    RTree<Value> boxes; ///< of the facets
  };
} // namespace isochor

#endif
