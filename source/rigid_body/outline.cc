/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/base/rounding.h>
#include <isochor/rigid_body/outline.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  namespace
  {
    double
    cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }



    /** To the right of a unit vector. */
    Tensor<1, 2>
    to_the_right(const Tensor<1, 2> &direction)
    {
      return Tensor<1, 2>({direction[1], -direction[0]});
    }



    std::string
    text(const Point<2> &x)
    {
      return "(" + rounded(x[0]) + ", " + rounded(x[1]) + ")";
    }



    /** Whether the segments a and b have a place in common. */
    bool
    meet(const std::array<Point<2>, 2> &a, const std::array<Point<2>, 2> &b)
    {
      for (unsigned int d = 0; d < 2; ++d)
        if (std::max(a[0][d], a[1][d]) < std::min(b[0][d], b[1][d]) ||
            std::max(b[0][d], b[1][d]) < std::min(a[0][d], a[1][d]))
          return false;
      const auto beside = [](const auto &s, const auto &t) {
        const double first  = cross(s[1] - s[0], t[0] - s[0]),
                     second = cross(s[1] - s[0], t[1] - s[0]);
        return (first > 0 && second > 0) || (first < 0 && second < 0);
      };
      return !beside(a, b) && !beside(b, a);
    }
  } // namespace



  Outline::Outline(const std::vector<Corner> &corners,
                   const bool                 is_closed,
                   const std::string         &what)
    : is_closed(is_closed)
  {
    check(corners, what);
    const unsigned int n = corners.size(), n_edges = is_closed ? n : n - 1;
    const auto         direction = [&](const unsigned int edge) {
      const Tensor<1, 2> d =
        corners[(edge + 1) % n].place - corners[edge % n].place;
      return d / d.norm();
    };
    // how much of both edges the rounding of a corner takes
    std::vector<double> taken(n, 0.);
    std::vector<bool>   is_straight(n, false);
    for (unsigned int i = (is_closed ? 0 : 1); i < n_edges; ++i)
      {
        const auto   before = direction(i + n - 1), after = direction(i);
        const double turn = std::atan2(cross(before, after), before * after);
        is_straight[i]    = std::abs(turn) < rounding::arithmetic;
        if (turn >= rounding::arithmetic)
          taken[i] = corners[i].radius * std::tan(turn / 2);
      }
    for (unsigned int i = 0; i < n_edges; ++i)
      {
        const unsigned int next = (i + 1) % n;
        const Point<2>    &a = corners[i].place, &b = corners[next].place;
        const auto         d      = direction(i);
        const double       length = a.distance(b);
        AssertThrow(taken[i] + taken[next] <=
                      length * (1 + 4 * std::numeric_limits<double>::epsilon()),
                    ExcMessage("The outline of " + what + " has an edge from " +
                               text(a) + " to " + text(b) +
                               " that is too short for the rounding of its "
                               "ends."));
        Piece edge;
        edge.begin         = a + taken[i] * d;
        edge.end           = b - taken[next] * d;
        edge.begin_normal  = to_the_right(d);
        edge.end_normal    = edge.begin_normal;
        edge.begin_is_open = !is_closed && i == 0;
        edge.end_is_open   = !is_closed && i + 1 == n_edges;
        edge.begin_is_corner =
          !edge.begin_is_open && taken[i] == 0 && !is_straight[i];
        edge.end_is_corner =
          !edge.end_is_open && taken[next] == 0 && !is_straight[next];
        pieces.push_back(edge);
        if (taken[next] == 0)
          continue;
        Piece arc;
        arc.radius       = corners[next].radius;
        arc.begin        = edge.end;
        arc.begin_normal = edge.end_normal;
        arc.centre       = arc.begin - arc.radius * arc.begin_normal;
        arc.end_normal   = to_the_right(direction(i + 1));
        arc.end          = arc.centre + arc.radius * arc.end_normal;
        pieces.push_back(arc);
      }
  }



  double
  Outline::twice_area(const std::vector<Corner> &corners)
  {
    double area = 0;
    for (unsigned int i = 0; i < corners.size(); ++i)
      area += cross(corners[i].place - corners[0].place,
                    corners[(i + 1) % corners.size()].place - corners[0].place);
    return area;
  }



  void
  Outline::check(const std::vector<Corner> &corners,
                 const std::string         &what) const
  {
    const unsigned int n = corners.size(), least = is_closed ? 3 : 2;
    AssertThrow(n >= least,
                ExcMessage("The outline of " + what + " needs at least " +
                           std::to_string(least) + " points."));
    std::vector<std::array<Point<2>, 2>> edges;
    for (unsigned int i = 0; i < (is_closed ? n : n - 1); ++i)
      {
        edges.push_back({{corners[i].place, corners[(i + 1) % n].place}});
        AssertThrow(edges[i][0] != edges[i][1],
                    ExcMessage("The outline of " + what + " has the point " +
                               text(edges[i][0]) +
                               " twice. Leave out one of them."));
      }
    const unsigned int n_edges = edges.size();
    if (!is_closed)
      {
        // as far as the others reach, in any direction
        double size = 0;
        for (const Corner &corner : corners)
          size = std::max(size, corner.place.distance(corners[0].place));
        auto &first = edges.front(), &last = edges.back();
        auto  begin = first[0] - first[1], end = last[1] - last[0];
        first[0] += 2 * size / begin.norm() * begin;
        last[1] += 2 * size / end.norm() * end;
      }
    for (unsigned int i = 0; i < n_edges; ++i)
      for (unsigned int j = i + 1; j < n_edges; ++j)
        {
          const bool follows = j == i + 1,
                     closes  = is_closed && i == 0 && j == n_edges - 1;
          bool crosses;
          if (follows || closes)
            {
              // an edge that comes back along the one before
              const auto &first = edges[follows ? i : j],
                         &next  = edges[follows ? j : i];
              const auto a = first[1] - first[0], b = next[1] - next[0];
              crosses = cross(a, b) == 0 && a * b < 0;
            }
          else
            crosses = meet(edges[i], edges[j]);
          AssertThrow(!crosses,
                      ExcMessage("The outline of " + what +
                                 " crosses or touches itself: the edges from " +
                                 text(corners[i].place) + " and from " +
                                 text(corners[j].place) + "."));
        }
  }



  Outline::Candidate
  Outline::nearest(const Piece &piece, const Point<2> &x)
  {
    const auto at = [&x](const Point<2> &point, const int corner) {
      return Candidate{x.distance(point), point, corner};
    };
    const int corner_at_begin = piece.begin_is_corner ? -1 : 0,
              corner_at_end   = piece.end_is_corner ? 1 : 0;
    if (piece.radius == 0)
      {
        const Tensor<1, 2> edge   = piece.end - piece.begin;
        const double       length = edge.norm();
        if (length == 0)
          return at(piece.begin, 0);
        const double s = (x - piece.begin) * edge / length;
        if ((s < 0 || x == piece.begin) && !piece.begin_is_open)
          return at(piece.begin, corner_at_begin);
        if ((s > length || x == piece.end) && !piece.end_is_open)
          return at(piece.end, corner_at_end);
        return at(piece.begin + s / length * edge, 0);
      }
    const Tensor<1, 2> arm = x - piece.centre;
    if (arm.norm() > 0 && cross(piece.begin_normal, arm) >= 0 &&
        cross(arm, piece.end_normal) >= 0)
      return at(piece.centre + piece.radius / arm.norm() * arm, 0);
    return x.distance(piece.begin) < x.distance(piece.end) ?
             at(piece.begin, corner_at_begin) :
             at(piece.end, corner_at_end);
  }



  ClosestPoint<2>
  Outline::on_smooth_part(const Piece &piece, const Point<2> &x)
  {
    ClosestPoint<2> result;
    result.normal = piece.begin_normal;
    if (piece.radius == 0)
      {
        result.distance = (x - piece.begin) * result.normal;
        result.point    = x - result.distance * result.normal;
        return result;
      }
    const Tensor<1, 2> arm = x - piece.centre;
    if (arm.norm() > 0 && cross(piece.begin_normal, arm) >= 0 &&
        cross(arm, piece.end_normal) >= 0)
      {
        result.normal    = arm / arm.norm();
        result.curvature = rounded_curvature(arm.norm(), result.normal);
      }
    else if (x.distance(piece.end) < x.distance(piece.begin))
      result.normal = piece.end_normal;
    result.point    = piece.centre + piece.radius * result.normal;
    result.distance = (x - result.point) * result.normal;
    return result;
  }



  ClosestPoint<2>
  Outline::closest(const Point<2> &x) const
  {
    Assert(!pieces.empty(), ExcNotInitialized());
    Candidate    best{std::numeric_limits<double>::max(), Point<2>(), 0};
    unsigned int index = 0;
    for (unsigned int i = 0; i < pieces.size(); ++i)
      {
        const Candidate candidate = nearest(pieces[i], x);
        // a face rather than its end
        if (candidate.distance < best.distance ||
            (candidate.distance == best.distance && candidate.corner == 0))
          {
            best  = candidate;
            index = i;
          }
      }
    const Piece &piece = pieces[index];
    if (best.corner == 0)
      return on_smooth_part(piece, x);

    const unsigned int n     = pieces.size();
    const Piece       &other = pieces[(index + n + best.corner) % n];
    // what is outside of a corner is where the mean of its normals points
    Tensor<1, 2> mean = best.corner < 0 ?
                          other.end_normal + piece.begin_normal :
                          piece.end_normal + other.begin_normal;
    mean /= mean.norm();
    ClosestPoint<2>    result;
    const Tensor<1, 2> arm  = x - best.point;
    const double       sign = arm * mean >= 0 ? 1. : -1.;
    result.point            = best.point;
    result.distance         = sign * best.distance;
    result.normal           = mean;
    round_corner(x, Tensor<1, 2>(), result);
    return result;
  }



  std::vector<std::array<Point<2>, 2>>
  Outline::segments(const double reach) const
  {
    constexpr double                     step = numbers::PI / 36;
    std::vector<std::array<Point<2>, 2>> result;
    for (const Piece &piece : pieces)
      if (piece.radius == 0)
        {
          const Tensor<1, 2> &normal = piece.begin_normal;
          const Tensor<1, 2>  along({-normal[1], normal[0]});
          const Point<2>      begin =
            piece.begin - (piece.begin_is_open ? reach : 0.) * along;
          const Point<2> end =
            piece.end + (piece.end_is_open ? reach : 0.) * along;
          if (begin != end)
            result.push_back({{begin, end}});
        }
      else
        {
          const Tensor<1, 2> a = piece.begin_normal;
          const Tensor<1, 2> b = Tensor<1, 2>({-a[1], a[0]});
          const double       turn =
            std::atan2(cross(a, piece.end_normal), a * piece.end_normal);
          // an even number: an arc may be cut in its middle
          const unsigned int n  = 2 * std::ceil(turn / (2 * step));
          const auto         at = [&](const unsigned int k) {
            const double angle = k * turn / n;
            return Point<2>(piece.centre +
                            piece.radius *
                              (std::cos(angle) * a + std::sin(angle) * b));
          };
          for (unsigned int k = 0; k < n; ++k)
            result.push_back({{at(k), at(k + 1)}});
        }
    return result;
  }



  BoundingBox<2>
  Outline::box() const
  {
    std::vector<Point<2>> places;
    for (const Piece &piece : pieces)
      {
        places.insert(places.end(), {piece.begin, piece.end});
        for (const double sign : {-1., 1.})
          for (unsigned int d = 0; d < 2 && piece.radius > 0; ++d)
            {
              Tensor<1, 2> axis;
              axis[d] = sign;
              if (cross(piece.begin_normal, axis) >= 0 &&
                  cross(axis, piece.end_normal) >= 0)
                places.push_back(piece.centre + piece.radius * axis);
            }
      }
    return BoundingBox<2>(places);
  }
} // namespace isochor
