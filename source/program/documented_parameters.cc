/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/utilities.h>

#include <isochor/base/parameter_list.h>
#include <isochor/program/documented_parameters.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace isochor
{
  namespace
  {
    /** The words that a pattern like "[Selection a|b ]" allows, "a, b"; empty
     * if it is another kind of pattern. */
    std::string
    allowed_words(const std::string &pattern)
    {
      const std::string begin = "[Selection ", end = " ]";
      if (pattern.size() < begin.size() + end.size() ||
          pattern.compare(0, begin.size(), begin) != 0)
        return "";
      std::string words =
        pattern.substr(begin.size(),
                       pattern.size() - begin.size() - end.size());
      return Utilities::replace_in_string(words, "|", ", ");
    }

    /** What follows the word @p keyword in a line; empty if it begins with
     * another one. */
    std::string
    text_after(const std::string &line, const std::string &keyword)
    {
      const std::string trimmed = Utilities::trim(line);
      return trimmed.compare(0, keyword.size(), keyword) == 0 ?
               Utilities::trim(trimmed.substr(keyword.size())) :
               "";
    }
  } // namespace



  void
  print_documented_parameters(const ParameterHandler &prm, std::ostream &out)
  {
    const ParameterList list(prm);
    std::stringstream   text;
    prm.print_parameters(text,
                         ParameterHandler::PRM |
                           ParameterHandler::KeepDeclarationOrder);

    ParameterList::Path path;
    // what is printed can be run: examples are comments
    const auto is_example = [&]() {
      return !path.empty() && std::count(example_sections.begin(),
                                         example_sections.end(),
                                         path.front()) > 0;
    };
    for (std::string line, mark; std::getline(text, line);
         out << mark << line << '\n')
      {
        mark = is_example() ? "# " : "";
        if (const std::string section = text_after(line, "subsection ");
            !section.empty())
          path.push_back(section);
        else if (Utilities::trim(line) == "end")
          path.pop_back();
        else if (const std::string set = text_after(line, "set "); !set.empty())
          {
            path.push_back(Utilities::trim(set.substr(0, set.find('='))));
            const auto        entry = list.entries.find(path);
            const std::string words = entry == list.entries.end() ?
                                        "" :
                                        allowed_words(entry->second.pattern);
            if (!words.empty())
              out << mark << std::string(2 * (path.size() - 1), ' ')
                  << "# One of: " << words << '\n';
            path.pop_back();
          }
        if (is_example())
          mark = "# ";
      }
  }
} // namespace isochor
