/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_condition_h
#define isochor_condition_h

#include <isochor/base/warnings.h>

#include <string>
#include <vector>

namespace isochor
{
  /** Whether a formula that stands for a condition, which holds where it is
   * above 0, has names in it, but nothing that compares or chooses. It may be
   * meant all the same: as one that is below 0 elsewhere. */
  bool
  compares_nothing(const std::string &formula);

  /** Warn of the @p formula of a condition, from @p parameter, that
   * compares_nothing() and has these @p values at all places in question, if
   * none of them is below 0 and most are above, others than 1 among them: it
   * leaves out hardly anything, as `y` where y > 0. */
  void
  warn_of_formula_for_condition(const std::string         &formula,
                                const std::string         &parameter,
                                const std::vector<double> &values,
                                Warnings                  &warnings);
} // namespace isochor

#endif
