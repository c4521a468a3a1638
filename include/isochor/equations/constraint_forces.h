/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_constraint_forces_h
#define isochor_constraint_forces_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/nodal_constraints.h>

#include <vector>

namespace isochor
{
  /**
   * The forces of linear equations between nodal unknowns. In equilibrium what
   * is missing at the nodes, the residual r, is Σ_k λ_k a_k over the equations
   * a_k·x = b_k (and what is prescribed). The multiplier λ_k of an equation
   * follows at the node of its pivot, from the residual there and the other
   * equations whose pivots are there: λ of a wall is the force along its
   * normal.
   *
   * Of no use, and no cost, where there are ties only.
   */
  class ConstraintForces
  {
  public:
    /** @p with_ties: there are equations on any rank. */
    void
    reinit(const NodalConstraints &constraints,
           const unsigned int      n_components,
           const bool              with_ties);

    bool
    empty() const
    {
      return equations.empty();
    }

    /**
     * Find the multipliers from the residual @p force of all nodes, before
     * anything is handed on, and take away from it what belongs to ties and to
     * relations between nodes (Precedence::periodic): what is left is what
     * walls and prescribed displacements do to the body (N).
     * Collective.
     */
    void
    find(const unsigned int n_owned_nodes, NodalField &force);

    /** λ of an equation, in the order of NodalConstraints::equations, on the
     * rank that owns the node of its pivot; zero of others. */
    double
    multiplier(const unsigned int equation) const
    {
      return multipliers[equation];
    }

    /** Whether a wall or a prescribed displacement acts on this
     * entry. */
    bool
    is_held(const unsigned int entry) const
    {
      return held[entry] != 0;
    }

  private:
    /** An equation, or the tie of one component, with its pivot at a node. */
    struct Row
    {
      unsigned int equation; ///< none for a tie
      unsigned int tie;
      unsigned int pivot;
    };

    /** What hands forces on to other nodes, in the order in which it has to:
     * each may hand on to the ones after it. */
    enum Kind : unsigned char
    {
      tie,
      relation,            ///< Precedence::periodic
      relation_of_control, ///< the same, with its pivot at a control node
      none_of_them
    };

    struct Node
    {
      unsigned int     node;
      Kind             kind = none_of_them; ///< the first of its rows
      std::vector<Row> rows;
    };

    bool
    hands_on(const Row &row) const
    {
      return row.equation == none ||
             equations[row.equation].precedence >= Precedence::periodic;
    }

    double
    coefficient_at(const Row &row, const unsigned int entry) const;
    void
    solve(const Node &node, const NodalField &force);
    void
    take_away(const Row &row, const double multiplier, NodalField &force) const;
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    unsigned int                            n_components = 0;
    std::vector<NodalConstraints::Equation> equations;
    std::vector<unsigned int>               entry;
    std::vector<double>                     coefficient;
    NodalTies                               ties;
    std::vector<Node>                       nodes;
    std::vector<unsigned char>              held;
    std::vector<double>                     multipliers, solution;
  };
} // namespace isochor

#endif
