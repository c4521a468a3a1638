/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/numerics/rtree.h>

#include <isochor/base/rounding.h>
#include <isochor/interaction/face_projection.h>
#include <isochor/interaction/smooth_facets.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  namespace
  {
    template <std::size_t n, int dim>
    Point<dim>
    place_of(const std::array<Point<dim>, n> &corner,
             const std::array<double, n>     &weights)
    {
      Point<dim> p;
      for (unsigned int v = 0; v < n; ++v)
        p += weights[v] * corner[v];
      return p;
    }
  } // namespace



  /** A smooth part. */
  template <int dim>
  struct SmoothFacets<dim>::Part
  {
    using Value = std::pair<BoundingBox<dim>, unsigned int>;
    std::vector<unsigned int> facets;
    RTree<Value>              boxes;
    /** Whether it is a plane without a free rim, which any facet stands for. */
    bool is_plane = true;
  };



  template <int dim>
  SmoothFacets<dim>::SmoothFacets(std::vector<Facet> &&facets)
    : all_facets(std::move(facets))
  {
    for (unsigned int f = 0; f < all_facets.size(); ++f)
      {
        const unsigned int part = all_facets[f].part;
        parts.resize(std::max<std::size_t>(parts.size(), part + 1));
        parts[part].facets.push_back(f);
      }
    for (Part &part : parts)
      {
        std::vector<typename Part::Value> boxes;
        const Facet                      &first = all_facets[part.facets[0]];
        for (const unsigned int f : part.facets)
          {
            const Facet         &facet = all_facets[f];
            const Tensor<1, dim> r     = facet.corners[0] - first.corners[0];
            part.is_plane =
              part.is_plane &&
              std::abs(r * first.normal) <= rounding::accumulated * r.norm() &&
              std::count(facet.rims.begin(), facet.rims.end(), Rim::free) == 0;
            for (const Tensor<1, dim> &n : facet.normals)
              part.is_plane = part.is_plane &&
                              (n - first.normal).norm() < rounding::accumulated;
            boxes.emplace_back(BoundingBox<dim>(std::vector<Point<dim>>(
                                 facet.corners.begin(), facet.corners.end())),
                               f);
          }
        part.boxes = pack_rtree(boxes);
      }
  }



  template <int dim>
  SmoothFacets<dim>::~SmoothFacets() = default;



  template <int dim>
  bool
  SmoothFacets<dim>::is_flat() const
  {
    return std::all_of(parts.begin(), parts.end(), [](const Part &part) {
      return part.is_plane;
    });
  }



  template <int dim>
  typename SmoothFacets<dim>::Place
  SmoothFacets<dim>::evaluate(const unsigned int             number,
                              const std::array<double, dim> &weights,
                              const Point<dim>              &x) const
  {
    const Facet              &facet = all_facets[number];
    const Point<dim>          p     = place_of(facet.corners, weights);
    const FaceProjection<dim> on_plane(x, facet.corners);
    const auto                unclamped = on_plane.corner_weights();
    Place                     place;
    place.facet    = number;
    place.weights  = weights;
    place.distance = 0;
    bool is_inside = true, is_beyond = false;
    for (unsigned int v = 0; v < dim; ++v)
      {
        place.normal += weights[v] * facet.normals[v];
        place.distance +=
          weights[v] * (facet.normals[v] *
                        ((x - facet.corners[v]) - (p - facet.corners[v]) / 2));
        is_inside = is_inside && unclamped[v] >= -rounding::accumulated;
        is_beyond = is_beyond || (unclamped[v] < -rounding::accumulated &&
                                  facet.rims[v] == Rim::free);
      }
    const double         length = place.normal.norm();
    const Tensor<2, dim> T =
      Tensor<2, dim>(unit_symmetric_tensor<dim>()) -
      outer_product(place.normal, place.normal) / (length * length);
    place.normal /= length;
    if (is_inside)
      {
        Tensor<2, dim> turn;
        for (unsigned int a = 0; a + 1 < dim; ++a)
          turn += outer_product(facet.normals[a + 1] - facet.normals[0],
                                on_plane.dual[a]) /
                  length;
        place.curvature = symmetrize(T * turn * T);
      }
    else if (is_beyond && x.distance(p) > 0)
      {
        place.distance = x.distance(p);
        place.normal   = (x - p) / place.distance;
      }
    return place;
  }



  template <int dim>
  typename SmoothFacets<dim>::Place
  SmoothFacets<dim>::nearest_of(const Part &part, const Point<dim> &x) const
  {
    namespace bgi = boost::geometry::index;
    std::array<double, dim> weights{};
    if (part.is_plane)
      {
        weights[0]  = 1;
        Place place = evaluate(part.facets[0], weights, x);
        place.distance =
          place.normal * (x - all_facets[part.facets[0]].corners[0]);
        return place;
      }
    double       least = std::numeric_limits<double>::max();
    unsigned int facet = part.facets[0];
    for (auto entry = part.boxes.qbegin(bgi::nearest(x, part.facets.size()));
         entry != part.boxes.qend();
         ++entry)
      {
        // the boxes come in the order of their distances
        if (boost::geometry::comparable_distance(x, entry->first) > least)
          break;
        const FaceProjection<dim> at(x, all_facets[entry->second].corners);
        if (at.distance_square < least)
          {
            least   = at.distance_square;
            facet   = entry->second;
            weights = at.nearest;
          }
      }
    return evaluate(facet, weights, x);
  }



  template <int dim>
  typename SmoothFacets<dim>::Place
  SmoothFacets<dim>::nearest(const Point<dim>     &x,
                             const Tensor<1, dim> &nu) const
  {
    Place best, other;
    best.distance = other.distance = std::numeric_limits<double>::max();
    for (const Part &part : parts)
      {
        const Place place = nearest_of(part, x);
        Place      &one   = nu * place.normal < 0 ? best : other;
        if (place.distance < one.distance)
          one = place;
      }
    return best.distance < std::numeric_limits<double>::max() ? best : other;
  }



  template class SmoothFacets<2>;
  template class SmoothFacets<3>;
} // namespace isochor
