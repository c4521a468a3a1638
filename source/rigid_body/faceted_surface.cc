/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/numerics/rtree.h>

#include <isochor/base/plain_message.h>
#include <isochor/rigid_body/faceted_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace isochor
{
  /** The boxes of the facets. */
  template <int dim>
  struct FacetedSurface<dim>::Tree
  {
    using Value = std::pair<BoundingBox<dim>, unsigned int>;
    RTree<Value> boxes;
  };



  namespace
  {
    template <int dim>
    std::string
    text(const Point<dim> &x)
    {
      std::string result = "(";
      for (unsigned int d = 0; d < dim; ++d)
        result += (d > 0 ? ", " : "") + rounded(x[d]);
      return result + ")";
    }



    /** As long as twice the area (3D) or as the segment (2D). */
    template <int dim>
    Tensor<1, dim>
    normal_vector(const std::array<Point<dim>, dim> &corners)
    {
      if constexpr (dim == 2)
        return Tensor<1, 2>(
          {corners[1][1] - corners[0][1], corners[0][0] - corners[1][0]});
      else
        return cross_product_3d(corners[1] - corners[0],
                                corners[2] - corners[0]);
    }
  } // namespace



  template <int dim>
  FacetedSurface<dim>::FacetedSurface(SurfaceMesh<dim>   surface,
                                      const std::string &subject)
    : mesh(std::move(surface))
    , tree(std::make_unique<Tree>())
  {
    Assert(!mesh.facets.empty(), ExcMessage("There is no surface."));
    find_neighbours(subject);
    turn_outwards(orient(subject));
    find_normals();
    std::vector<typename Tree::Value> boxes;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      {
        std::vector<Point<dim>> corners;
        for (const unsigned int v : mesh.facets[f])
          corners.push_back(mesh.vertices[v]);
        boxes.emplace_back(BoundingBox<dim>(corners), f);
      }
    tree->boxes = pack_rtree(boxes);
  }



  template <int dim>
  FacetedSurface<dim>::~FacetedSurface() = default;



  template <int dim>
  typename FacetedSurface<dim>::Ridge
  FacetedSurface<dim>::ridge(const std::array<unsigned int, dim> &facet,
                             const unsigned int                   i)
  {
    Ridge result;
    for (unsigned int k = 0; k + 1 < dim; ++k)
      result[k] = facet[(i + 1 + k) % dim];
    std::sort(result.begin(), result.end());
    return result;
  }



  template <int dim>
  void
  FacetedSurface<dim>::find_neighbours(const std::string &subject)
  {
    const unsigned int n = mesh.facets.size();
    std::map<Ridge, std::vector<std::pair<unsigned int, unsigned int>>> all;
    for (unsigned int f = 0; f < n; ++f)
      for (unsigned int i = 0; i < dim; ++i)
        all[ridge(mesh.facets[f], i)].emplace_back(f, i);
    neighbours.resize(n);
    ridges.resize(n);
    unsigned int number = 0;
    for (const auto &[vertices, sides] : all)
      {
        std::string where = text(mesh.vertices[vertices.front()]);
        if (dim == 3)
          where += " - " + text(mesh.vertices[vertices.back()]);
        AssertThrow(sides.size() == 2,
                    ExcMessage(
                      subject + "is not a closed surface: " +
                      std::to_string(sides.size()) +
                      (dim == 2 ? " lines end at " : " triangles share ") +
                      (dim == 2 ? "the point " : "the edge ") + where +
                      ", where there must be 2."));
        for (const unsigned int k : {0, 1})
          {
            const auto [f, i] = sides[k];
            neighbours[f][i]  = sides[1 - k].first;
            ridges[f][i]      = number;
          }
        ++number;
      }
  }



  template <int dim>
  bool
  FacetedSurface<dim>::agree(const unsigned int facet,
                             const unsigned int other,
                             const Ridge       &ridge) const
  {
    // they do if they run through the ridge in opposite directions
    const auto runs_up = [&](const unsigned int f) {
      const auto        &corners = mesh.facets[f];
      const unsigned int i =
        std::find(corners.begin(), corners.end(), ridge[0]) - corners.begin();
      if constexpr (dim == 2)
        return i == 0;
      else
        return corners[(i + 1) % dim] == ridge.back();
    };
    return runs_up(facet) != runs_up(other);
  }



  template <int dim>
  void
  FacetedSurface<dim>::turn(const unsigned int facet)
  {
    for (auto *of_corners : {&mesh.facets, &neighbours, &ridges})
      std::swap((*of_corners)[facet][0], (*of_corners)[facet][1]);
  }



  template <int dim>
  std::vector<unsigned int>
  FacetedSurface<dim>::orient(const std::string &subject)
  {
    constexpr unsigned int    none = numbers::invalid_unsigned_int;
    std::vector<unsigned int> part(mesh.facets.size(), none);
    unsigned int              n_parts = 0;
    for (unsigned int first = 0; first < part.size(); ++first)
      {
        if (part[first] != none)
          continue;
        std::vector<unsigned int> pending(1, first);
        part[first] = n_parts;
        while (!pending.empty())
          {
            const unsigned int f = pending.back();
            pending.pop_back();
            for (unsigned int i = 0; i < dim; ++i)
              {
                const unsigned int other  = neighbours[f][i];
                const Ridge        common = ridge(mesh.facets[f], i);
                const bool         agrees = agree(f, other, common);
                AssertThrow(part[other] == none || agrees,
                            ExcMessage(subject +
                                       "has no inside: its facets can't all "
                                       "look outwards, near " +
                                       text(mesh.vertices[common[0]]) + "."));
                if (part[other] != none)
                  continue;
                if (!agrees)
                  turn(other);
                part[other] = n_parts;
                pending.push_back(other);
              }
          }
        ++n_parts;
      }
    return part;
  }



  template <int dim>
  void
  FacetedSurface<dim>::turn_outwards(const std::vector<unsigned int> &part)
  {
    std::vector<std::vector<unsigned int>> parts;
    for (unsigned int f = 0; f < part.size(); ++f)
      {
        parts.resize(std::max<std::size_t>(parts.size(), part[f] + 1));
        parts[part[f]].push_back(f);
      }
    for (const auto &facets : parts)
      {
        // dim times the volume
        double           volume = 0;
        const Point<dim> origin = mesh.vertices[mesh.facets[facets[0]][0]];
        for (const unsigned int f : facets)
          {
            std::array<Point<dim>, dim> corners;
            for (unsigned int i = 0; i < dim; ++i)
              corners[i] = mesh.vertices[mesh.facets[f][i]];
            volume += normal_vector<dim>(corners) * (corners[0] - origin);
          }
        if (volume < 0)
          for (const unsigned int f : facets)
            turn(f);
      }
    // how many other parts are around each
    std::vector<unsigned int> n_around(parts.size(), 0);
    for (unsigned int p = 0; p < parts.size(); ++p)
      for (unsigned int q = 0; q < parts.size(); ++q)
        if (p != q)
          n_around[p] +=
            winding(parts[q], mesh.vertices[mesh.facets[parts[p][0]][0]]) > 0.5;
    for (unsigned int p = 0; p < parts.size(); ++p)
      if (n_around[p] % 2 == 1)
        for (const unsigned int f : parts[p])
          turn(f);
  }



  template <int dim>
  double
  FacetedSurface<dim>::winding(const std::vector<unsigned int> &facets,
                               const Point<dim>                &x) const
  {
    double sum = 0;
    for (const unsigned int f : facets)
      {
        std::array<Tensor<1, dim>, dim> arm;
        for (unsigned int i = 0; i < dim; ++i)
          arm[i] = mesh.vertices[mesh.facets[f][i]] - x;
        if constexpr (dim == 2)
          sum += std::atan2(arm[0][0] * arm[1][1] - arm[0][1] * arm[1][0],
                            arm[0] * arm[1]);
        else
          {
            // van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125
            const double a = arm[0].norm(), b = arm[1].norm(),
                         c = arm[2].norm();
            sum += std::atan2(arm[0] * cross_product_3d(arm[1], arm[2]),
                              a * b * c + (arm[0] * arm[1]) * c +
                                (arm[1] * arm[2]) * a + (arm[2] * arm[0]) * b);
          }
      }
    return sum / (2 * numbers::PI);
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
        std::array<Point<dim>, dim> corners;
        for (unsigned int i = 0; i < dim; ++i)
          corners[i] = mesh.vertices[mesh.facets[f][i]];
        const Tensor<1, dim> vector = normal_vector<dim>(corners);
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
          const auto &other = normals[neighbours[f][i]];
          Corner     &edge  = at_edges[ridges[f][i]];
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
    return at_edges[ridges[facet][opposite]];
  }



  template <int dim>
  ClosestPoint<dim>
  FacetedSurface<dim>::closest(const Point<dim> &x) const
  {
    namespace bgi = boost::geometry::index;
    Candidate    best{std::numeric_limits<double>::max(), Point<dim>(), 0};
    unsigned int facet = 0;
    for (auto entry = tree->boxes.qbegin(bgi::nearest(x, mesh.facets.size()));
         entry != tree->boxes.qend();
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
        if (from_box > best.distance_square)
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
    // a direction that isn't that of rounding
    constexpr double rounding = 1e-12;
    if (arm.norm() > rounding * (x.norm() + best.point.norm()))
      {
        result.normal = arm / result.distance;
        result.curvature =
          rounded_curvature(result.distance, result.normal, at->edge);
      }
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
