/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_outline_h
#define isochor_outline_h

#include <isochor/rigid_body/rigid_shape.h>

#include <string>
#include <vector>

namespace isochor
{
  /**
   * The outline of a rigid body in the plane: straight edges, and arcs that
   * round convex corners. The rigid body is on the left. An outline that isn't
   * closed goes on straight beyond its ends.
   */
  class Outline
  {
  public:
    /** A corner, with the radius (m) of its rounding, which concave ones don't
     * have. */
    struct Corner
    {
      Point<2> place;
      double   radius = 0;
    };

    Outline() = default;

    /** @param what What messages name: "The outline of ...".
     * @throws ExcMessage for less than three corners (two, if it isn't closed),
     * equal neighbours, edges that meet others, and roundings for which edges
     * are too short. */
    Outline(const std::vector<Corner> &corners,
            const bool                 is_closed,
            const std::string         &what);

    /** Twice the area within closed @p corners, positive if they run
     * counterclockwise. */
    static double
    twice_area(const std::vector<Corner> &corners);

    ClosestPoint<2>
    closest(const Point<2> &x) const;

    /** For pictures; ends that go on are drawn over a length of @p reach. */
    std::vector<std::array<Point<2>, 2>>
    segments(const double reach = 0) const;

    /** A box around the corners. */
    BoundingBox<2>
    box() const;

  private:
    /** An edge, or an arc around #centre. */
    struct Piece
    {
      Point<2>     begin, end;
      Tensor<1, 2> begin_normal, end_normal;
      Point<2>     centre;
      double       radius = 0; ///< 0: straight
      /** Whether the surface has a corner at the begin or the end. */
      bool begin_is_corner = false, end_is_corner = false;
      /** Whether it goes on there. */
      bool begin_is_open = false, end_is_open = false;
    };

    /** The nearest place of a piece. */
    struct Candidate
    {
      double   distance; ///< not negative
      Point<2> point;
      int      corner; ///< -1, 1: a corner at its begin, its end; 0: none
    };

    void
    check(const std::vector<Corner> &corners, const std::string &what) const;
    static Candidate
    nearest(const Piece &piece, const Point<2> &x);
    static ClosestPoint<2>
    on_smooth_part(const Piece &piece, const Point<2> &x);

    std::vector<Piece> pieces;
    bool               is_closed = true;
  };
} // namespace isochor

#endif
