/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/numerics/rtree.h>

#include <isochor/interaction/smooth_facets.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  namespace
  {
    /** The gradients of the barycentric coordinates of a facet, in it. */
    std::array<Tensor<1, 2>, 2>
    gradients(const std::array<Point<2>, 2> &corner)
    {
      const Tensor<1, 2> edge = corner[1] - corner[0];
      return {{-edge / edge.norm_square(), edge / edge.norm_square()}};
    }

    std::array<Tensor<1, 3>, 3>
    gradients(const std::array<Point<3>, 3> &corner)
    {
      const Tensor<1, 3> a = corner[1] - corner[0], b = corner[2] - corner[0];
      const double aa = a * a, ab = a * b, bb = b * b, det = aa * bb - ab * ab;
      const Tensor<1, 3> first  = (bb * a - ab * b) / det,
                         second = (aa * b - ab * a) / det;
      return {{-first - second, first, second}};
    }

    /** Barycentric coordinates of @p x, projected to the plane. */
    template <std::size_t n, int dim>
    std::array<double, n>
    coordinates(const std::array<Point<dim>, n> &corner, const Point<dim> &x)
    {
      const auto            by_x = gradients(corner);
      std::array<double, n> weights{};
      weights[0] = 1;
      for (unsigned int v = 1; v < n; ++v)
        {
          weights[v] = by_x[v] * (x - corner[0]);
          weights[0] -= weights[v];
        }
      return weights;
    }

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
            constexpr double     rounding = 1e-10;
            const Facet         &facet    = all_facets[f];
            const Tensor<1, dim> r        = facet.corners[0] - first.corners[0];
            part.is_plane =
              part.is_plane &&
              std::abs(r * first.normal) <= rounding * r.norm() &&
              std::count(facet.rims.begin(), facet.rims.end(), Rim::free) == 0;
            for (const Tensor<1, dim> &n : facet.normals)
              part.is_plane =
                part.is_plane && (n - first.normal).norm() < rounding;
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
  double
  SmoothFacets<dim>::project(const Facet             &facet,
                             const Point<dim>        &x,
                             std::array<double, dim> &weights) const
  {
    weights = coordinates(facet.corners, x);
    if (std::all_of(weights.begin(), weights.end(), [](const double w) {
          return w >= 0;
        }))
      return x.distance_square(place_of(facet.corners, weights));
    // on one of the edges, which in 2D are the line itself
    double best = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < (dim == 2 ? 1 : dim); ++i)
      {
        const unsigned int   j    = (i + 1) % dim;
        const Tensor<1, dim> edge = facet.corners[j] - facet.corners[i];
        const double         s =
          std::clamp((x - facet.corners[i]) * edge / edge.norm_square(),
                     0.,
                     1.);
        const double square = x.distance_square(facet.corners[i] + s * edge);
        if (square < best)
          {
            best = square;
            weights.fill(0);
            weights[i] = 1 - s;
            weights[j] = s;
          }
      }
    return best;
  }



  template <int dim>
  typename SmoothFacets<dim>::Place
  SmoothFacets<dim>::evaluate(const unsigned int             number,
                              const std::array<double, dim> &weights,
                              const Point<dim>              &x) const
  {
    constexpr double rounding  = 1e-10;
    const Facet     &facet     = all_facets[number];
    const Point<dim> p         = place_of(facet.corners, weights);
    const auto       unclamped = coordinates(facet.corners, x);
    Place            place;
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
        is_inside = is_inside && unclamped[v] >= -rounding;
        is_beyond =
          is_beyond || (unclamped[v] < -rounding && facet.rims[v] == Rim::free);
      }
    const double         length = place.normal.norm();
    const Tensor<2, dim> T =
      Tensor<2, dim>(unit_symmetric_tensor<dim>()) -
      outer_product(place.normal, place.normal) / (length * length);
    place.normal /= length;
    if (is_inside)
      {
        const auto     by_x = gradients(facet.corners);
        Tensor<2, dim> turn;
        for (unsigned int v = 0; v < dim; ++v)
          turn += outer_product(facet.normals[v], by_x[v]) / length;
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
    std::array<double, dim> weights;
    if (part.is_plane)
      {
        weights.fill(0);
        weights[0]  = 1;
        Place place = evaluate(part.facets[0], weights, x);
        place.distance =
          place.normal * (x - all_facets[part.facets[0]].corners[0]);
        return place;
      }
    double                  least = std::numeric_limits<double>::max();
    unsigned int            facet = part.facets[0];
    std::array<double, dim> of_facet{};
    for (auto entry = part.boxes.qbegin(bgi::nearest(x, part.facets.size()));
         entry != part.boxes.qend();
         ++entry)
      {
        // the boxes come in the order of their distances
        double      from_box = 0;
        const auto &box      = entry->first.get_boundary_points();
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double beyond =
              std::max({box.first[d] - x[d], x[d] - box.second[d], 0.});
            from_box += beyond * beyond;
          }
        if (from_box > least)
          break;
        const double square = project(all_facets[entry->second], x, weights);
        if (square < least)
          {
            least    = square;
            facet    = entry->second;
            of_facet = weights;
          }
      }
    return evaluate(facet, of_facet, x);
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
