/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_closed_mesh_h
#define isochor_closed_mesh_h

#include <isochor/rigid_body/surface_mesh.h>

#include <array>
#include <string>
#include <vector>

namespace isochor
{
  /** A closed surface of segments (2D) or triangles (3D) that look out of what
   * they enclose: who looks from outside sees triangles run counterclockwise;
   * what is enclosed is to the left of segments. A closed part within another
   * one is a cavity. */
  template <int dim>
  class ClosedMesh
  {
  public:
    /** Facets are turned as they have to be.
     * @param subject What messages start with: "The mesh ... ".
     * @throws ExcMessage for a surface that is not closed or can't be turned
     * so.
     */
    ClosedMesh(SurfaceMesh<dim> mesh, const std::string &subject);

    /** Normal to a facet; as long as the segment or as twice the area. */
    Tensor<1, dim>
    normal_vector(const unsigned int facet) const;

    SurfaceMesh<dim> mesh;
    /** By facet, the one behind the ridge (a vertex in 2D, an edge in 3D)
     * opposite of each corner, and the number of that ridge. */
    std::vector<std::array<unsigned int, dim>> neighbours, ridges;

  private:
    /** The vertices of a ridge. */
    using Ridge = std::array<unsigned int, dim - 1>;

    Ridge
    ridge(const unsigned int facet, const unsigned int i) const;
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
    /** The share of a full circle or of the full solid angle that @p facets
     * appear under from @p x: 1 inside, 0 outside, if they look out. */
    double
    winding(const std::vector<unsigned int> &facets, const Point<dim> &x) const;
  };
} // namespace isochor

#endif
