/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_earlier_output_h
#define isochor_earlier_output_h

#include <string>

namespace isochor
{
  /** What an earlier run has left in @p directory that a new one replaces, as
   * a sentence for the user; empty if there is nothing. */
  std::string
  describe_earlier_output(const std::string &directory);
} // namespace isochor

#endif
