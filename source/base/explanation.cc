/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/exceptions.h>

#include <isochor/base/explanation.h>

#include <map>
#include <sstream>

namespace isochor
{
  using namespace dealii;

  namespace
  {
    std::map<std::string, Explanation> &
    explanations()
    {
      static std::map<std::string, Explanation> all;
      return all;
    }

    /** The names, one a line. */
    std::string
    list_of_names()
    {
      std::string list;
      for (const auto &entry : explanations())
        list += entry.first + '\n';
      return list;
    }

    std::string
    described(const Explanation &one)
    {
      return one.name + (one.is_essential ? " (essential)" : "") + "\n  " +
             wrapped("When: " + one.when + ".") + "\n  " +
             wrapped("What to do: " + one.remedy + ".") + '\n';
    }

    std::string
    table()
    {
      std::string text = "| warning | when | what to do |\n|---|---|---|\n";
      for (const auto &entry : explanations())
        {
          const Explanation &one  = entry.second;
          std::string        name = one.name;
          for (auto i = name.find('<'); i != std::string::npos;
               i      = name.find('<', i + 2))
            name.insert(i, "\\");
          text += "| " + name + (one.is_essential ? " | " : " (advice) | ") +
                  one.when + " | " + one.remedy + " |\n";
        }
      return text;
    }
  } // namespace



  bool
  explain(const Explanation &explanation)
  {
    return explanations().emplace(explanation.name, explanation).second;
  }



  std::vector<Explanation>
  all_explanations()
  {
    std::vector<Explanation> all;
    for (const auto &entry : explanations())
      all.push_back(entry.second);
    return all;
  }



  const Explanation *
  find_explanation(const std::string &warning)
  {
    const std::string fixed = warning.substr(0, warning.find('<'));
    for (const auto &entry : explanations())
      if (entry.first.substr(0, entry.first.find('<')) == fixed)
        return &entry.second;
    return nullptr;
  }



  std::string
  explanation_text(const std::string &name)
  {
    if (name.empty())
      return list_of_names();
    if (name == "all")
      return table();
    if (const Explanation *const found = find_explanation(name))
      return described(*found);
    std::string text;
    for (const auto &entry : explanations())
      if (entry.first.rfind(name, 0) == 0)
        text += described(entry.second);
    AssertThrow(!text.empty(),
                ExcMessage("There is no warning <" + name + ">. There are:\n" +
                           list_of_names()));
    return text;
  }



  std::string
  wrapped(const std::string &text, const unsigned int width)
  {
    const std::string  indent = "  ";
    std::istringstream words(text);
    std::string        lines, line, word;
    while (words >> word)
      {
        if (!line.empty() && line.size() + 1 + word.size() > width)
          {
            lines += line + '\n';
            line = indent + word;
          }
        else
          line += (line.empty() ? "" : " ") + word;
      }
    return lines + line;
  }
} // namespace isochor
