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
    AssertIndexRange(tree, coarse.cells.size());
    AssertIndexRange(node, n_nodes);
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
    AssertIndexRange(tree, views.size());
    Assert(std::all_of(place.begin(),
                       place.end(),
                       [](const std::uint32_t x) {
                         return x <= Leaf<dim>::resolution;
                       }),
           ExcInternalError());
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
    AssertIndexRange(key.entity, entities.size());
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
  const LeafTemplate<dim> &
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
             templates.emplace(code, split_leaf<dim>(present, frames))
               .first->second;
  }



  template <int dim>
  std::array<std::uint32_t, dim>
  ConformingClosure<dim>::place(const Leaf<dim> &leaf, const unsigned int node)
  {
    AssertIndexRange(node, n_nodes);
    std::array<std::uint32_t, dim> x = leaf.corner;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] += coordinate(node, d) * (leaf.size() / 2);
    return x;
  }



  template <int dim>
  std::vector<std::array<unsigned int, (1u << dim)>>
  ConformingClosure<dim>::number_corners(const std::vector<Leaf<dim>> &leaves,
                                         VertexNumbers                &known,
                                         SimplexMesh<dim> &mesh) const
  {
    std::vector<std::array<unsigned int, (1u << dim)>> corners(leaves.size());
    known.reserve(leaves.size() * 5 / 4 + 16);
    for (unsigned int i = 0; i < leaves.size(); ++i)
      for (unsigned int c = 0; c < (1u << dim); ++c)
        {
          const Key k =
            key(leaves[i].tree, place(leaves[i], corner_node<dim>(c)));
          const auto found = known.emplace(k, mesh.vertices.size());
          corners[i][c]    = found.first->second;
          if (found.second)
            mesh.vertices.push_back(position(k));
        }
    return corners;
  }



  template <int dim>
  std::uint32_t
  ConformingClosure<dim>::find_middles(const Leaf<dim>     &leaf,
                                       const VertexNumbers &known,
                                       NodeVertices        &vertex) const
  {
    std::uint32_t present = corner_bits<dim>();
    // middles of edges first: of a face there is none without those
    for (unsigned int n_axes = 1; n_axes < dim; ++n_axes)
      for (unsigned int node = 0; node < n_nodes; ++node)
        if (n_middle_axes<dim>(node) == n_axes &&
            (n_axes == 1 || present != corner_bits<dim>()))
          {
            const auto found = known.find(key(leaf.tree, place(leaf, node)));
            if (found == known.end())
              continue;
            vertex[node] = found->second;
            present |= 1u << node;
          }
    return present;
  }



  template <int dim>
  void
  ConformingClosure<dim>::add_simplices(const Leaf<dim>         &leaf,
                                        const LeafTemplate<dim> &split,
                                        NodeVertices            &vertex,
                                        SimplexMesh<dim>        &mesh) const
  {
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
  }



  template <int dim>
  void
  ConformingClosure<dim>::add_boundary(const Leaf<dim>         &leaf,
                                       const LeafTemplate<dim> &split,
                                       const NodeVertices      &vertex,
                                       SimplexMesh<dim>        &mesh) const
  {
    AssertIndexRange(leaf.tree, coarse.boundary_ids.size());
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



  template <int dim>
  SimplexMesh<dim>
  ConformingClosure<dim>::close(const std::vector<Leaf<dim>> &leaves)
  {
    Assert(!leaves.empty(), ExcMessage("There is no grid."));
    SimplexMesh<dim> mesh;
    VertexNumbers    known;
    const auto       corners = number_corners(leaves, known, mesh);
    unsigned int     finest  = 0;
    for (const Leaf<dim> &leaf : leaves)
      finest = std::max(finest, leaf.level);

    mesh.first_cell.push_back(0);
    mesh.cells.reserve(leaves.size() * (dim == 2 ? 2 : 6));
    for (unsigned int i = 0; i < leaves.size(); ++i)
      {
        NodeVertices vertex{};
        for (unsigned int c = 0; c < (1u << dim); ++c)
          vertex[corner_node<dim>(c)] = corners[i][c];
        const std::uint32_t      present = leaves[i].level < finest ?
                                             find_middles(leaves[i], known, vertex) :
                                             corner_bits<dim>();
        const LeafTemplate<dim> &split   = leaf_template(leaves[i], present);
        mesh.n_hanging_leaves += (present != corner_bits<dim>());
        add_simplices(leaves[i], split, vertex, mesh);
        add_boundary(leaves[i], split, vertex, mesh);
      }
    AssertDimension(mesh.first_cell.size(), leaves.size() + 1);
    return mesh;
  }



  template struct SimplexMesh<2>;
  template struct SimplexMesh<3>;
  template class ConformingClosure<2>;
  template class ConformingClosure<3>;
} // namespace isochor
