/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_replaced_parameters_h
#define isochor_replaced_parameters_h

#include <isochor/base/parameter_file.h>

namespace isochor
{
  /** @throws ParameterError for a parameter or subsection of earlier versions,
   * which says what took its place. */
  void
  check_replaced(const ParameterStatement &statement);
} // namespace isochor

#endif
