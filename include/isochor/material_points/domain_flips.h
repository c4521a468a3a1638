/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_domain_flips_h
#define isochor_domain_flips_h

#include <isochor/material_points/flowing_triangles.h>

#include <array>

namespace isochor
{
  using namespace dealii;

  /**
   * Gives the domains of material that flows better shapes, in the plane: two
   * triangles that share an edge become those with the other diagonal of their
   * quadrilateral where the worse of the two is better then (Lawson's flips),
   * so that shear does not draw domains out to slivers. Nothing else of the
   * mesh changes, its corners and the body's surface least of all.
   *
   * What the old triangles have of a new one is theirs by area: V_0, mass and
   * momentum are conserved, and det F is that of the volumes. The rest of the
   * state is their mean (mean_state()): what flows has no memory of its shape,
   * so that F says no more than V/V_0, and where a point was at t = 0 is known
   * in the mean only; but F takes outer faces from where they were at t = 0,
   * which conditions on surfaces go by, and no triangle gets two of them.
   *
   * The worst are first.
   */
  class DomainFlips
  {
  public:
    DomainFlips(FlowingTriangles &mesh)
      : mesh(mesh)
    {}

    /** Flip what is better then. How many flips there were. */
    unsigned int
    flip();

  private:
    using Triangle = FlowingTriangles::Triangle;
    /** Two triangles, by number, that share an edge. */
    struct Pair
    {
      unsigned int triangle;
      /** Places among its corners: of that which isn't on the edge, of the end
       * that it keeps when it is flipped, and of the one that it loses. */
      unsigned int apex, kept, lost;
    };
    using Pairs = std::array<Pair, 2>;

    /** The neighbour with which @p triangle is best off; false if it stays as
     * it is. */
    bool
    find_partner(const unsigned int triangle, Pairs &best) const;
    void
    flip(const Pairs &pairs);
    /** Give the first of the @p old triangles, flipped, the state of what was
     * where it is. */
    void
    set_state(const std::array<Triangle, 2> &old,
              const Pairs                   &pairs,
              Triangle                      &triangle) const;

    FlowingTriangles &mesh;
  };
} // namespace isochor

#endif
