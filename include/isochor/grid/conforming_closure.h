/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_conforming_closure_h
#define isochor_conforming_closure_h

#include <isochor/grid/coarse_grid.h>
#include <isochor/grid/leaf_template.h>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** A conforming grid of triangles or tetrahedra, positively oriented. */
  template <int dim>
  struct SimplexMesh
  {
    std::vector<Point<dim>>                        vertices;
    std::vector<std::array<unsigned int, dim + 1>> cells;
    /** The simplices of leaf i are first_cell[i] ... first_cell[i+1] - 1. */
    std::vector<unsigned int> first_cell;

    struct BoundaryFace
    {
      std::array<unsigned int, dim> vertices;
      types::boundary_id            id;
    };
    std::vector<BoundaryFace> boundary;
    /** Leaves with a vertex in the middle of an edge or face. */
    unsigned int n_hanging_leaves = 0;
  };

  /**
   * Splits the leaves of a balanced forest into simplices that fit together,
   * across hanging nodes and between trees whose axes point anywhere.
   *
   * A vertex is known by its *key*: the vertex, edge, face or cell of the
   * coarse grid that it lies on, and integer coordinates in a frame which
   * depends on numbers of coarse vertices only. An edge runs from its smaller
   * vertex; a face begins at its smallest vertex, its first axis points to the
   * smaller of the two neighbours. So every tree finds the same key, and as
   * places follow from keys, the same place bit by bit.
   *
   * The middle of a leaf's edge or face is a vertex if and only if some leaf
   * has a corner there. Each face of a leaf is split by a rule that depends on
   * the vertices on it only, seen in the frame of the coarse face on a tree's
   * boundary, of the tree inside; so both sides agree. A leaf without vertices
   * in the middle is split into two triangles, whose diagonals alternate, or
   * into six tetrahedra with a common corner if there is one that suits (Kuhn's
   * inside of trees); any other into those between its centre and its sides.
   */
  template <int dim>
  class ConformingClosure
  {
  public:
    explicit ConformingClosure(const CoarseGrid<dim> &coarse);

    SimplexMesh<dim>
    close(const std::vector<Leaf<dim>> &leaves);

    /** Where the place (in units of Leaf::resolution) of a tree is. */
    Point<dim>
    position(const unsigned int                    tree,
             const std::array<std::uint32_t, dim> &place) const;

  private:
    /** Nodes of a leaf, see LeafTemplate. */
    static constexpr unsigned int n_nodes = LeafTemplate<dim>::n_nodes;
    static constexpr unsigned int centre  = n_nodes / 2;

    /** A vertex, edge, face or cell of the coarse grid. */
    struct Entity
    {
      unsigned int n_axes;
      /** Coarse vertices at its 2^n_axes corners, in its own frame. */
      std::array<unsigned int, (1u << dim)> corners;
    };

    /** How a tree sees one of the entities of its boundary, or itself. */
    struct View
    {
      unsigned int entity;
      /** Axis k of the entity is this one of the tree, and whether it runs the
       * other way. */
      std::array<unsigned int, dim> axes;
      std::array<bool, dim>         is_flipped;
    };

    struct Key
    {
      unsigned int  entity;
      std::uint64_t place; ///< coordinates of 21 bits each

      bool
      operator==(const Key &other) const
      {
        return entity == other.entity && place == other.place;
      }
    };
    struct KeyHash
    {
      std::size_t
      operator()(const Key &key) const
      {
        std::uint64_t h = (key.place ^ (std::uint64_t(key.entity) << 40) ^
                           key.entity * 0x9e3779b97f4a7c15ull);
        h ^= h >> 32;
        h *= 0xd6e8feb86659fd93ull;
        h ^= h >> 32;
        return h;
      }
    };

    void
    find_entities();
    View
    view_of(const unsigned int tree, const unsigned int node) const;
    Key
    key(const unsigned int                    tree,
        const std::array<std::uint32_t, dim> &place) const;
    Point<dim>
    position(const Key &key) const;

    using VertexNumbers = std::unordered_map<Key, unsigned int, KeyHash>;
    /** The vertices at the nodes of a leaf, as far as there are any. */
    using NodeVertices = std::array<unsigned int, n_nodes>;

    /** Where a node of a leaf is, in units of Leaf::resolution. */
    static std::array<std::uint32_t, dim>
    place(const Leaf<dim> &leaf, const unsigned int node);
    /** Add the corners of all leaves to the vertices. Returns their numbers by
     * leaf, and by key as @p known. */
    std::vector<std::array<unsigned int, (1u << dim)>>
    number_corners(const std::vector<Leaf<dim>> &leaves,
                   VertexNumbers                &known,
                   SimplexMesh<dim>             &mesh) const;
    /** The nodes of the leaf that are vertices, as a bit set; @p vertex gets
     * those in the middles of edges and faces. */
    std::uint32_t
    find_middles(const Leaf<dim>     &leaf,
                 const VertexNumbers &known,
                 NodeVertices        &vertex) const;
    /** Add the simplices of a leaf, and its centre if they need it. */
    void
    add_simplices(const Leaf<dim>         &leaf,
                  const LeafTemplate<dim> &split,
                  NodeVertices            &vertex,
                  SimplexMesh<dim>        &mesh) const;
    /** Add the sides of a leaf that are on the boundary of the grid. */
    void
    add_boundary(const Leaf<dim>         &leaf,
                 const LeafTemplate<dim> &split,
                 const NodeVertices      &vertex,
                 SimplexMesh<dim>        &mesh) const;

    /** Of the leaf with vertices at the nodes in the bit set @p present. */
    const LeafTemplate<dim> &
    leaf_template(const Leaf<dim> &leaf, const std::uint32_t present);

    const CoarseGrid<dim> coarse;
    std::vector<Entity>   entities;
    /** By tree and node of the tree taken for a leaf. */
    std::vector<std::array<View, n_nodes>>               views;
    std::unordered_map<std::uint64_t, LeafTemplate<dim>> templates;
  };
} // namespace isochor

#endif
