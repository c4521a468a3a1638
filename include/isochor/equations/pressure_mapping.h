/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_pressure_mapping_h
#define isochor_pressure_mapping_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/equation_term.h>

namespace isochor
{
  /**
   * Map the pressure of the points to the nodes, as component dim of
   * @p unknowns, ghosts included:
   *   p_I = Σ N_I m_p p_p / Σ N_I m_p,                                   P(37)
   * with the volumes of the points in place of their masses where a material
   * has no mass. Nodes that no point touches keep 0. Collective.
   */
  template <int dim>
  void
  map_pressure_to_nodes(const StepContext<dim> &step, NodalField &unknowns);
} // namespace isochor

#endif
