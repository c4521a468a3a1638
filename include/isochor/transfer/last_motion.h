/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_last_motion_h
#define isochor_last_motion_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/element_nodes.h>

#include <vector>

namespace isochor
{
  /** The nodal unknowns of the last step at this rank's active
   * nodes: what the next step's start is extrapolated from. */
  struct LastMotion
  {
    std::vector<unsigned int> vertices;
    std::vector<double>       unknowns;      ///< n_components per vertex
    double                    step_size = 0; ///< 0: there was no step yet

    /** Keep @p values, those of a step of the size @p size (s). */
    template <int dim>
    void
    remember(const ActiveNodes<dim> &nodes,
             const unsigned int      n_components,
             const double            size,
             const NodalField       &values);

    /**
     * Start @p values from the last motion times @p ratio. Nodes that the body
     * has just reached move like the mean of their neighbours in @p elements:
     * left where they are they would tear what is in the cells around them.
     * The pressure, component dim, is kept as it was: mapped to the points and
     * back it would be smoothed. Collective.
     */
    template <int dim>
    void
    extrapolate(const ActiveNodes<dim> &nodes,
                const ElementNodes     &elements,
                const unsigned int      n_components,
                const double            ratio,
                NodalField             &values) const;

    /** The pressure of the last step, whose nodes must be those of this one.
     * Collective. */
    template <int dim>
    void
    restore_pressure(const ActiveNodes<dim> &nodes,
                     const unsigned int      n_components,
                     NodalField             &values) const;

    /** The cells of the @p grid have got other owners: bring the unknowns to
     * those that own the vertices now. Collective. */
    template <int dim>
    void
    send_to_owners(const BackgroundGrid<dim> &grid);

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &vertices &unknowns &step_size;
    }
  };
} // namespace isochor

#endif
