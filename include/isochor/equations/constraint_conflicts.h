/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_constraint_conflicts_h
#define isochor_constraint_conflicts_h

#include <isochor/equations/equation_term.h>

namespace isochor
{
  /** The path of the parameter that NodalConstraints::source names, "Walls" or
   * "Walls: name of the section"; with " = item", such as "Walls = top", an
   * item of it. */
  std::string
  parameter_of(const std::string &source);

  /**
   * Say which conditions determine the same unknowns otherwise, for the
   * conflicts of @p constraints on any rank: a warning with the names of the
   * conditions and a place; an error if they are of the same precedence, so
   * that nothing tells which one is meant. @p in_contact: of conflicts with
   * what one-sided walls hold, or of the others. Collective.
   */
  template <int dim>
  void
  tell_conflicts(const StepContext<dim> &step,
                 const NodalConstraints &constraints,
                 const bool              in_contact);
} // namespace isochor

#endif
