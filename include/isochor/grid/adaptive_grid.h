/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_adaptive_grid_h
#define isochor_adaptive_grid_h

#include <deal.II/grid/tria.h>

#include <isochor/grid/adaptive_forest.h>
#include <isochor/grid/conforming_closure.h>

#include <functional>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The coarse grid of a lattice of cells, n[d] in direction d, @p place being
   * where the points of the unit cube go. The boundary ids are the numbers of
   * the faces. */
  template <int dim>
  CoarseGrid<dim>
  coarse_lattice(const std::vector<unsigned int>                     &n,
                 const std::function<Point<dim>(const Point<dim> &)> &place);

  /** The coarse grid of a mesh of quadrilaterals or hexahedra. */
  template <int dim>
  CoarseGrid<dim>
  coarse_grid(const Triangulation<dim> &mesh);

  /**
   * A forest and its leaves now, as the background grid uses them: simplices
   * know their leaf, leaves their rank. The same on all ranks.
   */
  template <int dim>
  class AdaptiveGrid
  {
  public:
    /** Begins with the coarse cells as leaves, all of them of rank 0. */
    explicit AdaptiveGrid(const CoarseGrid<dim> &coarse);

    /** See AdaptiveForest::refine(). Changes nothing here. */
    std::vector<Leaf<dim>>
    refine(const typename AdaptiveForest<dim>::Criterion &is_split) const;

    /** Take @p new_leaves and their @p owners, and return the simplices they
     * are split into. */
    SimplexMesh<dim>
    set_leaves(const std::vector<Leaf<dim>>    &new_leaves,
               const std::vector<unsigned int> &owners);

    const std::vector<Leaf<dim>> &
    leaves() const
    {
      return current;
    }

    /** How many coarse cells there are. */
    unsigned int
    n_trees() const
    {
      return materials.size();
    }

    unsigned int
    leaf_of_cell(const unsigned int cell) const
    {
      return leaf_of_cells[cell];
    }

    unsigned int
    leaf_owner(const unsigned int leaf) const
    {
      return owners[leaf];
    }

    /** Simplices of a leaf are first_cell(leaf) ... first_cell(leaf + 1) - 1.
     */
    unsigned int
    first_cell(const unsigned int leaf) const
    {
      return first_cells[leaf];
    }

    /** The dim-th root of the mean volume of leaves of this @p level in this
     * tree: the side of a square or cube (m). */
    double
    size(const unsigned int tree, const double level = 0) const;

    /** See ConformingClosure::position(). */
    Point<dim>
    position(const unsigned int                    tree,
             const std::array<std::uint32_t, dim> &place) const
    {
      return closure.position(tree, place);
    }

    types::material_id
    material_of_cell(const unsigned int cell) const
    {
      return materials[current[leaf_of_cells[cell]].tree];
    }

    /** Leaves with hanging nodes, which are split around their centre. */
    unsigned int
    n_hanging_leaves() const
    {
      return n_hanging;
    }

    /** Leaves and their owners, for checkpoints. */
    std::string
    save_state() const;
    static void
    load_state(const std::string         &state,
               std::vector<Leaf<dim>>    &leaves,
               std::vector<unsigned int> &owners);

  private:
    AdaptiveForest<dim>             forest;
    ConformingClosure<dim>          closure;
    std::vector<types::material_id> materials;
    std::vector<double>             tree_sizes;
    std::vector<Leaf<dim>>          current;
    std::vector<unsigned int>       owners, first_cells, leaf_of_cells;
    unsigned int                    n_hanging = 0;
  };

  /** Ranks of leaves along their curve, such that each has about the same sum
   * of @p weights. */
  std::vector<unsigned int>
  partition_leaves(const std::vector<double> &weights,
                   const unsigned int         n_ranks);

  /** The same for @p leaves of several layers, each of @p n_trees trees that
   * are copies of those of the first one: such that leaves at the same place
   * belong to the same rank, but for sizes that differ. */
  template <int dim>
  std::vector<unsigned int>
  partition_leaves(const std::vector<Leaf<dim>> &leaves,
                   const std::vector<double>    &weights,
                   const unsigned int            n_trees,
                   const unsigned int            n_ranks);
} // namespace isochor

#endif
