/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_points/domain_collapse.h>
#include <isochor/material_points/mean_state.h>
#include <isochor/material_points/outer_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace isochor
{
  namespace
  {
    double
    area_of(const PointDomain<2>::Corners &corners)
    {
      return area(corners[0], corners[1], corners[2]);
    }

    /** What a move conserves, of the @p star: V_0 (of rings), mass, and the
     * momentum of each field. */
    std::vector<double>
    sums_over(const std::vector<unsigned int> &star, FlowingTriangles &mesh)
    {
      const std::vector<unsigned int> fields = mesh.layout().vectors_by_mass();
      std::vector<double>             sums(2 + 2 * fields.size());
      for (const unsigned int i : star)
        if (const auto &triangle = mesh.triangles[i]; !triangle.is_gone)
          {
            const double *values = triangle.properties.data();
            const double  mass   = values[mesh.layout().mass];
            sums[0] +=
              values[mesh.layout().volume] * mesh.radius_at_start(triangle);
            sums[1] += mass;
            for (unsigned int f = 0; f < fields.size(); ++f)
              for (unsigned int d = 0; d < 2; ++d)
                sums[2 + 2 * f + d] += mass * values[fields[f] + d];
          }
      return sums;
    }

    /** Give the @p star the sums that it had @p before. */
    void
    conserve(const std::vector<double>       &before,
             const std::vector<unsigned int> &star,
             FlowingTriangles                &mesh)
    {
      const PointLayout              &l         = mesh.layout();
      const std::vector<unsigned int> fields    = l.vectors_by_mass();
      const std::vector<double>       now       = sums_over(star, mesh);
      const double                    of_volume = before[0] / now[0],
                   of_mass = before[1] > 0 ? before[1] / now[1] : 1.;
      for (const unsigned int i : star)
        if (auto &triangle = mesh.triangles[i]; !triangle.is_gone)
          {
            double *values = triangle.properties.data();
            values[l.volume] *= of_volume;
            values[l.volume_gain] = (1 + values[l.volume_gain]) * of_volume - 1;
            values[l.mass] *= of_mass;
            for (unsigned int f = 0; f < fields.size(); ++f)
              for (unsigned int d = 0; d < 2; ++d)
                values[fields[f] + d] += before[2 + 2 * f + d] / before[1] -
                                         now[2 + 2 * f + d] / now[1];
          }
    }
  } // namespace

  typename DomainCollapse::Star
  DomainCollapse::triangles_at(const unsigned int body,
                               const unsigned int corner) const
  {
    Star star;
    for (unsigned int i = 0; i < mesh.triangles.size(); ++i)
      if (!mesh.triangles[i].is_gone && mesh.triangles[i].body == body &&
          mesh.triangles[i].place_of(corner) < 3)
        star.push_back(i);
    return star;
  }

  typename DomainCollapse::Move
  DomainCollapse::contraction(const unsigned int i,
                              const unsigned int gone,
                              const unsigned int kept) const
  {
    const Triangle &needle = mesh.triangles[i];
    Move            move{needle.number[gone],
              needle.number[kept],
              needle.corners[kept],
              needle.places[kept],
              triangles_at(needle.body, needle.number[gone]),
              {}};
    for (const unsigned int i : move.star)
      {
        const Triangle    &triangle = mesh.triangles[i];
        const unsigned int k        = triangle.place_of(move.kept);
        if (k == 3)
          continue;
        move.vanishing.push_back(i);
        if (triangle.has_face(3 - k - triangle.place_of(move.gone)))
          move.place_at_start = triangle.places[k];
      }
    return move;
  }

  typename DomainCollapse::Move
  DomainCollapse::rise_to_surface(const unsigned int i,
                                  const unsigned int apex) const
  {
    const Triangle    &triangle = mesh.triangles[i];
    const unsigned int a = (apex + 1) % 3, b = (apex + 2) % 3;
    const double       along = foot(triangle.corners, apex);
    return {triangle.number[apex],
            triangle.number[apex],
            triangle.corners[a] +
              along * (triangle.corners[b] - triangle.corners[a]),
            triangle.places[a] +
              along * (triangle.places[b] - triangle.places[a]),
            triangles_at(triangle.body, triangle.number[apex]),
            {i}};
  }



  unsigned int
  DomainCollapse::face_below(const Triangle &triangle)
  {
    for (unsigned int c = 0; c < 3; ++c)
      if (triangle.has_face(c))
        if (const double along = foot(triangle.corners, c);
            along > 0 && along < 1)
          return c;
    return 3;
  }



  double
  DomainCollapse::shortest_in_cells(const unsigned int i) const
  {
    const Triangle &triangle = mesh.triangles[i];
    const Corners   in_cell  = map_corners(triangle.to_unit, triangle.corners);
    const double    edge     = shortest_edge(in_cell);
    const unsigned int face  = face_below(triangle);
    return face == 3 ? edge :
                       std::min(edge,
                                2 * std::abs(area_of(in_cell)) /
                                  edge_lengths(in_cell)[face]);
  }



  std::vector<typename DomainCollapse::Move>
  DomainCollapse::find_moves(const unsigned int i) const
  {
    const Triangle &triangle = mesh.triangles[i];
    const auto      lengths =
      edge_lengths(map_corners(triangle.to_unit, triangle.corners));
    const unsigned int c =
      std::min_element(lengths.begin(), lengths.end()) - lengths.begin();
    if (!(lengths[c] < FlowingTriangles::short_in_cells))
      return {rise_to_surface(i, face_below(triangle))};
    std::vector<Move> moves = {contraction(i, (c + 1) % 3, (c + 2) % 3),
                               contraction(i, (c + 2) % 3, (c + 1) % 3)};
    const auto        order = [&](const Move &move, const unsigned int gone) {
      return std::make_pair(static_cast<float>(bend(move)),
                            FlowingTriangles::tie_break(
                              triangle.corners[gone]));
    };
    if (order(moves[1], (c + 2) % 3) < order(moves[0], (c + 1) % 3))
      std::swap(moves[0], moves[1]);
    return moves;
  }



  double
  DomainCollapse::bend(const Move &move) const
  {
    Point<2>                               gone;
    std::vector<std::pair<Point<2>, bool>> ends; // of faces; the kept corner?
    for (const unsigned int i : move.star)
      {
        const Triangle    &triangle = mesh.triangles[i];
        const unsigned int c        = triangle.place_of(move.gone);
        gone                        = triangle.corners[c];
        for (const unsigned int opposite : {(c + 1) % 3, (c + 2) % 3})
          if (triangle.has_face(opposite))
            {
              const unsigned int end = 3 - c - opposite;
              ends.emplace_back(triangle.corners[end],
                                triangle.number[end] == move.kept);
            }
      }
    if (ends.empty())
      return -std::numeric_limits<double>::infinity();
    if (ends.size() != 2 || ends[0].second == ends[1].second)
      return std::numeric_limits<double>::infinity();
    const Tensor<1, 2> before = gone - ends[0].first,
                       after  = ends[1].first - gone;
    const double cosine       = before * after / (before.norm() * after.norm());
    return cosine > std::sqrt(0.5) ? -cosine :
                                     std::numeric_limits<double>::infinity();
  }

  bool
  DomainCollapse::is_possible(const Move &move) const
  {
    const unsigned int material = mesh.layout().material;
    const bool         is_rise  = move.kept == move.gone;
    if (bend(move) > 0)
      return false;
    double worst = 1, worst_before = 1;
    for (const unsigned int i : move.star)
      {
        const Triangle    &triangle = mesh.triangles[i];
        const unsigned int c        = triangle.place_of(move.gone);
        worst_before = std::min(worst_before, quality(triangle.corners));
        if (triangle.properties[material] !=
            mesh.triangles[move.star[0]].properties[material])
          return false;
        for (const unsigned int opposite : {(c + 1) % 3, (c + 2) % 3})
          if (mesh.at_edge(mesh.edge(triangle, opposite)).size() != 2 &&
              !triangle.has_face(opposite))
            return false;
        if (std::count(move.vanishing.begin(), move.vanishing.end(), i) > 0)
          {
            // edges that become one are within the body
            if (!is_rise && (triangle.has_face(c) ||
                             triangle.has_face(triangle.place_of(move.kept))))
              return false;
            continue;
          }
        // no triangle gets two outer faces
        if (is_rise && triangle.outer_faces != 0 &&
            shared_edge(mesh.triangles[move.vanishing[0]], triangle) < 3)
          return false;
        Corners moved = triangle.corners;
        moved[c]      = move.place;
        if (area_of(moved) * area_of(triangle.corners) <= 0)
          return false;
        worst = std::min(worst, quality(moved));
      }
    return worst > worst_before;
  }

  unsigned int
  DomainCollapse::shared_edge(const Triangle &first, const Triangle &second)
  {
    for (unsigned int c = 0; c < 3; ++c)
      if (first.place_of(second.number[(c + 1) % 3]) < 3 &&
          first.place_of(second.number[(c + 2) % 3]) < 3)
        return c;
    return 3;
  }

  void
  DomainCollapse::pass_on(const Triangle &from,
                          Triangle       &to,
                          Place          &place) const
  {
    const PointLayout &l    = mesh.layout();
    const auto         at   = to.properties;
    const double       area = std::abs(area_of(from.corners)),
                 ring =
                   l.axisymmetric ?
                     at[l.volume] * place.centre[0] / at[l.history] +
                       from.properties[l.volume] * mesh.radius_at_start(from) :
                     1.;
    mean_state<2>(at.data(),
                  from.properties.data(),
                  deformation_gradient<2>(at.data(), l),
                  l,
                  mesh.materials,
                  to.properties);
    place.centre +=
      area / (place.area + area) * (centroid<2>(from.corners) - place.centre);
    place.area += area;
    if (l.axisymmetric)
      to.properties[l.history] =
        place.centre[0] * to.properties[l.volume] / ring;
  }

  std::vector<typename DomainCollapse::Place>
  DomainCollapse::join(const Move &move)
  {
    std::vector<Place> places;
    for (const unsigned int i : move.star)
      {
        const Corners &corners = mesh.triangles[i].corners;
        places.push_back({centroid<2>(corners), std::abs(area_of(corners))});
      }
    for (const unsigned int i : move.vanishing)
      mesh.triangles[i].is_gone = true;
    for (const unsigned int i : move.vanishing)
      {
        const Triangle &from  = mesh.triangles[i];
        bool            is_on = false;
        for (unsigned int k = 0; k < move.star.size(); ++k)
          {
            Triangle          &to   = mesh.triangles[move.star[k]];
            const unsigned int edge = shared_edge(from, to);
            if (to.is_gone || edge == 3)
              continue;
            if (move.kept == move.gone)
              {
                // its edge with the neighbour comes to the surface
                to.outer_faces |=
                  (from.outer_faces >> from.place_of(move.gone) & flags_of_face)
                  << edge;
                const unsigned int end = 3 - edge - to.place_of(move.gone);
                to.places[end] = from.places[from.place_of(to.number[end])];
              }
            if (std::exchange(is_on, true))
              continue;
            pass_on(from, to, places[k]);
          }
        Assert(is_on, ExcInternalError());
      }
    return places;
  }

  void
  DomainCollapse::apply(const Move &move)
  {
    const PointLayout        &l      = mesh.layout();
    const std::vector<double> before = sums_over(move.star, mesh);
    for (const unsigned int i : move.star)
      mesh.link(i, false);
    const std::vector<Place> places = join(move);
    std::vector<double>      J(move.star.size());
    for (unsigned int k = 0; k < move.star.size(); ++k)
      {
        Triangle &triangle = mesh.triangles[move.star[k]];
        if (triangle.is_gone)
          continue;
        J[k]                 = places[k].area / triangle.properties[l.volume];
        const unsigned int c = triangle.place_of(move.gone);
        triangle.corners[c]  = move.place;
        triangle.number[c]   = move.kept;
        triangle.places[c]   = move.place_at_start;
        triangle.is_changed  = true;
        move_domain<2>(places[k].centre,
                       places[k].area,
                       centroid<2>(triangle.corners),
                       std::abs(area_of(triangle.corners)),
                       l,
                       triangle.properties.data());
      }
    conserve(before, move.star, mesh);
    for (unsigned int k = 0; k < move.star.size(); ++k)
      {
        Triangle &triangle = mesh.triangles[move.star[k]];
        if (triangle.is_gone)
          continue;
        mesh.fill(J[k], triangle);
        mesh.link(move.star[k], true);
      }
  }

  unsigned int
  DomainCollapse::collapse()
  {
    std::set<FlowingTriangles::Turn> queue;
    const auto                       add = [&](const unsigned int i) {
      const Triangle &triangle = mesh.triangles[i];
      const double    length   = shortest_in_cells(i);
      if (!triangle.is_gone && length < FlowingTriangles::short_in_cells &&
          FlowingTriangles::is_poor(triangle.corners, triangle.to_unit))
        queue.insert(mesh.turn(length, i));
    };
    for (unsigned int i = 0; i < mesh.triangles.size(); ++i)
      add(i);
    unsigned int n_gone = 0;
    while (!queue.empty())
      {
        // each move takes a triangle away, so that this ends
        const auto         next = *queue.begin();
        const unsigned int i    = std::get<2>(next);
        queue.erase(queue.begin());
        if (mesh.triangles[i].is_gone ||
            next != mesh.turn(shortest_in_cells(i), i))
          continue;
        for (const Move &move : find_moves(i))
          if (is_possible(move))
            {
              apply(move);
              n_gone += move.vanishing.size();
              for (const unsigned int k : move.star)
                add(k);
              break;
            }
      }
    return n_gone;
  }
} // namespace isochor
