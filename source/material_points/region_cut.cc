/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/rounding.h>
#include <isochor/material_points/region_cut.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace isochor
{
  namespace
  {
    /** Of an edge: a crossing nearer than this moves the vertex. Labelle &
     * Shewchuk's value for long edges (0.24999). */
    constexpr double near = 0.25;
    /** The same of a vertex that is on the border, or on a tangent of it. */
    constexpr double touching = 1e-3;

    template <int dim>
    double
    volume(const std::array<Point<dim>, dim + 1> &corners)
    {
      Tensor<2, dim> edges;
      for (unsigned int c = 0; c < dim; ++c)
        edges[c] = corners[c + 1] - corners[0];
      return std::abs(determinant(edges)) / (dim == 2 ? 2 : 6);
    }

    /** A unit vector at right angles to the face opposite to corner @p c. */
    template <int dim>
    Tensor<1, dim>
    normal(const CornerVectors<dim> &corners, const unsigned int c)
    {
      const auto corner = [&](const unsigned int i) {
        return corners[(c + 1 + i) % (dim + 1)];
      };
      Tensor<1, dim> n;
      if constexpr (dim == 2)
        n = cross_product_2d(corner(1) - corner(0));
      else
        n = cross_product_3d(corner(1) - corner(0), corner(2) - corner(0));
      return n / n.norm();
    }
  } // namespace



  template <int dim>
  RegionCut<dim>::RegionCut(const Expression<dim> &condition,
                            const bool             keep_outside)
    : condition(condition)
    , keep_outside(keep_outside)
  {}



  template <int dim>
  unsigned char
  RegionCut<dim>::corners_inside(const Seed<dim> &seed) const
  {
    Assert(seed.domain[0].norm_square() > 0,
           ExcMessage("The point has no domain."));
    unsigned char corners = 0;
    for (unsigned int c = 0; c <= dim; ++c)
      if (is_in_from(seed, seed.location + seed.domain[c]))
        corners |= 1u << c;
    return corners;
  }



  template <int dim>
  std::vector<Seed<dim>>
  RegionCut<dim>::cut(const std::vector<Seed<dim>> &all,
                      std::vector<bool>            &is_inside)
  {
    Assert(seeds.empty(), ExcMessage("An object cuts once."));
    for (const Seed<dim> &seed : all)
      if (const unsigned char corners = corners_inside(seed);
          corners != 0 || keep_outside)
        {
          seeds.push_back(seed);
          sides.push_back(corners);
        }
    find_parts();
    if (parts.empty() && !keep_outside)
      {
        is_inside.assign(seeds.size(), true);
        return std::move(seeds);
      }
    find_crossings();
    find_fixed_faces();
    move_vertices();
    number_crossings();

    std::vector<Seed<dim>> result;
    const auto keep = [&](const Seed<dim> &seed, const bool inside) {
      if (!inside && !keep_outside)
        return;
      result.push_back(seed);
      is_inside.push_back(inside);
    };
    is_inside.clear();
    result.reserve(seeds.size());
    auto part = parts.begin();
    for (unsigned int s = 0; s < seeds.size(); ++s)
      if (part == parts.end() || part->seed != s)
        keep(seeds[s], sides[s] != 0);
      else
        {
          for (const Corners &corners : divide(*part))
            {
              const Seed<dim> seed = seed_of(*part, corners);
              keep(seed, is_piece_inside(*part, corners, seed));
            }
          ++part;
        }
    return result;
  }



  template <int dim>
  void
  RegionCut<dim>::find_parts()
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int s = 0; s < seeds.size(); ++s)
      if (is_at_border(s))
        for (unsigned int c = 0; c < dim; ++c)
          smallest =
            std::min(smallest,
                     (seeds[s].domain[c + 1] - seeds[s].domain[c]).norm());
    if (smallest == std::numeric_limits<double>::max())
      return;
    // meshes of bodies are rounded to some digits in their files
    PlaceTable<dim> places({seeds.front().location, 1e-4 * smallest});
    const auto      corner = [&](const unsigned int s, const unsigned int c) {
      return seeds[s].location + seeds[s].domain[c];
    };
    for (unsigned int s = 0; s < seeds.size(); ++s)
      for (unsigned int c = 0; c <= dim && is_at_border(s); ++c)
        places.find_or_add(corner(s, c));
    const unsigned int n_at_border = places.size();
    for (unsigned int s = 0; s < seeds.size(); ++s)
      for (unsigned int c = 0; c <= dim; ++c)
        if (places.find(corner(s, c)) < n_at_border)
          {
            parts.push_back({s, {}});
            break;
          }
    for (unsigned int p = 0; p < parts.size(); ++p)
      for (unsigned int c = 0; c <= dim; ++c)
        {
          const Point<dim>   x = corner(parts[p].seed, c);
          const unsigned int v = places.find_or_add(x);
          if (v >= vertices.size())
            vertices.resize(v + 1);
          if (vertices[v].parts.empty())
            vertices[v].place = x;
          vertices[v].parts.push_back(p);
          parts[p].corners[c] = v;
        }
  }



  template <int dim>
  void
  RegionCut<dim>::find_crossings()
  {
    for (const Part &part : parts)
      for (unsigned int a = 0; a <= dim; ++a)
        for (unsigned int b = 0; b <= dim; ++b)
          if (is_inside(part, a) && !is_inside(part, b))
            {
              const unsigned int inside  = part.corners[a],
                                 outside = part.corners[b];
              if (!crossing_of_edge
                     .emplace(std::minmax(inside, outside), crossings.size())
                     .second)
                continue;
              crossings.push_back(
                find_crossing(seeds[part.seed], inside, outside));
            }
    for (const Crossing &crossing : crossings)
      for (const auto &[v, share] : crossing.ends())
        {
          vertices[v].is_on_border |= share < rounding::places;
          vertices[v].touches |= share < touching;
          vertices[v].beyond.push_back(crossing.inside + crossing.outside - v);
        }
  }



  template <int dim>
  typename RegionCut<dim>::Crossing
  RegionCut<dim>::find_crossing(const Seed<dim>   &seed,
                                const unsigned int inside,
                                const unsigned int outside) const
  {
    const Point<dim> from = vertices[inside].place,
                     to   = vertices[outside].place;
    // what is on the border elsewhere, too, has to be seen from within
    const bool is_plain = is_in(from) && !is_in(to);
    double     lower = 0, upper = 1;
    while (upper - lower > rounding::numbers)
      {
        const double     middle = (lower + upper) / 2;
        const Point<dim> x      = from + middle * (to - from);
        ((is_plain ? is_in(x) : is_in_from(seed, x)) ? lower : upper) = middle;
      }
    const double share = (lower + upper) / 2;
    return {inside, outside, from + share * (to - from), share};
  }



  template <int dim>
  void
  RegionCut<dim>::find_fixed_faces()
  {
    // by vertices, material, zone and which of them are inside: a part, a
    // corner, and whether there are two
    std::map<std::array<unsigned int, dim + 3>, std::array<unsigned int, 3>>
      faces;
    for (unsigned int p = 0; p < parts.size(); ++p)
      for (unsigned int c = 0; c <= dim; ++c)
        {
          const Seed<dim> &seed = seeds[parts[p].seed];
          std::vector<std::pair<unsigned int, bool>> corners;
          for (unsigned int i = 0; i <= dim; ++i)
            if (const unsigned int v = parts[p].corners[i]; i != c)
              corners.emplace_back(v,
                                   is_inside(parts[p], i) &&
                                     !vertices[v].touches);
          std::sort(corners.begin(), corners.end());
          std::array<unsigned int, dim + 3> key{};
          for (unsigned int i = 0; i < dim; ++i)
            {
              key[i] = corners[i].first;
              key[dim + 2] |= (corners[i].second ? 1u : 0u) << i;
            }
          key[dim]         = seed.material;
          key[dim + 1]     = seed.zone;
          const auto found = faces.insert({key, {{p, c, 0}}});
          if (!found.second)
            found.first->second[2] = 1;
        }
    for (const auto &[key, face] : faces)
      {
        const auto &[p, c, is_between] = face;
        // of what is dropped no face is fixed
        const bool stays = keep_outside || key[dim + 2] != 0;
        for (unsigned int i = 0; i < dim && is_between == 0 && stays; ++i)
          vertices[key[i]].normals.push_back(
            normal<dim>(seeds[parts[p].seed].domain, c));
      }
  }



  template <int dim>
  void
  RegionCut<dim>::move_vertices()
  {
    // by how far (rounded, so that axes can be exchanged): vertex, crossing
    std::vector<std::tuple<float, unsigned int, unsigned int>> candidates;
    for (unsigned int i = 0; i < crossings.size(); ++i)
      for (const auto &[v, share] : crossings[i].ends())
        if (share < near + rounding::places)
          candidates.emplace_back(
            crossings[i].place.distance(vertices[v].place), v, i);
    std::sort(candidates.begin(), candidates.end());
    for (const auto &[distance, v, i] : candidates)
      {
        const Crossing &crossing = crossings[i];
        if (vertices[crossing.inside].is_on_border ||
            vertices[crossing.outside].is_on_border)
          continue;
        Vertex &vertex      = vertices[v];
        vertex.is_moved     = may_move(vertex, crossing.place);
        vertex.is_on_border = vertex.is_moved || vertex.touches;
        if (vertex.is_moved)
          vertex.place = crossing.place;
      }
  }



  template <int dim>
  bool
  RegionCut<dim>::may_move(const Vertex &vertex, const Point<dim> &place) const
  {
    const Tensor<1, dim> step = place - vertex.place;
    for (const Tensor<1, dim> &n : vertex.normals)
      if (std::abs(n * step) > rounding::places * step.norm())
        return false;
    // not across a gap, or a body, in which there is no other vertex
    for (const unsigned int v : vertex.beyond)
      if (const Tensor<1, dim> edge = vertices[v].place - vertex.place;
          !vertices[v].is_on_border &&
          edge * step < -rounding::places * edge.norm() * step.norm())
        return false;
    // not beyond a face, where domains have other shapes than a grid's
    for (const unsigned int p : vertex.parts)
      {
        std::array<Point<dim>, dim + 1> corners;
        for (unsigned int c = 0; c <= dim; ++c)
          {
            const Vertex &corner = vertices[parts[p].corners[c]];
            corners[c]           = &corner == &vertex ? place : corner.place;
          }
        if (volume<dim>(corners) < near * seeds[parts[p].seed].volume)
          return false;
      }
    return true;
  }



  template <int dim>
  void
  RegionCut<dim>::number_crossings()
  {
    std::vector<std::tuple<float, float, unsigned int>> order;
    for (unsigned int i = 0; i < crossings.size(); ++i)
      {
        const Crossing &crossing = crossings[i];
        const Vertex   &in       = vertices[crossing.inside],
                     &out        = vertices[crossing.outside];
        if (!in.is_on_border && !out.is_on_border)
          order.emplace_back(-(out.place - in.place).norm(), crossing.share, i);
        else
          crossing_of_edge.erase(
            std::minmax(crossing.inside, crossing.outside));
      }
    std::sort(order.begin(), order.end());
    for (unsigned int rank = 0; rank < order.size(); ++rank)
      {
        Crossing &crossing = crossings[std::get<2>(order[rank])];
        crossing.rank      = rank;
        crossing.vertex    = vertices.size();
        vertices.emplace_back();
        vertices.back().place        = crossing.place;
        vertices.back().is_on_border = vertices.back().is_moved = true;
      }
  }



  template <int dim>
  std::vector<typename RegionCut<dim>::Corners>
  RegionCut<dim>::divide(const Part &part) const
  {
    std::vector<Corners>  pieces = {part.corners};
    std::vector<Crossing> here;
    for (unsigned int a = 0; a <= dim; ++a)
      for (unsigned int b = 0; b < a; ++b)
        {
          const auto found = crossing_of_edge.find(
            std::minmax(part.corners[a], part.corners[b]));
          if (found != crossing_of_edge.end())
            here.push_back(crossings[found->second]);
        }
    std::sort(here.begin(), here.end(), [](const auto &a, const auto &b) {
      return a.rank < b.rank;
    });
    for (const Crossing &crossing : here)
      for (unsigned int i = 0, n = pieces.size(); i < n; ++i)
        {
          const auto in  = std::find(pieces[i].begin(),
                                    pieces[i].end(),
                                    crossing.inside),
                     out = std::find(pieces[i].begin(),
                                     pieces[i].end(),
                                     crossing.outside);
          if (in == pieces[i].end() || out == pieces[i].end())
            continue;
          Corners other                 = pieces[i];
          other[in - pieces[i].begin()] = crossing.vertex;
          *out                          = crossing.vertex;
          pieces.push_back(other);
        }
    return pieces;
  }



  template <int dim>
  Seed<dim>
  RegionCut<dim>::seed_of(const Part &part, const Corners &corners) const
  {
    Seed<dim> seed = seeds[part.seed];
    if (std::none_of(corners.begin(), corners.end(), [&](const auto v) {
          return vertices[v].is_moved;
        }))
      return seed;
    std::array<Point<dim>, dim + 1> places;
    for (unsigned int c = 0; c <= dim; ++c)
      places[c] = vertices[corners[c]].place;
    seed.volume   = volume<dim>(places);
    seed.location = places[0];
    for (unsigned int c = 1; c <= dim; ++c)
      seed.location += (places[c] - places[0]) / (dim + 1.);
    for (unsigned int c = 0; c <= dim; ++c)
      seed.domain[c] = places[c] - seed.location;
    return seed;
  }



  template <int dim>
  bool
  RegionCut<dim>::is_piece_inside(const Part      &part,
                                  const Corners   &corners,
                                  const Seed<dim> &seed) const
  {
    // a corner that isn't on the border is one of the whole
    for (unsigned int c = 0; c <= dim; ++c)
      if (!vertices[corners[c]].is_on_border)
        return is_inside(part, c);
    return is_in(seed.location);
  }



  template class RegionCut<2>;
  template class RegionCut<3>;
} // namespace isochor
