/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/parameter_list.h>
#include <isochor/base/plugin_registry.h>

namespace isochor
{
  void
  need_plugins_of_library()
  {}



  std::set<std::string>
  declared_parameters(void (*declare)(ParameterHandler &))
  {
    ParameterHandler prm;
    declare(prm);
    const std::string other = "no parameter"; // an empty list can't be printed
    prm.declare_entry(other, "", Patterns::Anything());
    std::set<std::string> names;
    for (const auto &entry : ParameterList(prm).entries)
      if (entry.first.size() == 1 && entry.first.front() != other)
        names.insert(entry.first.front());
    return names;
  }
} // namespace isochor
