/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/wall_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace isochor
{
  namespace
  {
    /** Faces belong to one smooth piece if their normals' product is more. */
    const double smooth = std::cos(40. / 180. * numbers::PI);

    /** A face at a vertex: its number, its area vector into the grid. */
    template <int dim>
    struct FaceAtVertex
    {
      unsigned int   face;
      Tensor<1, dim> area;
    };

    /** For each of @p faces, those of one smooth piece have the same number. */
    template <int dim>
    std::vector<unsigned int>
    find_pieces(const std::vector<FaceAtVertex<dim>>             &faces,
                const std::vector<std::array<unsigned int, dim>> &vertices)
    {
      std::vector<unsigned int> piece(faces.size());
      std::iota(piece.begin(), piece.end(), 0);
      // faces that share an edge at the vertex (in 2D, the vertex itself)
      const auto share_edge = [&](const unsigned int i, const unsigned int j) {
        unsigned int n = 0;
        for (const unsigned int v : vertices[faces[i].face])
          for (const unsigned int w : vertices[faces[j].face])
            n += (v == w);
        return n + 1 >= dim;
      };
      for (bool changed = true; changed;)
        {
          changed = false;
          for (unsigned int i = 0; i < faces.size(); ++i)
            for (unsigned int j = 0; j < faces.size(); ++j)
              if (piece[i] < piece[j] && share_edge(i, j) &&
                  faces[i].area * faces[j].area >
                    smooth * faces[i].area.norm() * faces[j].area.norm())
                {
                  piece[j] = piece[i];
                  changed  = true;
                }
        }
      return piece;
    }

    /** Components that are rounding are zero: a wall along an axis holds what
     * a prescribed displacement does. */
    template <int dim>
    Tensor<1, dim>
    unit(Tensor<1, dim> n)
    {
      n /= n.norm();
      for (unsigned int a = 0; a < dim; ++a)
        if (std::abs(n[a]) < 1e-12)
          n[a] = 0;
      return n / n.norm();
    }

    /** Barycentric coordinates of the place on a face next to @p x, nearly so
     * where that is on its rim. */
    std::array<double, 2>
    nearest_on_face(const std::array<Point<2>, 2> &corner, const Point<2> &x)
    {
      const Tensor<1, 2> edge = corner[1] - corner[0];
      const double       t =
        std::clamp((x - corner[0]) * edge / edge.norm_square(), 0., 1.);
      return {{1 - t, t}};
    }

    std::array<double, 3>
    nearest_on_face(const std::array<Point<3>, 3> &corner, const Point<3> &x)
    {
      const Tensor<1, 3> a = corner[1] - corner[0], b = corner[2] - corner[0],
                         r = x - corner[0];
      const double aa = a * a, ab = a * b, bb = b * b, ra = r * a, rb = r * b;
      const double det = aa * bb - ab * ab;
      std::array<double, 3> lambda;
      lambda[1]  = (bb * ra - ab * rb) / det;
      lambda[2]  = (aa * rb - ab * ra) / det;
      lambda[0]  = 1 - lambda[1] - lambda[2];
      double sum = 0;
      for (double &l : lambda)
        sum += (l = std::max(l, 0.));
      for (double &l : lambda)
        l /= sum;
      return lambda;
    }
  } // namespace



  template <int dim>
  void
  WallSurface<dim>::initialize(const BackgroundGrid<dim> &grid,
                               const types::boundary_id   id)
  {
    const SimplexGeometry<dim>                &geometry = grid.geometry();
    std::vector<std::array<unsigned int, dim>> vertices;
    std::map<unsigned int, std::vector<FaceAtVertex<dim>>> at_vertex;
    for (const BoundaryFace &face : grid.boundary_faces())
      if (face.id == id)
        {
          // |e| ∇N of the opposite vertex is the face's area over dim
          const Tensor<1, dim> area =
            geometry.measure(face.cell) *
            geometry.gradients(face.cell)[face.opposite_vertex];
          std::array<unsigned int, dim> corners;
          unsigned int                  n = 0;
          for (unsigned int v = 0; v <= dim; ++v)
            if (v != face.opposite_vertex)
              {
                const unsigned int vertex =
                  geometry.vertex_indices(face.cell)[v];
                corners[n++] = vertex;
                at_vertex[vertex].push_back(
                  {static_cast<unsigned int>(vertices.size()), area});
              }
          vertices.push_back(corners);
        }

    all_nodes.clear();
    faces.assign(vertices.size(), Face());
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int c = 0; c < dim; ++c)
        faces[f].corners[c] = geometry.vertices()[vertices[f][c]];
    for (const auto &[vertex, here] : at_vertex)
      {
        const std::vector<unsigned int> piece =
          find_pieces<dim>(here, vertices);
        std::map<unsigned int, Tensor<1, dim>> sums;
        for (unsigned int i = 0; i < here.size(); ++i)
          sums[piece[i]] += here[i].area;
        for (const auto &sum : sums)
          all_nodes.push_back({vertex, unit(sum.second)});
        for (unsigned int i = 0; i < here.size(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            if (vertices[here[i].face][c] == vertex)
              faces[here[i].face].normals[c] = unit(sums.at(piece[i]));
      }
    if (dim == 2)
      improve_ends(vertices);
    flat =
      std::all_of(all_nodes.begin(), all_nodes.end(), [this](const auto &n) {
        return (n.normal - all_nodes.front().normal).norm() < 1e-10;
      });
    if (flat)
      for (Node &node : all_nodes)
        node.normal = all_nodes.front().normal;
  }



  template <int dim>
  void
  WallSurface<dim>::improve_ends(
    const std::vector<std::array<unsigned int, dim>> &vertices)
  {
    std::map<unsigned int, unsigned int> n_faces, n_pieces;
    for (const auto &corners : vertices)
      for (const unsigned int v : corners)
        ++n_faces[v];
    for (const Node &node : all_nodes)
      ++n_pieces[node.vertex];
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int c = 0; c < 2; ++c)
        {
          const unsigned int end = vertices[f][c], next = vertices[f][1 - c];
          if (n_faces[end] != 1 || n_faces[next] != 2 || n_pieces[next] != 1)
            continue;
          Tensor<1, dim>       n_face;
          const Tensor<1, dim> edge = faces[f].corners[1] - faces[f].corners[0];
          n_face[0]                 = -edge[1];
          n_face[1]                 = edge[0];
          n_face /= n_face.norm();
          const Tensor<1, dim> n = faces[f].normals[1 - c];
          faces[f].normals[c]    = unit(2 * (n_face * n) * n_face - n);
          for (Node &node : all_nodes)
            if (node.vertex == end)
              node.normal = faces[f].normals[c];
        }
  }



  template <int dim>
  typename WallSurface<dim>::Place
  WallSurface<dim>::locate(const Point<dim> &x) const
  {
    Place  place{Tensor<1, dim>(), 0};
    double nearest = std::numeric_limits<double>::max();
    for (const Face &face : faces)
      {
        const auto lambda = nearest_on_face(face.corners, x);
        Point<dim> p;
        for (unsigned int v = 0; v < dim; ++v)
          p += lambda[v] * face.corners[v];
        const double distance = p.distance_square(x);
        if (distance >= nearest)
          continue;
        nearest = distance;
        Tensor<1, dim> normal;
        place.distance = 0;
        for (unsigned int v = 0; v < dim; ++v)
          {
            normal += lambda[v] * face.normals[v];
            place.distance +=
              lambda[v] * (face.normals[v] *
                           ((x - face.corners[v]) - (p - face.corners[v]) / 2));
          }
        place.normal = unit(normal);
      }
    return place;
  }



  template class WallSurface<2>;
  template class WallSurface<3>;
} // namespace isochor
