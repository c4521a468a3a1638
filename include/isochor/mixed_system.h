/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mixed_system_h
#define isochor_mixed_system_h

#include <deal.II/lac/trilinos_vector.h>

#include <isochor/active_nodes.h>
#include <isochor/nodal_constraints.h>
#include <isochor/sparse_system.h>

#include <vector>

namespace isochor
{
  /** Lists of local nodes, one per element, in compressed-row form. */
  struct ElementNodes
  {
    std::vector<std::size_t>  start = {0};
    std::vector<unsigned int> node;

    unsigned int
    size() const
    {
      return start.size() - 1;
    }

    void
    clear()
    {
      start.assign(1, 0);
      node.clear();
    }

    template <typename Iterator>
    void
    add(Iterator first, Iterator last)
    {
      node.insert(node.end(), first, last);
      start.push_back(node.size());
    }

    bool
    operator==(const ElementNodes &other) const
    {
      return start == other.start && node == other.node;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &start &node;
    }
  };

  /**
   * The algebraic system of the free unknowns at the active nodes: equation
   * numbers, sparsity pattern, and for each element where its entries go, so
   * that assembly is additions at known places. Constrained unknowns have no
   * equation; what they contribute goes to the right-hand side.
   */
  template <int dim>
  class MixedSystem
  {
  public:
    MixedSystem(const ActiveNodes<dim> &nodes);

    /**
     * Number the equations and lay out the matrix. Nothing is done if neither
     * the active nodes (@p nodes_changed), the elements nor the constrained set
     * changed since the last call; then the solver keeps its analysis.
     * Collective.
     */
    void
    reinit(const bool              nodes_changed,
           const unsigned int      n_components,
           const ElementNodes     &elements,
           const NodalConstraints &constraints,
           const bool              symmetric);

    /** Zero the residual, and matrix and lifting if @p with_matrix. */
    void
    start_assembly(const bool with_matrix);

    /**
     * Add an element's residual (n_dofs) and, if not null, matrix (n_dofs x
     * n_dofs by rows; of a symmetric one the upper triangle is read).
     * @p pending holds per nodal unknown the part of the prescribed increments
     * that is still to come; their columns go to the right-hand side.
     */
    void
    add_element(const unsigned int e,
                const double      *element_residual,
                const double      *element_matrix,
                const NodalField  &pending);

    /** Sum the residual over ranks. */
    void
    finish_assembly();

    /** Make @p vector one over the equations, if it isn't. Collective. */
    void
    shape(TrilinosWrappers::MPI::Vector &vector) const;

    /** rhs = - residual - (columns of pending increments), free unknowns. */
    void
    right_hand_side(TrilinosWrappers::MPI::Vector &rhs) const;

    /** Write the solution to the free unknowns of @p field (others kept) and
     * update its ghosts. */
    void
    to_nodes(const TrilinosWrappers::MPI::Vector &solution,
             NodalField                          &field) const;

    /** Equation of an entry of a nodal field, local number, or invalid. */
    unsigned int
    equation(const unsigned int entry) const
    {
      return equations[entry];
    }

    const SparseSystem &
    matrix() const
    {
      return system;
    }

    /** Residual at all active nodes, constrained ones included: there it is
     * the reaction. Valid after finish_assembly() on owned entries. */
    NodalField residual;

  private:
    void
    number_equations(const NodalConstraints &constraints);
    void
    collect_neighbours();
    void
    build_rows();
    void
    build_scatter_map();
    unsigned int
    n_free(const unsigned int node) const
    {
      return node_first_free[node + 1] - node_first_free[node];
    }

    const ActiveNodes<dim>    &nodes;
    unsigned int               n_components = 0;
    ElementNodes               elements;
    std::vector<unsigned char> constrained;

    SparseSystem              system;
    std::vector<unsigned int> equations;
    /** Prefix sums over nodes of the number of their free unknowns. */
    std::vector<unsigned int> node_first_free;

    /** Nodes with free unknowns in the order of their equations, and the
     * neighbours of each in that order with the offset of their columns. */
    std::vector<unsigned int> node_order, nodes_in_order;
    std::vector<std::size_t>  neighbour_start;
    std::vector<unsigned int> neighbour, neighbour_offset;

    std::vector<std::size_t>   scatter_start;
    std::vector<int>           scatter;
    std::vector<unsigned char> element_is_constrained;

    NodalField lifting;
  };
} // namespace isochor

#endif
