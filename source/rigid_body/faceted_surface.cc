/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/rigid_body/faceted_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  template <int dim>
  FacetedSurface<dim>::FacetedSurface(SurfaceMesh<dim>   surface,
                                      const std::string &subject)
    : closed(std::move(surface), subject)
    , mesh(closed.mesh)
  {
    find_normals();
    std::vector<Value> all;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      {
        std::vector<Point<dim>> corners;
        for (const unsigned int v : mesh.facets[f])
          corners.push_back(mesh.vertices[v]);
        all.emplace_back(BoundingBox<dim>(corners), f);
      }
    boxes = pack_rtree(all);
  }



  template <int dim>
  double
  FacetedSurface<dim>::angle(const unsigned int facet,
                             const unsigned int i) const
  {
    if (dim == 2)
      return 1;
    const auto          &corners = mesh.facets[facet];
    const Point<dim>    &at      = mesh.vertices[corners[i]];
    const Tensor<1, dim> a       = mesh.vertices[corners[(i + 1) % dim]] - at,
                         b       = mesh.vertices[corners[(i + 2) % dim]] - at;
    return std::acos(std::clamp(a * b / (a.norm() * b.norm()), -1., 1.));
  }



  template <int dim>
  typename FacetedSurface<dim>::Corner
  FacetedSurface<dim>::make_corner(const std::vector<Tensor<1, dim>> &normals,
                                   const Tensor<1, dim> &weighted_sum)
  {
    // what the rounding of single precision does to normals
    constexpr double equal = 1e-5;
    Corner           result;
    result.pseudo_normal = weighted_sum;
    if (weighted_sum.norm() > 0)
      result.pseudo_normal /= weighted_sum.norm();
    // facets without an area have no normal
    Tensor<1, dim> first;
    for (const auto &normal : normals)
      if (normal.norm() > 0)
        first = normal;
    Tensor<1, dim> other = first;
    for (const auto &normal : normals)
      if (normal.norm() > 0 && (normal - first).norm() > (other - first).norm())
        other = normal;
    result.is_flat = (other - first).norm() < equal;
    if constexpr (dim == 3)
      if (!result.is_flat)
        {
          const Tensor<1, dim> along = cross_product_3d(first, other);
          if (along.norm() > equal &&
              std::all_of(normals.begin(), normals.end(), [&](const auto &n) {
                return std::abs(n * along) <= equal * along.norm();
              }))
            result.edge = along / along.norm();
        }
    return result;
  }



  template <int dim>
  void
  FacetedSurface<dim>::find_normals()
  {
    const unsigned int n = mesh.facets.size();
    normals.resize(n);
    std::vector<std::vector<Tensor<1, dim>>> around(mesh.vertices.size());
    std::vector<Tensor<1, dim>>              sums(mesh.vertices.size());
    for (unsigned int f = 0; f < n; ++f)
      {
        const Tensor<1, dim> vector = closed.normal_vector(f);
        if (vector.norm() > 0)
          normals[f] = vector / vector.norm();
        for (unsigned int i = 0; i < dim; ++i)
          {
            around[mesh.facets[f][i]].push_back(normals[f]);
            sums[mesh.facets[f][i]] += angle(f, i) * normals[f];
          }
      }
    for (unsigned int v = 0; v < sums.size(); ++v)
      at_vertices.push_back(make_corner(around[v], sums[v]));
    if (dim == 2)
      return;
    at_edges.resize(dim * n / 2);
    for (unsigned int f = 0; f < n; ++f)
      for (unsigned int i = 0; i < dim; ++i)
        {
          const auto &other = normals[closed.neighbours[f][i]];
          Corner     &edge  = at_edges[closed.ridges[f][i]];
          edge = make_corner({normals[f], other}, normals[f] + other);
          Tensor<1, dim> along = mesh.vertices[mesh.facets[f][(i + 1) % dim]] -
                                 mesh.vertices[mesh.facets[f][(i + 2) % dim]];
          edge.edge = along / along.norm();
        }
  }



  template <int dim>
  typename FacetedSurface<dim>::Candidate
  FacetedSurface<dim>::nearest(const unsigned int facet,
                               const Point<dim>  &x) const
  {
    const auto &corners = mesh.facets[facet];
    const auto  vertex  = [&](const unsigned int i) -> const Point<dim>  &{
      return mesh.vertices[corners[i]];
    };
    Candidate  best{std::numeric_limits<double>::max(), Point<dim>(), 0};
    const auto try_point = [&](const Point<dim>  &point,
                               const unsigned int set) {
      const double d = x.distance_square(point);
      if (d < best.distance_square)
        best = {d, point, set};
    };
    if constexpr (dim == 3)
      {
        // inside of the triangle if on the inner side of its edges
        const Tensor<1, dim> &n         = normals[facet];
        bool                  is_inside = n.norm() > 0;
        for (unsigned int i = 0; i < dim && is_inside; ++i)
          {
            const Point<dim> &a = vertex(i), &b = vertex((i + 1) % dim);
            is_inside = cross_product_3d(b - a, x - a) * n >= 0;
          }
        if (is_inside)
          {
            try_point(x - ((x - vertex(0)) * n) * n, 7);
            return best;
          }
      }
    for (unsigned int i = 0; i < (dim == 2 ? 1 : dim); ++i)
      {
        const unsigned int   j    = (i + 1) % dim;
        const Tensor<1, dim> edge = vertex(j) - vertex(i);
        const double         s    = (x - vertex(i)) * edge / edge.norm_square();
        if (s > 0 && s < 1)
          try_point(vertex(i) + s * edge, (1u << i) + (1u << j));
        else
          try_point(vertex(s <= 0 ? i : j), 1u << (s <= 0 ? i : j));
      }
    return best;
  }



  template <int dim>
  const typename FacetedSurface<dim>::Corner &
  FacetedSurface<dim>::corner(const unsigned int facet,
                              const unsigned int corners) const
  {
    for (unsigned int i = 0; i < dim; ++i)
      if (corners == 1u << i)
        return at_vertices[mesh.facets[facet][i]];
    unsigned int opposite = 0;
    while ((corners >> opposite) & 1u)
      ++opposite;
    return at_edges[closed.ridges[facet][opposite]];
  }



  template <int dim>
  ClosestPoint<dim>
  FacetedSurface<dim>::closest(const Point<dim> &x) const
  {
    namespace bgi = boost::geometry::index;
    Candidate    best{std::numeric_limits<double>::max(), Point<dim>(), 0};
    unsigned int facet = 0;
    for (auto entry = boxes.qbegin(bgi::nearest(x, mesh.facets.size()));
         entry != boxes.qend();
         ++entry)
      {
        // the boxes come in the order of their distances
        if (boost::geometry::comparable_distance(x, entry->first) >
            best.distance_square)
          break;
        const Candidate candidate = nearest(entry->second, x);
        if (candidate.distance_square < best.distance_square)
          {
            best  = candidate;
            facet = entry->second;
          }
      }
    ClosestPoint<dim>      result;
    constexpr unsigned int all     = (1u << dim) - 1;
    const bool             is_face = best.corners == all;
    const Corner *at         = is_face ? nullptr : &corner(facet, best.corners);
    result.normal            = is_face ? normals[facet] : at->pseudo_normal;
    const Tensor<1, dim> arm = x - best.point;
    if (is_face || at->is_flat)
      {
        result.distance = arm * result.normal;
        result.point    = x - result.distance * result.normal;
        return result;
      }
    result.point    = best.point;
    result.distance = arm.norm() * (arm * result.normal >= 0 ? 1. : -1.);
    round_corner(x, at->edge, result);
    return result;
  }



  template <int dim>
  std::vector<std::array<Point<dim>, dim>>
  FacetedSurface<dim>::facets() const
  {
    std::vector<std::array<Point<dim>, dim>> result;
    for (const auto &facet : mesh.facets)
      {
        result.emplace_back();
        for (unsigned int i = 0; i < dim; ++i)
          result.back()[i] = mesh.vertices[facet[i]];
      }
    return result;
  }



  template <int dim>
  BoundingBox<dim>
  FacetedSurface<dim>::box() const
  {
    return BoundingBox<dim>(mesh.vertices);
  }



  template class FacetedSurface<2>;
  template class FacetedSurface<3>;
} // namespace isochor
