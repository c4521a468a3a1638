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
#include <set>
#include <utility>

namespace isochor
{
  namespace
  {
    /** The cosine of the angle between two faces of @p area vectors. */
    template <int dim>
    double
    cosine(const Tensor<1, dim> &first, const Tensor<1, dim> &second)
    {
      return first * second / (first.norm() * second.norm());
    }

    /** Whether faces share an edge (in 2D, a vertex). */
    template <std::size_t dim>
    bool
    share_edge(const std::array<unsigned int, dim> &first,
               const std::array<unsigned int, dim> &second)
    {
      unsigned int n = 0;
      for (const unsigned int v : first)
        n += std::count(second.begin(), second.end(), v);
      return n + 1 >= dim;
    }

    /** Whether two faces at a vertex belong to one smooth piece, as far as that
     * is a matter of their directions. */
    template <class Face>
    bool
    meet_smoothly(const Face &a, const Face &b)
    {
      return share_edge(a.vertices, b.vertices) &&
             cosine(a.area, b.area) > cosine_of_smooth_walls();
    }

    /** By vertex, the numbers of the faces there. */
    template <class Face>
    std::map<unsigned int, std::vector<unsigned int>>
    faces_at_vertices(const std::vector<Face> &faces)
    {
      std::map<unsigned int, std::vector<unsigned int>> at_vertex;
      for (unsigned int f = 0; f < faces.size(); ++f)
        for (const unsigned int v : faces[f].vertices)
          at_vertex[v].push_back(f);
      return at_vertex;
    }

    /** The groups of @p n things of which some are connected: for each, the
     * smallest number in its group. */
    template <class Connected>
    std::vector<unsigned int>
    groups_of(const unsigned int n, const Connected &connected)
    {
      std::vector<unsigned int> group(n);
      std::iota(group.begin(), group.end(), 0);
      for (bool changed = true; changed;)
        {
          changed = false;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              if (group[i] < group[j] && connected(i, j))
                {
                  group[j] = group[i];
                  changed  = true;
                }
        }
      return group;
    }

    /** Components that are rounding are zero: a wall along an axis holds what
     * a prescribed displacement does. */
    template <int dim>
    Tensor<1, dim>
    unit(Tensor<1, dim> n)
    {
      Assert(n.norm() > 0, ExcMessage("A normal has no direction."));
      n /= n.norm();
      for (unsigned int a = 0; a < dim; ++a)
        if (std::abs(n[a]) < 1e-12)
          n[a] = 0;
      return n / n.norm();
    }

    /** The area vector of a face over dim, either way. */
    Tensor<1, 2>
    area_vector(const std::array<Point<2>, 2> &corner)
    {
      return cross_product_2d(corner[1] - corner[0]) / 2;
    }

