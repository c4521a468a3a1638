/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <isochor/grid/simplex_coordinates.h>
#include <isochor/material_points/outer_faces.h>
#include <isochor/material_points/place_table.h>

#include <algorithm>
#include <limits>
#include <map>

namespace isochor
{
  namespace
  {
    constexpr unsigned int several = static_cast<unsigned int>(-1);

    /** The place on the other side of the face of @p seed opposite to corner
     * @p c, by a thousandth of the height of the domain. */
    template <int dim>
    Point<dim>
    place_behind(const Seed<dim> &seed, const unsigned int c)
    {
      AssertIndexRange(c, dim + 1);
      constexpr double by = 1e-3;
      // the centroid of the face is minus the corner's vector over dim
      return seed.location - (1. / dim + by) * seed.domain[c];
    }

    template <int dim>
    bool
    is_inside(const Seed<dim> &seed, const Point<dim> &x)
    {
      const auto lambda =
        simplex_coordinates<dim>(seed.domain, x - seed.location);
      return std::all_of(lambda.begin(), lambda.end(), [](const double l) {
        return l >= 0;
      });
    }

    template <int dim>
    double
    smallest_edge(const std::vector<Seed<dim>> &seeds)
    {
      Assert(!seeds.empty(), ExcInternalError());
      double smallest = std::numeric_limits<double>::max();
      for (const Seed<dim> &seed : seeds)
        for (unsigned int c = 0; c < dim; ++c)
          smallest =
            std::min(smallest,
                     (seed.domain[c + 1] - seed.domain[c]).norm_square());
      return std::sqrt(smallest);
    }

    /** The faces that are no faces of another domain of the same body, as pairs
     * (seed, corner opposite to it). */
    template <int dim>
    std::vector<std::pair<unsigned int, unsigned int>>
    unmatched_faces(const std::vector<Seed<dim>>    &seeds,
                    const std::vector<unsigned int> &body)
    {
      // meshes of bodies are rounded to some digits in their files
      constexpr double rounding = 1e-4;
      PlaceTable<dim>  places(
        {seeds.front().location, rounding * smallest_edge(seeds)});
      // by its corners and the body: the face, or that there are several
      std::map<std::array<unsigned int, dim + 1>,
               std::pair<unsigned int, unsigned int>>
        faces;
      for (unsigned int s = 0; s < seeds.size(); ++s)
        for (unsigned int c = 0; c <= dim; ++c)
          {
            std::array<unsigned int, dim + 1> key;
            unsigned int                      i = 0;
            for (unsigned int other = 0; other <= dim; ++other)
              if (other != c)
                key[i++] = places.find_or_add(seeds[s].location +
                                              seeds[s].domain[other]);
            std::sort(key.begin(), key.begin() + dim);
            key[dim]         = body.empty() ? 0 : body[s];
            const auto found = faces.emplace(key, std::make_pair(s, c));
            if (!found.second)
              found.first->second.first = several;
          }
      std::vector<std::pair<unsigned int, unsigned int>> alone;
      for (const auto &face : faces)
        if (face.second.first != several)
          alone.push_back(face.second);
      return alone;
    }
  } // namespace



  template <int dim>
  void
  find_outer_faces(std::vector<Seed<dim>>          &seeds,
                   const std::vector<unsigned int> &body)
  {
    Assert(body.empty() || body.size() == seeds.size(), ExcInternalError());
    namespace bgi = boost::geometry::index;
    for (Seed<dim> &seed : seeds)
      seed.outer_faces = 0;
    if (seeds.empty())
      return;
    const auto faces = unmatched_faces(seeds, body);
    // where neighbours divide a face between them differently their faces
    // don't match, but there is a domain on the other side; only domains with
    // such faces can be there
    using Entry = std::pair<BoundingBox<dim>, unsigned int>;
    std::vector<Entry> boxes;
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        const unsigned int      s = faces[i].first;
        std::vector<Point<dim>> corners;
        for (const Tensor<1, dim> &corner : seeds[s].domain)
          corners.push_back(seeds[s].location + corner);
        boxes.emplace_back(BoundingBox<dim>(corners), s);
      }
    const auto         tree = pack_rtree(boxes);
    std::vector<Entry> near;
    for (const auto &[s, c] : faces)
      {
        const Point<dim> x = place_behind(seeds[s], c);
        near.clear();
        tree.query(bgi::intersects(x), std::back_inserter(near));
        bool is_between = false, is_between_bodies = false;
        for (const Entry &entry : near)
          if (entry.second != s && is_inside(seeds[entry.second], x))
            (body.empty() || body[entry.second] == body[s] ?
               is_between :
               is_between_bodies) = true;
        if (!is_between)
          seeds[s].outer_faces |= (is_between_bodies ? flags_of_face : 1u) << c;
      }
  }



  template void
  find_outer_faces(std::vector<Seed<2>> &, const std::vector<unsigned int> &);
  template void
  find_outer_faces(std::vector<Seed<3>> &, const std::vector<unsigned int> &);
} // namespace isochor
