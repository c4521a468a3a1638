/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_dependent_nodes_h
#define isochor_dependent_nodes_h

#include <isochor/cut_cells/nodal_support.h>

#include <map>
#include <unordered_set>
#include <utility>

namespace isochor
{
  /**
   * Nodes with material around them that still have next to no stiffness of
   * their own. With CPDI a domain feels nodes through its corners only: if two
   * nodes are touched by one corner of the body and nothing else, Σ N_I u_I at
   * this corner is all that counts, and the matrix is singular however much
   * material hangs on the corner. So it is, nearly, with several corners close
   * to each other.
   *
   * What is a node's own is measured with the scalar stiffness
   *   K_IJ = Σ_p V_p ∇N_pI · ∇N_pJ:
   * the smallest of x·K x with x_I = 1, x_J free for the neighbours J with no
   * more support than I and zero for all others. A node is *dependent* if that
   * is less than a small part of K_II. Of two nodes with the same support both
   * are: the result does not depend on how nodes are numbered.
   */
  template <int dim>
  class DependentNodes
  {
  public:
    DependentNodes(const CellOccupancy<dim> &occupancy);

    /**
     * Find those among the nodes at the surface. @p points are those of the
     * step with their weights, @p support tells the support of a vertex, in
     * [0, 1], which all ranks near it know; @p smallest_part is what is small.
     * Points without stencils of their own have none: a cell feels its nodes by
     * gradients in all directions. Collective.
     */
    void
    update(const PointArrays<dim>  &points,
           const NodalSupport<dim> &support,
           const double             smallest_part);

    /** Known of vertices near this rank. */
    bool
    contain(const unsigned int vertex) const
    {
      return dependent.count(vertex) != 0;
    }

  private:
    /** K_IJ of vertices I <= J. */
    using Entries = std::map<std::pair<unsigned int, unsigned int>, double>;

    Entries
    collect(const PointArrays<dim>  &points,
            const NodalSupport<dim> &support) const;
    /** Give each rank the sums of all for the vertices near it. */
    void
    exchange(Entries &entries) const;

    const CellOccupancy<dim>        &occupancy;
    std::unordered_set<unsigned int> dependent;
  };
} // namespace isochor

#endif
