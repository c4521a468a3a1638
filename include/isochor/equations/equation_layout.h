/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_equation_layout_h
#define isochor_equation_layout_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/element_nodes.h>
#include <isochor/linear_solver/sparse_system.h>

#include <utility>
#include <vector>

namespace isochor
{
  /**
   * The equations of the free unknowns at the active nodes: their numbers, the
   * pattern of the matrix, and for each element where its entries go, so that
   * assembly is additions at known places.
   */
  template <int dim>
  class EquationLayout
  {
  public:
    /** Both are kept by reference. */
    EquationLayout(const ActiveNodes<dim> &nodes, SparseSystem &system);
    EquationLayout(const EquationLayout &) = delete;

    /** Number the equations of the entries of nodal fields that are not
     * @p constrained and lay out the rows of the matrix for the @p elements,
     * and with them those nodes of the @p extended ones that their entries go
     * to. Collective. */
    void
    reinit(const unsigned int                n_components,
           const std::vector<unsigned char> &constrained,
           const ElementNodes               &elements,
           const ElementNodes               &extended);

    /** Equation of an entry of a nodal field, local number, or invalid. */
    unsigned int
    equation(const unsigned int entry) const
    {
      return equations[entry];
    }
    bool
    has_equation(const unsigned int entry) const
    {
      return equations[entry] != numbers::invalid_unsigned_int;
    }

    /** Whether one of the unknowns of element @p e has no equation. */
    bool
    is_constrained(const unsigned int e) const
    {
      return element_is_constrained[e] != 0;
    }

    /** Add the @p matrix of element @p e to the system's, by rows; @p node are
     * its n_nodes nodes as extended. */
    void
    add(const unsigned int        e,
        const unsigned int *const node,
        const unsigned int        n_nodes,
        const double *const       matrix);

  private:
    /** Global numbers of equations and local entries of fields, ascending. */
    using FreeEntries =
      std::vector<std::pair<types::global_dof_index, unsigned int>>;
    /** Number what is free, one after the other over the ranks. Collective. */
    FreeEntries
    number_free_entries(const std::vector<unsigned char> &constrained);
    /** Tell the system what its local equations are, and order the nodes by
     * their first ones. */
    void
    describe_equations(const FreeEntries &sorted);
    void
    collect_neighbours(const ElementNodes &elements);
    void
    build_rows();
    void
    find_blocks(const ElementNodes &own, const ElementNodes &elements);
    /** add() of elements all of whose unknowns are free, @p nc at a node. */
    template <unsigned int nc>
    void
    add_free_element(const unsigned int  e,
                     const unsigned int *node,
                     const unsigned int  n_nodes,
                     const double       *matrix);
    /** Add what two nodes share, by its strides in the element's matrix. */
    void
    add_block(const unsigned int row_node,
              const unsigned int column_node,
              const unsigned int offset,
              const double      *block,
              const unsigned int row_stride,
              const unsigned int column_stride);
    unsigned int
    n_free(const unsigned int node) const
    {
      return node_first_free[node + 1] - node_first_free[node];
    }

    const ActiveNodes<dim>   &nodes;
    SparseSystem             &system;
    unsigned int              n_components = 0;
    std::vector<unsigned int> equations;
    /** Prefix sums over nodes of the number of their free unknowns. */
    std::vector<unsigned int> node_first_free;

    /** Nodes with free unknowns in the order of their equations, and the
     * neighbours of each in that order with the offset of their columns. */
    std::vector<unsigned int> node_order, nodes_in_order;
    std::vector<std::size_t>  neighbour_start;
    std::vector<unsigned int> neighbour, neighbour_offset;

    /** For each pair of an element's nodes (of a symmetric matrix once, the
     * node first whose equations are) where in a row of the first one the
     * columns of the second begin, counted as if the row began with those of
     * its first neighbour: of a symmetric matrix, the node itself. */
    std::vector<std::size_t>   block_start;
    std::vector<unsigned int>  block_offset;
    std::vector<unsigned char> element_is_constrained;
  };
} // namespace isochor

#endif
