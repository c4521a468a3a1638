/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The sections of a scene that may stand there several times.
#include <isochor/base/parameter_file.h>

#include <algorithm>
#include <map>
#include <string>

namespace isochor
{
  namespace
  {
    /** Of an origin "scene.prm:12". */
    std::string
    file_of(const std::string &origin)
    {
      return origin.substr(0, origin.rfind(':'));
    }



    bool
    contains(const std::vector<NamedSection> &sections, const std::string &name)
    {
      return std::any_of(sections.begin(),
                         sections.end(),
                         [&name](const NamedSection &known) {
                           return known.section == name;
                         });
    }
  } // namespace



  unsigned int
  n_numbered_subsections(const std::vector<ParameterStatement> &statements,
                         const std::string                     &name)
  {
    std::map<unsigned int, std::string> origins;
    for (const ParameterStatement &statement : statements)
      {
        const std::string &section = statement.path.front();
        const bool         is_in_section =
          statement.is_subsection || statement.path.size() > 1;
        if (!is_in_section || section.rfind(name + " ", 0) != 0)
          continue;
        const std::string digits = section.substr(name.size() + 1);
        // Anything else, like "name 02", is left to be found undeclared.
        if (!digits.empty() && digits.size() < 7 && digits[0] != '0' &&
            digits.find_first_not_of("0123456789") == std::string::npos &&
            digits != "1")
          origins.emplace(std::stoul(digits), statement.origin);
      }

    unsigned int n = 1;
    for (const auto &[number, origin] : origins)
      if (number != ++n)
        throw ParameterError(origin + ": there is a subsection <" + name + " " +
                             std::to_string(number) + "> but no <" + name +
                             " " + std::to_string(n) +
                             ">; number them without gaps");
    return n;
  }



  std::vector<NamedSection>
  named_subsections(const std::vector<ParameterStatement> &statements,
                    const std::string                     &kind,
                    const bool                             with_types)
  {
    std::vector<NamedSection>          sections;
    std::map<std::string, std::string> origins;
    for (const ParameterStatement &statement : statements)
      {
        const std::string &section = statement.path.front();
        if (section.rfind(kind + ":", 0) != 0)
          continue;
        if (section.size() < kind.size() + 3 || section[kind.size() + 1] != ' ')
          throw ParameterError(statement.origin + ": the subsection <" +
                               section + "> needs a name: <" + kind +
                               ": name>");
        const std::string first =
          origins.emplace(section, statement.origin).first->second;
        if (first == statement.origin && !contains(sections, section))
          sections.push_back({section, ""});
        else if (statement.is_subsection && statement.path.size() == 1 &&
                 first != statement.origin &&
                 file_of(first) == file_of(statement.origin))
          throw ParameterError(
            statement.origin + ": there is a subsection <" + section +
            "> already, see " + first +
            "; give this one another name, or put the parameters of both "
            "into one");
        if (statement.path == std::vector<std::string>{section, "Type"})
          for (NamedSection &known : sections)
            if (known.section == section)
              known.type = statement.value;
      }
    for (const NamedSection &known : sections)
      if (with_types && known.type.empty())
        throw ParameterError(origins.at(known.section) + ": the subsection <" +
                             known.section + "> needs a parameter <" +
                             known.section +
                             "/Type> that names what it describes");
    return sections;
  }
} // namespace isochor
