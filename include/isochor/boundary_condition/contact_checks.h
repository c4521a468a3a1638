/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_contact_checks_h
#define isochor_contact_checks_h

#include <isochor/base/statistics.h>
#include <isochor/boundary_condition/boundary_condition.h>

namespace isochor
{
  /**
   * Look at the forces between the body and its @p walls, those of all
   * conditions, at the end of a step, and warn of
   *
   * - walls that act before the body reaches them (check_early_contact());
   * - held boundaries that pull a body which isn't there: a node of the grid is
   *   held as soon as a cell around it holds material, so that what should be
   *   free is glued to the boundary across the empty part of the cell. Told
   *   in the first step, where the gaps that the pulling forces have in the
   *   mean are more than a fourth of a cell (a third, where points have no
   *   domains).
   *
   * Collective.
   */
  template <int dim>
  void
  check_contacts(const StepContext<dim>               &step,
                 const NodalField                     &unknowns,
                 const std::vector<WallContacts<dim>> &walls,
                 Statistics                           &statistics);
} // namespace isochor

#endif
