/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tied_bodies_h
#define isochor_tied_bodies_h

#include <isochor/equations/equation_term.h>

namespace isochor
{
  /** Warn of parts of the body whose domains have no corner in common, but
   * which nodes of the grid tie to each other: there may be a gap between them
   * that the grid doesn't see. At the start; ContactWatch tells of bodies that
   * meet later. Collective. */
  template <int dim>
  void
  warn_of_tied_bodies(const MaterialPoints<dim> &body,
                      const StepContext<dim>    &step);
} // namespace isochor

#endif
