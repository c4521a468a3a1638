/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>

namespace isochor
{
  void
  need_plugins_of_library()
  {}
} // namespace isochor
