/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/exceptions.h>
#include <deal.II/base/tensor.h>

#include <isochor/grid/conforming_closure.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace isochor
{
  namespace
  {
    constexpr std::array<unsigned int, 4> power_of_three = {{1, 3, 9, 27}};

    /** Coordinate @p d of a local node: 0, 1 or 2. */
    constexpr unsigned int
    coordinate(const unsigned int node, const unsigned int d)
    {
      return (node / power_of_three[d]) % 3;
    }

    /** The local node of corner @p i. */
    template <int dim>
    unsigned int
    corner_node(const unsigned int i)
    {
      unsigned int node = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (i & (1u << d))
          node += 2 * power_of_three[d];
      return node;
    }

    template <int dim>
    std::uint32_t
    corner_bits()
    {
      std::uint32_t bits = 0;
      for (unsigned int i = 0; i < (1u << dim); ++i)
        bits |= 1u << corner_node<dim>(i);
      return bits;
    }

    template <int dim>
    unsigned int
    n_middle_axes(const unsigned int node)
    {
      unsigned int n = 0;
      for (unsigned int d = 0; d < dim; ++d)
        n += (coordinate(node, d) == 1);
      return n;
    }

    /** The nodes of face @p f of a hexahedron, as the rule of its splitting
     * numbers them: the corners 00, 10, 11, 01, the middles of the edges
     * v = 0, u = 1, v = 1, u = 0, and the centre. @p frame is where u and v
     * point, see frame_of_face(). */
    std::array<unsigned char, 9>
    face_nodes(const unsigned int f, const unsigned int frame)
    {
      constexpr unsigned int u[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1};
      constexpr unsigned int v[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
      const unsigned int n = f / 2, a = (n == 0 ? 1 : 0), b = (n == 2 ? 1 : 2);
      const bool         swap = frame & 4;
      std::array<unsigned char, 9> nodes;
      for (unsigned int k = 0; k < 9; ++k)
        {
          unsigned int i = swap ? v[k] : u[k], j = swap ? u[k] : v[k];
          i        = (frame & 1) ? 2 - i : i;
          j        = (frame & 2) ? 2 - j : j;
          nodes[k] = 2 * (f % 2) * power_of_three[n] + i * power_of_three[a] +
                     j * power_of_three[b];
        }
      return nodes;
    }

    using Triangles = std::vector<std::array<unsigned char, 3>>;

    /**
     * The triangles of a face by the numbers of face_nodes(), for each set of
     * middles of edges that are vertices (bits 0 to 3: v = 0, u = 1, v = 1,
     * u = 0). Where there is a choice it is the one whose worst triangle has
     * the best mean ratio, of equals the first.
     */
    const Triangles &
    face_triangles(const unsigned int middles, const bool has_centre)
    {
      const auto parse = [](const std::string &text) {
        // corners 0 to 3, then the middles of the four edges and the centre
        const std::string names = "0123brtlc";
        Triangles         triangles;
        for (std::size_t i = 0; i < text.size(); i += 4)
          {
            triangles.emplace_back();
            for (unsigned int v = 0; v < 3; ++v)
              triangles.back()[v] = names.find(text[i + v]);
          }
        return triangles;
      };
      static const std::array<Triangles, 16> tables = {
        {parse("012 023"),
         parse("b12 b23 b30"),
         parse("r23 r30 r01"),
         parse("0b3 b1r br3 r23"),
         parse("t30 t01 t12"),
         parse("0b3 b1t 12t bt3"),
         parse("01r 0rt r2t 0t3"),
         parse("0b3 b1r brt r2t bt3"),
         parse("l01 l12 l23"),
         parse("0bl b12 b2l 23l"),
         parse("01l 1rl r2l 23l"),
         parse("0bl b1r brl r2l 23l"),
         parse("01l 12t 1tl t3l"),
         parse("0bl b1t 12t btl t3l"),
         parse("01l 1rl r2t rtl t3l"),
         parse("0bl b1r brl r2t rtl t3l")}};
      static const Triangles refined = parse("0bc 0cl b1r brc cr2 c2t lct lt3");
      return has_centre ? refined : tables[middles];
    }

    template <int dim>
    Point<dim>
    lattice_point(const unsigned int node)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = coordinate(node, d);
      return x;
    }

    template <int dim>
    double
    signed_volume(const std::array<unsigned char, dim + 1> &simplex)
    {
      Tensor<2, dim> edges;
      for (unsigned int i = 0; i < dim; ++i)
        edges[i] =
          lattice_point<dim>(simplex[i + 1]) - lattice_point<dim>(simplex[0]);
      return determinant(edges);
    }

    /** A simplex of local nodes, positively oriented. */
    template <int dim>
    std::array<unsigned char, dim + 1>
    oriented(std::array<unsigned char, dim + 1> simplex)
    {
      if (signed_volume<dim>(simplex) < 0)
        std::swap(simplex[dim - 1], simplex[dim]);
      return simplex;
    }

    std::array<unsigned char, 3>
    simplex_2d(const unsigned char a,
               const unsigned char b,
               const unsigned char c)
    {
      return {{a, b, c}};
    }

    /** Mean ratio of a tetrahedron of local nodes, to the power 3/2 and but
     * for a factor: enough to compare. */
    double
    quality(const std::array<unsigned char, 4> &simplex)
    {
      double sum = 0;
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < i; ++j)
          sum += lattice_point<3>(simplex[i])
                   .distance_square(lattice_point<3>(simplex[j]));
      return signed_volume<3>(simplex) / std::pow(sum, 1.5);
    }
  } // namespace



  template <int dim>
  ConformingClosure<dim>::ConformingClosure(const CoarseGrid<dim> &coarse)
    : coarse(coarse)
  {
    find_entities();
  }



  template <int dim>
  typename ConformingClosure<dim>::View
  ConformingClosure<dim>::view_of(const unsigned int tree,
                                  const unsigned int node) const
  {
    // the corner of the entity that is the lowest of the tree, and its axes
    unsigned int              lowest = 0;
    std::vector<unsigned int> axes;
    for (unsigned int d = 0; d < dim; ++d)
      if (coordinate(node, d) == 1)
        axes.push_back(d);
      else if (coordinate(node, d) == 2)
        lowest |= 1u << d;
    const auto &cell   = coarse.cells[tree];
    const auto  vertex = [&](const unsigned int corner) {
      unsigned int i = lowest;
      for (unsigned int k = 0; k < axes.size(); ++k)
        if (corner & (1u << k))
          i |= 1u << axes[k];
      return cell[i];
    };

    View view{};
    if (axes.size() < dim)
      {
        // it begins at its smallest vertex
        unsigned int first = 0;
        for (unsigned int i = 1; i < (1u << axes.size()); ++i)
          if (vertex(i) < vertex(first))
            first = i;
        // the axis towards the smaller neighbour comes first
        const bool swap =
          axes.size() == 2 && vertex(first ^ 2) < vertex(first ^ 1);
        for (unsigned int k = 0; k < axes.size(); ++k)
          {
            const unsigned int from = swap ? 1 - k : k;
            view.axes[k]            = axes[from];
            view.is_flipped[k]      = (first >> from) & 1u;
          }
      }
    else
      for (unsigned int k = 0; k < dim; ++k)
        view.axes[k] = k;
    return view;
  }



  template <int dim>
  void
  ConformingClosure<dim>::find_entities()
  {
    // by the vertices at its corners; a cell by itself
    std::map<std::array<unsigned int, (1u << dim)>, unsigned int> known;
    views.resize(coarse.cells.size());
    for (unsigned int tree = 0; tree < coarse.cells.size(); ++tree)
      for (unsigned int node = 0; node < n_nodes; ++node)
        {
          View  &view = views[tree][node];
          Entity entity{n_middle_axes<dim>(node), {}};
          view = view_of(tree, node);
          entity.corners.fill(numbers::invalid_unsigned_int);
          for (unsigned int c = 0; c < (1u << entity.n_axes); ++c)
            {
              unsigned int corner = 0;
              for (unsigned int d = 0; d < dim; ++d)
                if (coordinate(node, d) == 2)
                  corner |= 1u << d;
              for (unsigned int k = 0; k < entity.n_axes; ++k)
                if (((c >> k) & 1u) != view.is_flipped[k])
                  corner |= 1u << view.axes[k];
              entity.corners[c] = coarse.cells[tree][corner];
            }
          if (entity.n_axes == dim)
            {
              view.entity = entities.size();
              entities.push_back(entity);
              continue;
            }
          const auto found = known.emplace(entity.corners, entities.size());
          view.entity      = found.first->second;
          if (found.second)
            entities.push_back(entity);
        }
  }



  template <int dim>
  typename ConformingClosure<dim>::Key
  ConformingClosure<dim>::key(const unsigned int                    tree,
                              const std::array<std::uint32_t, dim> &place) const
  {
    constexpr std::uint32_t end  = Leaf<dim>::resolution;
    unsigned int            node = 0;
    for (unsigned int d = 0; d < dim; ++d)
      node +=
        power_of_three[d] * (place[d] == 0 ? 0 : (place[d] == end ? 2 : 1));
    const View        &view = views[tree][node];
    Key                key{view.entity, 0};
    const unsigned int n = entities[view.entity].n_axes;
    for (unsigned int k = 0; k < n; ++k)
      {
        const std::uint32_t x = place[view.axes[k]];
        key.place |= std::uint64_t(view.is_flipped[k] ? end - x : x)
                     << (21 * k);
      }
    return key;
  }



  template <int dim>
  Point<dim>
  ConformingClosure<dim>::position(const Key &key) const
  {
    // a + t (b - a), axis by axis: what is equal at all corners stays so
    const Entity                       &entity = entities[key.entity];
    std::array<Point<dim>, (1u << dim)> x;
    for (unsigned int c = 0; c < (1u << entity.n_axes); ++c)
      x[c] = coarse.vertices[entity.corners[c]];
    for (unsigned int k = entity.n_axes; k-- > 0;)
      {
        const double t =
          static_cast<double>((key.place >> (21 * k)) & 0x1fffff) /
          Leaf<dim>::resolution;
        for (unsigned int c = 0; c < (1u << k); ++c)
          x[c] += t * (x[c + (1u << k)] - x[c]);
      }
    return x[0];
  }



  template <int dim>
  Point<dim>
  ConformingClosure<dim>::position(
    const unsigned int                    tree,
    const std::array<std::uint32_t, dim> &place) const
  {
    return position(key(tree, place));
  }



  template <int dim>
  typename ConformingClosure<dim>::Template
  ConformingClosure<dim>::make_template(
    const std::uint32_t                      present,
    const std::array<unsigned int, 2 * dim> &frames) const
  {
    const auto is_present = [present](const unsigned int node) {
      return ((present >> node) & 1u) != 0;
    };
    Template result;
    if constexpr (dim == 2)
      {
        // the nodes of the sides, and for plain leaves the diagonal
        constexpr unsigned char sides[4][3] = {{6, 3, 0},
                                               {2, 5, 8},
                                               {0, 1, 2},
                                               {8, 7, 6}};
        for (unsigned int f = 0; f < 4; ++f)
          if (is_present(sides[f][1]))
            {
              result.sides[f].push_back({{sides[f][0], sides[f][1]}});
              result.sides[f].push_back({{sides[f][1], sides[f][2]}});
            }
          else
            result.sides[f].push_back({{sides[f][0], sides[f][2]}});
        if (present == corner_bits<2>())
          {
            const bool up = (frames[0] == 0); // "/"
            result.simplices.push_back(up ? simplex_2d(0, 2, 8) :
                                            simplex_2d(0, 2, 6));
            result.simplices.push_back(up ? simplex_2d(0, 8, 6) :
                                            simplex_2d(2, 8, 6));
          }
        else
          for (const auto &side : result.sides)
            for (const auto &edge : side)
              result.simplices.push_back(
                oriented<2>({{centre, edge[0], edge[1]}}));
      }
    else
      {
        for (unsigned int f = 0; f < 6; ++f)
          {
            const auto   nodes   = face_nodes(f, frames[f]);
            unsigned int middles = 0;
            for (unsigned int k = 0; k < 4; ++k)
              middles |= static_cast<unsigned int>(is_present(nodes[4 + k]))
                         << k;
            for (const auto &triangle :
                 face_triangles(middles, is_present(nodes[8])))
              result.sides[f].push_back(
                {{nodes[triangle[0]], nodes[triangle[1]], nodes[triangle[2]]}});
          }
        const auto cone = [&result](const unsigned char apex) {
          std::vector<std::array<unsigned char, 4>> simplices;
          for (const auto &side : result.sides)
            for (const auto &t : side)
              if (std::find(t.begin(), t.end(), apex) == t.end())
                simplices.push_back(oriented<3>({{apex, t[0], t[1], t[2]}}));
          return simplices;
        };
        double best = 0;
        for (unsigned int i = 0; present == corner_bits<3>() && i < 8; ++i)
          {
            const auto simplices = cone(corner_node<3>(i));
            // with more, triangles of its own faces don't contain it
            if (simplices.size() != 6)
              continue;
            double worst = std::numeric_limits<double>::max();
            for (const auto &simplex : simplices)
              worst = std::min(worst, quality(simplex));
            if (worst > best * (1 + 1e-12))
              {
                best             = worst;
                result.simplices = simplices;
              }
          }
        if (result.simplices.empty())
          result.simplices = cone(centre);
      }
    return result;
  }



  template <int dim>
  const typename ConformingClosure<dim>::Template &
  ConformingClosure<dim>::leaf_template(const Leaf<dim>    &leaf,
                                        const std::uint32_t present)
  {
    std::array<unsigned int, 2 * dim> frames{};
    std::uint64_t                     code = 0;
    if constexpr (dim == 2)
      {
        // the direction of diagonals alternates
        frames[0] =
          (leaf.corner[0] / leaf.size() + leaf.corner[1] / leaf.size()) % 2;
        code = frames[0];
      }
    else
      for (unsigned int f = 0; f < 6; ++f)
        {
          const unsigned int n = f / 2;
          if ((f % 2 == 0 && leaf.corner[n] == 0) ||
              (f % 2 == 1 && leaf.corner[n] + leaf.size() == leaf.resolution))
            {
              const View &view =
                views[leaf.tree]
                     [centre + (f % 2 == 0 ? -1 : 1) *
                                 static_cast<int>(power_of_three[n])];
              const bool swap = view.axes[0] > view.axes[1];
              frames[f] = static_cast<unsigned int>(view.is_flipped[swap]) |
                          static_cast<unsigned int>(view.is_flipped[!swap])
                            << 1 |
                          static_cast<unsigned int>(swap) << 2;
            }
          code = code << 3 | frames[f];
        }
    code             = code << n_nodes | present;
    const auto found = templates.find(code);
    return found != templates.end() ?
             found->second :
             templates.emplace(code, make_template(present, frames))
               .first->second;
  }



  template <int dim>
  SimplexMesh<dim>
  ConformingClosure<dim>::close(const std::vector<Leaf<dim>> &leaves)
  {
    SimplexMesh<dim>                               mesh;
    std::unordered_map<Key, unsigned int, KeyHash> numbers;
    numbers.reserve(leaves.size() * 5 / 4 + 16);
    constexpr unsigned int                           n_corners = 1u << dim;
    std::vector<std::array<unsigned int, n_corners>> corners(leaves.size());
    const auto place = [](const Leaf<dim> &leaf, const unsigned int node) {
      std::array<std::uint32_t, dim> x = leaf.corner;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += coordinate(node, d) * (leaf.size() / 2);
      return x;
    };

    unsigned int finest = 0;
    for (unsigned int i = 0; i < leaves.size(); ++i)
      {
        finest = std::max(finest, leaves[i].level);
        for (unsigned int c = 0; c < n_corners; ++c)
          {
            const Key k =
              key(leaves[i].tree, place(leaves[i], corner_node<dim>(c)));
            const auto found = numbers.emplace(k, mesh.vertices.size());
            corners[i][c]    = found.first->second;
            if (found.second)
              mesh.vertices.push_back(position(k));
          }
      }

    mesh.first_cell.push_back(0);
    mesh.cells.reserve(leaves.size() * (dim == 2 ? 2 : 6));
    for (unsigned int i = 0; i < leaves.size(); ++i)
      {
        const Leaf<dim>                  &leaf    = leaves[i];
        std::uint32_t                     present = corner_bits<dim>();
        std::array<unsigned int, n_nodes> vertex{};
        for (unsigned int c = 0; c < n_corners; ++c)
          vertex[corner_node<dim>(c)] = corners[i][c];
        // middles of edges first: of a face there is none without those
        for (unsigned int n_axes = 1; n_axes < dim && leaf.level < finest;
             ++n_axes)
          for (unsigned int node = 0; node < n_nodes; ++node)
            if (n_middle_axes<dim>(node) == n_axes &&
                (n_axes == 1 || present != corner_bits<dim>()))
              {
                const auto found =
                  numbers.find(key(leaf.tree, place(leaf, node)));
                if (found == numbers.end())
                  continue;
                vertex[node] = found->second;
                present |= 1u << node;
              }
        const Template &split = leaf_template(leaf, present);
        mesh.n_hanging_leaves += (present != corner_bits<dim>());

        bool has_centre = false;
        for (const auto &simplex : split.simplices)
          has_centre =
            has_centre ||
            std::find(simplex.begin(), simplex.end(), centre) != simplex.end();
        if (has_centre)
          {
            vertex[centre] = mesh.vertices.size();
            mesh.vertices.push_back(position(leaf.tree, place(leaf, centre)));
          }
        for (const auto &simplex : split.simplices)
          {
            mesh.cells.emplace_back();
            for (unsigned int v = 0; v <= dim; ++v)
              mesh.cells.back()[v] = vertex[simplex[v]];
          }
        mesh.first_cell.push_back(mesh.cells.size());

        for (unsigned int f = 0; f < 2 * dim; ++f)
          {
            const types::boundary_id id = coarse.boundary_ids[leaf.tree][f];
            const std::uint32_t      x  = leaf.corner[f / 2];
            if (id == numbers::internal_face_boundary_id ||
                (f % 2 == 0 ? x != 0 : x + leaf.size() != leaf.resolution))
              continue;
            for (const auto &side : split.sides[f])
              {
                mesh.boundary.push_back({{}, id});
                for (unsigned int v = 0; v < dim; ++v)
                  mesh.boundary.back().vertices[v] = vertex[side[v]];
              }
          }
      }
    return mesh;
  }



  template struct SimplexMesh<2>;
  template struct SimplexMesh<3>;
  template class ConformingClosure<2>;
  template class ConformingClosure<3>;
} // namespace isochor
