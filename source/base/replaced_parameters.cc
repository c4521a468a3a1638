/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/replaced_parameters.h>

#include <map>

namespace isochor
{
  std::string
  replacement_of(const std::string &name)
  {
    static const std::map<std::string, std::string> replacements = {
      {"Ghost penalty",
       "nodes of cut cells are tied to well filled cells instead, see "
       "<Cut cells/Extension> (auto, always or never, as <Ghost penalty/Use> "
       "was); there are no coefficients any more"},
      {"Rigid sides",
       "tie the body's surface to a rigid body instead. <right: y = 0, "
       "rotation = t> of a body that ends at x = 8 is now\n"
       "subsection Rigid body: end\n"
       "  set Shape = half plane\n"
       "  set Point = 8, 0.5    # on the side; set Reference point, too, if "
       "it turns\n"
       "  set Normal = -1, 0    # towards the body\n"
       "  set Motion = y=0, rotation=t\n"
       "  set Free = x          # what was not named; Force, Moment\n"
       "end\n"
       "subsection Interaction: body - end\n"
       "  set Law = tie\n"
       "  set Surface = x > 7.99\n"
       "end"}};
    const auto found = replacements.find(name);
    return found != replacements.end() ? found->second : "";
  }
} // namespace isochor
