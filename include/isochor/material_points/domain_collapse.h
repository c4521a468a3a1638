/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_domain_collapse_h
#define isochor_domain_collapse_h

#include <isochor/material_points/flowing_triangles.h>

#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Takes poor triangles out of the domains of material that flows, in the
   * plane, that the grid can't see: they become shorter and shorter where flow
   * parts, before a tip, and where it meets, behind a pole. A short edge
   * collapses: one of its ends goes to the other, and the triangles at the edge
   * are gone (edge collapse of Hoppe et al., Mesh optimization, SIGGRAPH 1993).
   * A corner within the body that is that near to an edge on the surface comes
   * to the surface.
   *
   * The material stays where it is: a triangle takes what its edges pass over,
   * at the density of t = 0, and what is left of the vanishing ones goes to a
   * neighbour, with the mean of the states. V_0, mass and momentum are
   * conserved. Of the two corners of a short edge that within the body goes, or
   * that where the surface is less bent; the shortest edges are first.
   */
  class DomainCollapse
  {
  public:
    DomainCollapse(FlowingTriangles &mesh)
      : mesh(mesh)
    {}

    /** Collapse all that can. How many triangles are gone. */
    unsigned int
    collapse();

  private:
    using Triangle = FlowingTriangles::Triangle;
    using Corners  = PointDomain<2>::Corners;
    using Star     = std::vector<unsigned int>;
    /** Of a corner to another one or onto the surface. */
    struct Move
    {
      unsigned int gone, kept; ///< numbers: before, afterwards
      Point<2>     place;
      Point<2>     place_at_start; ///< for outer faces there
      Star         star;           ///< the triangles at the corner
      Star         vanishing;      ///< of these
    };

    /** The edge on the surface, by its opposite corner, that this corner can
     * come to; 3 if there is none. */
    static unsigned int
    face_below(const Triangle &triangle);
    /** The length of the shortest edge, or from a corner to the edge on the
     * surface that it can come to. */
    double
    shortest_in_cells(const unsigned int triangle) const;
    /** The moves that would take a triangle away, the better one first. */
    std::vector<Move>
    find_moves(const unsigned int triangle) const;
    Move
    contraction(const unsigned int needle,
                const unsigned int gone,
                const unsigned int kept) const;
    Move
    rise_to_surface(const unsigned int cap, const unsigned int apex) const;

    /** The triangles at a corner. */
    Star
    triangles_at(const unsigned int body, const unsigned int corner) const;

    /** The corner of @p second opposite to the edge that it shares with @p
     * first; 3 if there is none. */
    static unsigned int
    shared_edge(const Triangle &first, const Triangle &second);

    /** Whether the star of the corner is all there and may be changed. */
    bool
    is_possible(const Move &move) const;

    /** How much the surface is bent at the corner that goes: minus the cosine
     * of the angle, -infinite if the corner is within the body, infinite if it
     * can't go along an edge on the surface or that is bent by 45 degrees, as
     * where a surface ends. */
    double
    bend(const Move &move) const;

    void
    apply(const Move &move);

    /** Centroid and area of what is a triangle or two. */
    struct Place
    {
      Point<2> centre;
      double   area;
    };

    /** Join what vanishes with a neighbour. Where the star is then, before its
     * corner moves. */
    std::vector<Place>
    join(const Move &move);

    /** Give @p to, at @p place, what @p from has, with which it shares an edge.
     */
    void
    pass_on(const Triangle &from, Triangle &to, Place &place) const;

    FlowingTriangles &mesh;
  };
} // namespace isochor

#endif
