/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_points/domain_flips.h>
#include <isochor/material_points/mean_state.h>
#include <isochor/material_points/outer_faces.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Of a domain with the state @p values and its centroid at @p whole: what
     * a part of it with the centroid @p centre has, @p share of its area. */
    void
    take_part(const Point<2>      &whole,
              const Point<2>      &centre,
              const double         share,
              const PointLayout   &l,
              std::vector<double> &values)
    {
      Assert(share >= 0 && share <= 1 + 1e-10, ExcInternalError());
      const Tensor<1, 2> shift = centre - whole,
                         moved =
                           shift -
                           invert(deformation_gradient<2>(values.data(), l)) *
                             shift;
      values[l.volume] *= share;
      // of rings
      values[l.mass] *= share * (l.axisymmetric ? centre[0] / whole[0] : 1.);
      for (unsigned int d = 0; d < 2; ++d)
        values[l.displacement + d] += moved[d];
    }
  } // namespace



  bool
  DomainFlips::find_partner(const unsigned int triangle, Pairs &best) const
  {
    const PointLayout &l        = mesh.layout();
    const Triangle    &first    = mesh.triangles[triangle];
    float              smallest = quality(first.corners);
    bool               is_found = false;
    for (unsigned int c = 0; c < 3; ++c)
      {
        const auto &side = mesh.at_edge(mesh.edge(first, c));
        if (side.size() != 2)
          continue;
        const unsigned int other =
          *side.begin() == triangle ? *side.rbegin() : *side.begin();
        const Triangle &second = mesh.triangles[other];
        if (first.properties[l.material] != second.properties[l.material])
          continue;
        Pair pair{triangle, c, (c + 1) % 3, (c + 2) % 3};
        Pair partner{other,
                     0,
                     second.place_of(first.number[pair.lost]),
                     second.place_of(first.number[pair.kept])};
        partner.apex      = 3 - partner.kept - partner.lost;
        const Point<2> &o = first.corners[pair.apex],
                       &a = first.corners[pair.kept],
                       &b = first.corners[pair.lost],
                       &p = second.corners[partner.apex];
        // as floats: of equal ones rounding must not decide
        const float worse = std::min(quality(o, a, p), quality(o, p, b));
        // both on the same side of the new diagonal as before
        if (!(worse > smallest && area(o, a, p) * area(o, a, b) > 0 &&
              area(o, p, b) * area(o, a, b) > 0))
          continue;
        if ((first.has_face(pair.lost) && second.has_face(partner.kept)) ||
            (first.has_face(pair.kept) && second.has_face(partner.lost)))
          continue;
        // a face that stays the one opposite to a corner of the same point is
        // remembered by what acts on it
        if (first.has_face(pair.kept) || second.has_face(partner.kept))
          {
            std::swap(pair.kept, pair.lost);
            std::swap(partner.kept, partner.lost);
          }
        smallest = worse;
        best     = {{pair, partner}};
        is_found = true;
      }
    return is_found;
  }



  void
  DomainFlips::flip(const Pairs &pairs)
  {
    for (const Pair &pair : pairs)
      mesh.link(pair.triangle, false);
    const std::array<Triangle, 2> old = {
      {mesh.triangles[pairs[0].triangle], mesh.triangles[pairs[1].triangle]}};
    for (unsigned int i = 0; i < 2; ++i)
      {
        const Pair     &pair = pairs[i], &partner = pairs[1 - i];
        const Triangle &other       = old[1 - i];
        Triangle       &triangle    = mesh.triangles[pair.triangle];
        triangle.corners[pair.lost] = other.corners[partner.apex];
        triangle.number[pair.lost]  = other.number[partner.apex];
        triangle.places[pair.lost]  = other.places[partner.apex];
        triangle.is_changed         = true;
        // opposite to what was lost: as before; to the apex: what the other
        // had; to the end that is kept: between the two
        triangle.outer_faces =
          (old[i].outer_faces & (flags_of_face << pair.lost)) |
          ((other.outer_faces >> partner.kept & flags_of_face) << pair.apex);
        if (triangle.has_face(pair.apex))
          triangle.places[pair.kept] = other.places[partner.lost];
        set_state({{old[i], other}}, {{pair, partner}}, triangle);
      }
    for (const Pair &pair : pairs)
      mesh.link(pair.triangle, true);
  }



  void
  DomainFlips::set_state(const std::array<Triangle, 2> &old,
                         const Pairs                   &pairs,
                         Triangle                      &triangle) const
  {
    const PointLayout    &l   = mesh.layout();
    const Point<2>       &end = old[0].corners[pairs[0].kept];
    std::array<double, 2> of_old;
    for (unsigned int i = 0; i < 2; ++i)
      of_old[i] =
        std::abs(area(old[i].corners[0], old[i].corners[1], old[i].corners[2]));
    const Point<2> &o = old[0].corners[pairs[0].apex],
                   &p = old[1].corners[pairs[1].apex];
    // where the diagonals cross
    const Point<2> middle = o + of_old[0] / (of_old[0] + of_old[1]) * (p - o);
    std::array<std::vector<double>, 2> part;
    std::array<double, 2>              of_part;
    double                             ring = 0; // V_0 R
    for (unsigned int i = 0; i < 2; ++i)
      {
        const PointDomain<2>::Corners corners = {
          {old[i].corners[pairs[i].apex], end, middle}};
        const Point<2> centre = centroid<2>(corners);
        of_part[i] = std::abs(area(corners[0], corners[1], corners[2]));
        part[i]    = old[i].properties;
        take_part(centroid<2>(old[i].corners),
                  centre,
                  of_part[i] / of_old[i],
                  l,
                  part[i]);
        if (l.axisymmetric)
          ring += part[i][l.volume] * centre[0] / part[i][l.history];
      }
    const unsigned int larger = of_part[1] > of_part[0] ? 1 : 0;
    const double       V_0    = part[0][l.volume] + part[1][l.volume];
    mean_state<2>(part[0].data(),
                  part[1].data(),
                  deformation_gradient<2>(part[larger].data(), l),
                  l,
                  mesh.materials,
                  triangle.properties);
    if (l.axisymmetric)
      triangle.properties[l.history] =
        centroid<2>(triangle.corners)[0] * V_0 / ring;
    mesh.fill((of_part[0] + of_part[1]) / V_0, triangle);
  }



  unsigned int
  DomainFlips::flip()
  {
    std::set<FlowingTriangles::Turn> queue;
    const auto                       add = [&](const unsigned int i) {
      const auto &triangle = mesh.triangles[i];
      if (FlowingTriangles::is_poor(triangle.corners, triangle.to_unit))
        queue.insert(mesh.turn(quality(triangle.corners), i));
    };
    for (unsigned int i = 0; i < mesh.triangles.size(); ++i)
      add(i);
    unsigned int n_flips = 0;
    while (!queue.empty())
      {
        // each flip makes the worst of two better, so that this ends
        const auto         next = *queue.begin();
        const unsigned int i    = std::get<2>(next);
        queue.erase(queue.begin());
        Pairs pairs;
        if (next != mesh.turn(quality(mesh.triangles[i].corners), i) ||
            !find_partner(i, pairs))
          continue;
        flip(pairs);
        ++n_flips;
        for (const Pair &pair : pairs)
          add(pair.triangle);
      }
    return n_flips;
  }
} // namespace isochor
