/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_connected_parts_h
#define isochor_connected_parts_h

#include <isochor/equations/element_nodes.h>
#include <isochor/equations/equation_term.h>

namespace isochor
{
  /** The part that each local node belongs to, by the least vertex (or number
   * of a control node) of it, if the nodes of an element of @p elements (those
   * of this rank) belong together: bodies that touch no cell in common are
   * parts of their own. Collective. */
  template <int dim>
  std::vector<unsigned int>
  part_names(const StepContext<dim> &step, const ElementNodes &elements);

  /** How many parts there are; control nodes don't count. Collective. */
  template <int dim>
  unsigned int
  number_of_parts(const StepContext<dim> &step, const ElementNodes &elements);
} // namespace isochor

#endif
