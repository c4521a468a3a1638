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
   * A node that is no vertex of the grid and has no material, but unknowns that
   * others follow: the translation or the rotation of a rigid body, a mean
   * strain. Its displacement components are these unknowns, its pressure is
   * prescribed.
   */
  template <int dim>
  struct ControlNode
  {
    Point<dim> position;
    /** The components are displacements (0); or a rotation vector times this
     * length about position, in 2D its only component, the first one; or
     * neither (negative). For solvers that know rigid motions. */
    double rotation_arm = 0;
  };

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
      AssertIndexRange(node, vertices.size());
      return vertices[node];
    }

    /** Set the control nodes, of which there may be none, as long as no other
     * call refers to others: their number must not change in a run. */
    void
    set_control_nodes(const std::vector<ControlNode<dim>> &nodes)
    {
      control = nodes;
    }

    /** The number that stands for the vertex of control node @p k. */
    unsigned int
    control_vertex(const unsigned int k) const
    {
      return grid.triangulation().n_vertices() + k;
    }

    /** The control node that a local node is, or a null pointer. */
    const ControlNode<dim> *
    control_node(const unsigned int node) const
    {
      AssertIndexRange(node, vertices.size());
      return control.empty() || vertices[node] < control_vertex(0) ?
               nullptr :
               &control[vertices[node] - control_vertex(0)];
    }

    /** The entries of the control nodes that this rank knows, of fields with
     * @p n_components per node. */
    std::vector<unsigned int>
    control_entries(const unsigned int n_components) const;

    /** Where a local node is on the undeformed grid. */
    const Point<dim> &
    position(const unsigned int node) const
    {
      const ControlNode<dim> *const c = control_node(node);
      return c ? c->position : grid.geometry().vertices()[vertices[node]];
    }

    /** The local node at a vertex, or numbers::invalid_unsigned_int. */
    unsigned int
    node(const unsigned int vertex) const
    {
      AssertIndexRange(vertex, node_at_vertex.size());
      return node_at_vertex[vertex];
    }

    /** Shape @p field to hold @p n_components per active node, zeroed. */
    void
    initialize(NodalField &field, const unsigned int n_components) const;

    const BackgroundGrid<dim> &grid;

  private:
    /** The rank that owns the node at @p vertex, or a control node. */
    unsigned int
    owner(const unsigned int vertex) const
    {
      return vertex < control_vertex(0) ? grid.vertex_owner(vertex) : 0;
    }
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
    std::vector<ControlNode<dim>> control;
  };
} // namespace isochor

#endif
