/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_active_nodes_h
#define isochor_active_nodes_h

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <isochor/grid/background_grid.h>

#include <memory>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** A field of one or more components on the active nodes: node I, component
   * a is entry n_components * I + a. Owned nodes first, then ghosts. */
  using NodalField = LinearAlgebra::distributed::Vector<double>;

  /**
   * The nodes that some material point touches, numbered on their own: nothing
   * that a step allocates, assembles or solves is larger than this set. On
   * each rank the owned active nodes come first, then the ghosts; the order is
   * that of the global numbers within each.
   */
  template <int dim>
  class ActiveNodes
  {
  public:
    ActiveNodes(const BackgroundGrid<dim> &grid);

    /**
     * Make the nodes at the @p touched vertices (any order, repeated or not)
     * the active ones; those of other ranks included. Collective.
     * Returns whether the set changed on any rank.
     */
    bool
    update(std::vector<unsigned int> touched);

    unsigned int
    n_owned() const
    {
      return n_owned_nodes;
    }

    /** Owned and ghost nodes. */
    unsigned int
    n_local() const
    {
      return vertices.size();
    }

    types::global_dof_index
    n_global() const
    {
      return n_global_nodes;
    }

    /** The vertex of a local node. */
    unsigned int
    vertex(const unsigned int node) const
    {
      return vertices[node];
    }

    /** The local node at a vertex, or numbers::invalid_unsigned_int. */
    unsigned int
    node(const unsigned int vertex) const
    {
      return node_at_vertex[vertex];
    }

    /** Shape @p field to hold @p n_components per active node, zeroed. */
    void
    initialize(NodalField &field, const unsigned int n_components) const;

    const BackgroundGrid<dim> &grid;

  private:
    /** Vertices owned by this rank among all ranks' touched ones. */
    std::vector<unsigned int>
    collect_owned(const std::vector<unsigned int> &touched) const;

    std::vector<unsigned int> vertices;
    std::vector<unsigned int> node_at_vertex;
    std::vector<unsigned int> last_touched;
    unsigned int              last_mesh      = 0; ///< of what grid they are
    unsigned int              n_owned_nodes  = 0;
    types::global_dof_index   n_global_nodes = 0;
    types::global_dof_index   first_owned    = 0;
    /** Global numbers of the ghosts, ascending. */
    std::vector<types::global_dof_index> ghosts;
    mutable std::map<unsigned int,
                     std::shared_ptr<const Utilities::MPI::Partitioner>>
      partitioners;
  };
} // namespace isochor

#endif
