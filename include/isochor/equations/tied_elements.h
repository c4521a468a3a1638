/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tied_elements_h
#define isochor_tied_elements_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/element_nodes.h>
#include <isochor/equations/nodal_constraints.h>

#include <vector>

namespace isochor
{
  /**
   * Elimination of tied unknowns (see NodalTies) from elements. With the
   * unknowns u = C ū of an element in terms of those that are not tied, its
   * matrix becomes Cᵀ K C on the element's nodes and, behind them, the nodes
   * they are tied to.
   */
  class TiedElements
  {
  public:
    /** Does nothing but note that there are no ties if there are none on this
     * rank. */
    void
    reinit(const ElementNodes     &elements,
           const NodalConstraints &constraints,
           const unsigned int      n_components,
           const unsigned int      n_nodes);

    bool
    empty() const
    {
      return ties.size() == 0;
    }

    const NodalTies &
    nodal_ties() const
    {
      return ties;
    }

    bool
    is_tied(const unsigned int node, const unsigned int component) const
    {
      return !empty() && tie_of_node[node] != none &&
             !prescribed[tie_of_node[node] * n_components + component];
    }

    /** The elements' nodes, followed by those they are tied to. Only if not
     * empty(). */
    const ElementNodes &
    extended() const
    {
      return extended_elements;
    }

    bool
    touches(const unsigned int element) const
    {
      return !empty() && element_is_tied[element];
    }

    /** Cᵀ K C by rows over the nodes of extended(), of an element that touches
     * ties, given K over its own @p n_nodes nodes (of a symmetric one the upper
     * triangle is read). Valid until the next call. */
    const double *
    eliminate(const unsigned int element,
              const unsigned int n_nodes,
              const double      *matrix,
              const bool         symmetric);

    /** Move the forces on this rank's tied unknowns to those they are tied to,
     * which may be others' (to be summed up then), and keep them. */
    void
    hand_on_forces(const unsigned int n_owned_nodes, NodalField &force);

    /** What the last call of hand_on_forces() moved away from node k of the
     * ties; zero for nodes of other ranks. */
    double
    force(const unsigned int k, const unsigned int component) const
    {
      return forces[k * n_components + component];
    }

    /** Set the tied unknowns of all local nodes by the others. */
    void
    interpolate(NodalField &field) const;

  private:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    NodalTies                  ties;
    unsigned int               n_components = 0;
    std::vector<unsigned int>  tie_of_node;
    std::vector<unsigned char> prescribed; ///< by tie and component
    ElementNodes               extended_elements;
    std::vector<unsigned char> element_is_tied;
    std::vector<double>        forces;

    /** Rows of C for one element, and the result. */
    std::vector<unsigned int> row_start, row_column;
    std::vector<double>       row_weight, result;
  };
} // namespace isochor

#endif
