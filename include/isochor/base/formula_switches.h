/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_formula_switches_h
#define isochor_formula_switches_h

#include <string>
#include <vector>

namespace isochor
{
  /** Whether @p formula contains the time, t. */
  bool
  is_of_time(const std::string &formula);

  /**
   * Formulas in the time alone that change their sign where @p formula changes
   * its branch: a - b for each comparison of a with b and for each two
   * arguments of min() and max(), a for abs(a). What depends on the place, too,
   * is left out. @p formula is one that can be read.
   */
  std::vector<std::string>
  switches_in_time(const std::string &formula);
} // namespace isochor

#endif
