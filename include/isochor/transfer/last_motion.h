/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_last_motion_h
#define isochor_last_motion_h

#include <isochor/equations/active_nodes.h>

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

    /** Keep @p unknowns, those of a step of the size @p size (s). */
    template <int dim>
    void
    remember(const ActiveNodes<dim> &nodes,
             const unsigned int      n_components,
             const double            size,
             const NodalField       &values)
    {
      step_size = size;
      vertices.clear();
      unknowns.clear();
      for (unsigned int node = 0; node < nodes.n_local(); ++node)
        {
          vertices.push_back(nodes.vertex(node));
          for (unsigned int a = 0; a < n_components; ++a)
            unknowns.push_back(values.local_element(node * n_components + a));
        }
    }

    /**
     * Start @p values from the last motion times @p ratio. The pressure,
     * component dim, is kept as it was: mapped to the points and back it would
     * be smoothed. Collective.
     */
    template <int dim>
    void
    extrapolate(const ActiveNodes<dim> &nodes,
                const unsigned int      n_components,
                const double            ratio,
                NodalField             &values) const
    {
      for (unsigned int i = 0; i < vertices.size(); ++i)
        {
          const unsigned int node = nodes.node(vertices[i]);
          if (node < nodes.n_owned())
            for (unsigned int a = 0; a < n_components; ++a)
              values.local_element(node * n_components + a) =
                (a < dim ? ratio : 1.) * unknowns[i * n_components + a];
        }
      values.update_ghost_values();
    }

    /** The pressure of the last step, whose nodes must be those of this one.
     * Collective. */
    template <int dim>
    void
    restore_pressure(const ActiveNodes<dim> &nodes,
                     const unsigned int      n_components,
                     NodalField             &values) const
    {
      for (unsigned int i = 0; i < vertices.size(); ++i)
        values.local_element(nodes.node(vertices[i]) * n_components + dim) =
          unknowns[i * n_components + dim];
      values.update_ghost_values();
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &vertices &unknowns &step_size;
    }
  };
} // namespace isochor

#endif
