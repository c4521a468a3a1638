/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_replaced_parameters_h
#define isochor_replaced_parameters_h

#include <string>

namespace isochor
{
  /** What took the place of the subsection or parameter @p name of earlier
   * versions, for the user; empty if it is none. */
  std::string
  replacement_of(const std::string &name);
} // namespace isochor

#endif
