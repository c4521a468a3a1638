/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/explanation.h>
#include <isochor/base/warnings.h>

#include <algorithm>
#include <iostream>

namespace isochor
{
  void
  Warnings::add(const std::string &subject, const std::string &text)
  {
    const auto known = std::find_if(warnings.begin(),
                                    warnings.end(),
                                    [&](const Warning &warning) {
                                      return warning.subject == subject;
                                    });
    if (known != warnings.end())
      {
        ++known->n_times;
        return;
      }
    warnings.push_back({subject, text, 1});
    if (prints)
      std::cerr << printed(subject, text) << std::endl;
  }



  std::string
  Warnings::printed(const std::string &subject, const std::string &text)
  {
    return wrapped("warning [" + subject + "]: " + text);
  }



  std::string
  Warnings::summary() const
  {
    if (warnings.empty())
      return "No warnings.";
    std::string text = std::to_string(warnings.size()) +
                       (warnings.size() == 1 ? " warning" : " warnings") +
                       ", see above: ";
    for (const Warning &warning : warnings)
      {
        text += &warning == &warnings.front() ? "" : ", ";
        text += warning.subject;
        if (warning.n_times > 1)
          text += " (" + std::to_string(warning.n_times) + " times)";
      }
    return text + '.';
  }
} // namespace isochor