    Tensor<1, 3>
    area_vector(const std::array<Point<3>, 3> &corner)
    {
      return cross_product_3d(corner[1] - corner[0], corner[2] - corner[0]) / 6;
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
  std::vector<typename WallSurface<dim>::NamedFace>
  WallSurface<dim>::faces_of(const BackgroundGrid<dim>             &grid,
                             const std::vector<Point<dim>>         &vertices,
                             const std::vector<types::boundary_id> &ids)
  {
    std::vector<NamedFace> found;
    for (const BoundaryFace &face : grid.boundary_faces())
      {
        const auto id = std::find(ids.begin(), ids.end(), face.id);
        if (id == ids.end())
          continue;
        NamedFace named;
        named.boundary       = id - ids.begin();
        named.cell           = face.cell;
        unsigned int n       = 0;
        const auto  &of_cell = grid.geometry().vertex_indices(face.cell);
        for (unsigned int v = 0; v <= dim; ++v)
          if (v != face.opposite_vertex)
            named.vertices[n++] = of_cell[v];
        std::array<Point<dim>, dim> corners;
        for (unsigned int c = 0; c < dim; ++c)
          corners[c] = vertices[named.vertices[c]];
        named.area = area_vector(corners);
        if (named.area *
              (vertices[of_cell[face.opposite_vertex]] - corners[0]) <
            0)
          named.area *= -1;
        found.push_back(named);
      }
    return found;
  }



  template <int dim>
  std::vector<typename WallSurface<dim>::Piece>
  WallSurface<dim>::find_pieces(const std::vector<NamedFace> &named,
                                const GoesOn                 &goes_on)
  {
    std::vector<Piece> pieces;
    for (const auto &[vertex, here] : faces_at_vertices(named))
      {
        const auto group =
          groups_of(here.size(), [&, v = vertex, &f = here](auto i, auto j) {
            const NamedFace &a = named[f[i]], &b = named[f[j]];
            return meet_smoothly(a, b) && (a.boundary == b.boundary ||
                                           goes_on(a.boundary, b.boundary, v));
          });
        std::map<unsigned int, Piece> of_group;
        for (unsigned int i = 0; i < here.size(); ++i)
          {
            Piece &piece = of_group[group[i]];
            piece.vertex = vertex;
            piece.normal += named[here[i]].area;
            piece.boundary = std::min(piece.boundary, named[here[i]].boundary);
            piece.faces.push_back(here[i]);
          }
        for (auto &entry : of_group)
          {
            entry.second.normal = unit(entry.second.normal);
            pieces.push_back(entry.second);
          }
      }
    return pieces;
  }



  template <int dim>
  void
  WallSurface<dim>::leave_out_others(std::vector<NamedFace> &named,
                                     const unsigned int      n_boundaries,
                                     const unsigned int      own,
                                     const GoesOn           &goes_on)
  {
    AssertIndexRange(own, n_boundaries);
    std::set<std::pair<unsigned int, unsigned int>> joined;
    for (const Piece &piece : find_pieces(named, goes_on))
      for (const unsigned int f : piece.faces)
        {
          joined.emplace(piece.boundary, named[f].boundary);
          joined.emplace(named[f].boundary, piece.boundary);
        }
    const auto surface = groups_of(n_boundaries, [&](auto i, auto j) {
      return joined.count({i, j}) != 0;
    });
    named.erase(std::remove_if(named.begin(),
                               named.end(),
                               [&](const NamedFace &face) {
                                 return surface[face.boundary] != surface[own];
                               }),
                named.end());
  }



  template <int dim>
  void
  WallSurface<dim>::set_normals(const std::vector<NamedFace> &named,
                                std::vector<Piece>           &pieces)
  {
    AssertDimension(named.size(), all_faces.size());
    for (unsigned int f = 0; f < all_faces.size(); ++f)
      all_faces[f].normal = unit(named[f].area);
    for (const Piece &piece : pieces)
      for (const unsigned int f : piece.faces)
        for (unsigned int c = 0; c < dim; ++c)
          if (named[f].vertices[c] == piece.vertex)
            all_faces[f].normals[c] = piece.normal;
    if (dim == 2)
      improve_ends(named, pieces);
  }



  template <int dim>
  void
  WallSurface<dim>::move_corners(const Shift            &shift,
                                 std::vector<NamedFace> &named,
                                 std::vector<Piece>     &pieces)
  {
    AssertDimension(named.size(), all_faces.size());
    for (unsigned int f = 0; f < all_faces.size(); ++f)
      {
        Face &face = all_faces[f];
        for (unsigned int c = 0; c < dim; ++c)
          face.corners[c] += shift(face.vertices[c]) * face.normals[c];
        named[f].area = area_vector(face.corners);
        if (named[f].area * face.normal < 0)
          named[f].area *= -1;
      }
    for (Piece &piece : pieces)
      {
        piece.normal = 0;
        for (const unsigned int f : piece.faces)
          piece.normal += named[f].area;
        piece.normal = unit(piece.normal);
      }
    set_normals(named, pieces);
  }



  template <int dim>
  void
  WallSurface<dim>::initialize(const BackgroundGrid<dim>             &grid,
                               const std::vector<Point<dim>>         &vertices,
                               const std::vector<types::boundary_id> &ids,
                               const unsigned int                     own,
                               const GoesOn                          &goes_on,
                               const Shift                           &shift)
  {
    std::vector<NamedFace> named = faces_of(grid, vertices, ids);
    leave_out_others(named, ids.size(), own, goes_on);
    std::vector<Piece> pieces = find_pieces(named, goes_on);

    all_faces.assign(named.size(), Face());
    for (unsigned int f = 0; f < named.size(); ++f)
      {
        Face &face    = all_faces[f];
        face.boundary = named[f].boundary;
        face.cell     = named[f].cell;
        face.vertices = named[f].vertices;
        for (unsigned int c = 0; c < dim; ++c)
          face.corners[c] = vertices[face.vertices[c]];
      }
    set_normals(named, pieces);
    if (shift)
      move_corners(shift, named, pieces);

    const auto same_as_first = [&](const Piece &piece) {
      return (piece.normal - pieces.front().normal).norm() < 1e-10;
    };
    flat = std::all_of(pieces.begin(), pieces.end(), same_as_first);
    all_nodes.clear();
    for (const Piece &piece : pieces)
      if (piece.boundary == own)
        all_nodes.push_back(
          {piece.vertex, flat ? pieces.front().normal : piece.normal});
  }



  template <int dim>
  void
  WallSurface<dim>::improve_ends(const std::vector<NamedFace> &named,
                                 std::vector<Piece>           &pieces)
  {
    std::map<unsigned int, unsigned int> n_faces, n_pieces;
    for (const NamedFace &face : named)
      for (const unsigned int v : face.vertices)
        ++n_faces[v];
    for (const Piece &piece : pieces)
      ++n_pieces[piece.vertex];
    for (unsigned int f = 0; f < all_faces.size(); ++f)
      for (unsigned int c = 0; c < 2; ++c)
        {
          const unsigned int end  = named[f].vertices[c],
                             next = named[f].vertices[1 - c];
          if (n_faces[end] != 1 || n_faces[next] != 2 || n_pieces[next] != 1)
            continue;
          Tensor<1, dim>       n_face;
          const Tensor<1, dim> edge =
            all_faces[f].corners[1] - all_faces[f].corners[0];
          n_face[0] = -edge[1];
          n_face[1] = edge[0];
          n_face /= n_face.norm();
          const Tensor<1, dim> n  = all_faces[f].normals[1 - c];
          all_faces[f].normals[c] = unit(2 * (n_face * n) * n_face - n);
          for (Piece &piece : pieces)
            if (piece.vertex == end)
              piece.normal = all_faces[f].normals[c];
        }
  }



  template <int dim>
  typename WallSurface<dim>::Place
  WallSurface<dim>::locate(const Point<dim>     &x,
                           const Tensor<1, dim> &direction) const
  {
    Assert(!all_faces.empty(), ExcMessage("The wall has no faces."));
    constexpr double near_direction = 0.7;
    const bool       has_direction  = direction.norm_square() > 0;
    Place            place{Tensor<1, dim>(), 0};
    double           nearest = std::numeric_limits<double>::max();
    for (const Face &face : all_faces)
      {
        if (has_direction && face.normal * direction < near_direction)
          continue;
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
    if (has_direction && nearest == std::numeric_limits<double>::max())
      return locate(x); // none is of its side
    return place;
  }



  template class WallSurface<2>;
  template class WallSurface<3>;
} // namespace isochor
