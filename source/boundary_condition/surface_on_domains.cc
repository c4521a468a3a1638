/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/boundary_condition/surface_on_domains.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** What places may differ by that are the same, in the size of a face of
     * the surface: when it is found to consist of faces of domains, and
     * afterwards, so that it stays one when these are split. */
    constexpr double tolerance = 1e-6, later_tolerance = 1e-5;
    /** Barycentric coordinates below this are zero. */
    constexpr double no_coordinate = 1e-9;

    template <int dim, typename Corners>
    BoundingBox<dim>
    box_around(const Corners &corners)
    {
      std::pair<Point<dim>, Point<dim>> ends(corners[0], corners[0]);
      for (const Point<dim> &corner : corners)
        for (unsigned int d = 0; d < dim; ++d)
          {
            ends.first[d]  = std::min(ends.first[d], corner[d]);
            ends.second[d] = std::max(ends.second[d], corner[d]);
          }
      return BoundingBox<dim>(ends);
    }

    template <int dim>
    double
    size_of(const std::array<Point<dim>, dim + 1> &simplex)
    {
      double size = 0;
      for (unsigned int c = 1; c <= dim; ++c)
        size = std::max(size, (simplex[c] - simplex[0]).norm());
      return size;
    }

    template <int dim>
    double
    size_of(const SurfaceFace<dim> &face)
    {
      double size = 0;
      for (unsigned int c = 1; c < dim; ++c)
        size = std::max(size, (face.corners[c] - face.corners[0]).norm());
      return size;
    }

    /** Whether the face of @p domain opposite to corner @p opposite lies in the
     * plane of @p face, and the domain on the inner side of it. */
    template <int dim>
    bool
    lies_in_plane(const std::array<Point<dim>, dim + 1> &domain,
                  const unsigned int                     opposite,
                  const SurfaceFace<dim>                &face,
                  const bool                             at_start)
    {
      const Tensor<1, dim> n = face.area / face.area.norm();
      const double         eps =
        at_start ? tolerance * std::min(size_of<dim>(domain), size_of(face)) :
                           later_tolerance * size_of(face);
      for (unsigned int c = 0; c <= dim; ++c)
        {
          const double height = (domain[c] - face.corners[0]) * n;
          if (c == opposite ? height > -eps : std::abs(height) > eps)
            return false;
        }
      return true;
    }

    /** The part of a segment (dim = 2, two corners) or convex polygon (3) where
     * @p coordinate, which is linear, is not negative. */
    template <int dim, typename Linear>
    std::vector<Point<dim>>
    cut(const std::vector<Point<dim>> &polygon, const Linear &coordinate)
    {
      const unsigned int      n = polygon.size();
      std::vector<Point<dim>> part;
      for (unsigned int i = 0; i < n; ++i)
        {
          const Point<dim> &a = polygon[i], &b = polygon[(i + 1) % n];
          const double      at_a = coordinate(a), at_b = coordinate(b);
          const bool        a_inside = at_a > -no_coordinate,
                     b_inside        = at_b > -no_coordinate;
          if (a_inside)
            part.push_back(a);
          // a segment has no way back
          if (a_inside != b_inside && (dim == 3 || i + 1 < n))
            part.push_back(a + at_a / (at_a - at_b) * (b - a));
        }
      return part;
    }
  } // namespace



  template <int dim>
  SurfaceOnDomains<dim>::SurfaceOnDomains(
    const std::vector<SurfaceFace<dim>> &faces)
    : all_faces(faces)
  {
    std::vector<Entry> entries;
    for (unsigned int f = 0; f < faces.size(); ++f)
      entries.emplace_back(box_around<dim>(faces[f].corners), f);
    tree = pack_rtree(entries);
  }



  template <int dim>
  std::vector<typename SurfaceOnDomains<dim>::Part>
  SurfaceOnDomains<dim>::parts(const SimplexGeometry<dim> &geometry,
                               const PointArrays<dim>     &body,
                               const bool                  at_start) const
  {
    namespace bgi = boost::geometry::index;
    std::vector<Part>               result;
    std::vector<Entry>              near;
    std::array<Point<dim>, dim + 1> domain;
    for (unsigned int k = 0; k < body.n_occupied_cells && !tree.empty(); ++k)
      for (unsigned int q = body.cell_start[k]; q < body.cell_start[k + 1]; ++q)
        {
          const Point<dim> X =
            body.location(geometry, k, q) - body.displacement[q];
          for (unsigned int c = 0; c <= dim; ++c)
            domain[c] = X + body.domain[q][c];
          BoundingBox<dim> box = box_around<dim>(domain);
          box.extend(later_tolerance * size_of<dim>(domain));
          near.clear();
          tree.query(bgi::intersects(box), std::back_inserter(near));
          std::sort(near.begin(),
                    near.end(),
                    [](const Entry &a, const Entry &b) {
                      return a.second < b.second;
                    });
          for (const Entry &entry : near)
            add_parts(entry.second, domain, k, q, at_start, result);
        }
    return result;
  }



  template <int dim>
  void
  SurfaceOnDomains<dim>::add_parts(
    const unsigned int                     f,
    const std::array<Point<dim>, dim + 1> &domain,
    const unsigned int                     k,
    const unsigned int                     q,
    const bool                             at_start,
    std::vector<Part>                     &parts) const
  {
    const FaceCorners<dim> &corners = all_faces[f].corners;
    Tensor<2, dim>          edges;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        edges[d][c] = domain[c + 1][d] - domain[0][d];
    for (unsigned int opposite = 0; opposite <= dim; ++opposite)
      {
        if (!lies_in_plane<dim>(domain, opposite, all_faces[f], at_start))
          continue;
        const Tensor<2, dim>    inverse = invert(edges);
        std::vector<Point<dim>> polygon(corners.begin(), corners.end());
        for (unsigned int c = 0; c <= dim && !polygon.empty(); ++c)
          if (c != opposite)
            polygon = cut<dim>(polygon, [&](const Point<dim> &x) {
              const Tensor<1, dim> lambda = inverse * (x - domain[0]);
              double               first  = 1;
              for (unsigned int d = 0; d < dim; ++d)
                first -= lambda[d];
              return c == 0 ? first : lambda[c - 1];
            });
        FaceCorners<dim> of_domain;
        for (unsigned int c = 0, i = 0; c <= dim; ++c)
          if (c != opposite)
            of_domain[i++] = domain[c];
        const double least = no_coordinate * std::min(measure<dim>(corners),
                                                      measure<dim>(of_domain));
        for (unsigned int i = 0; i + dim <= polygon.size(); ++i)
          {
            FaceCorners<dim> part;
            part[0] = polygon[0];
            for (unsigned int c = 1; c < dim; ++c)
              part[c] = polygon[i + c];
            if (measure<dim>(part) > least)
              parts.push_back({part, f, k, q});
          }
      }
  }



  template <int dim>
  std::vector<double>
  SurfaceOnDomains<dim>::covered_shares(const std::vector<Part> &parts,
                                        const MPI_Comm           comm) const
  {
    std::vector<double> shares(all_faces.size());
    for (const Part &part : parts)
      shares[part.face] +=
        measure<dim>(part.corners) / measure<dim>(all_faces[part.face].corners);
    Utilities::MPI::sum(shares, comm, shares);
    return shares;
  }



  template class SurfaceOnDomains<2>;
  template class SurfaceOnDomains<3>;
} // namespace isochor
