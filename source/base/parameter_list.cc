/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Boost's own JSON parser uses what Boost 1.74 warns about.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS

#include <isochor/base/parameter_list.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <sstream>

namespace isochor
{
  namespace
  {
    void
    collect(const boost::property_tree::ptree &tree,
            const ParameterList::Path         &path,
            ParameterList                     &list)
    {
      for (const auto &[name, child] : tree)
        {
          ParameterList::Path child_path = path;
          child_path.push_back(name);
          // A parameter is a node with a text "value", an alias one with a
          // text "alias"; a subsection may contain parameters of these names,
          // but those aren't plain texts.
          const auto has_text = [&child = child](const char *key) {
            const auto node = child.find(key);
            return node != child.not_found() && node->second.empty();
          };
          if (has_text("value"))
            list.entries[child_path] = {
              child.get<std::string>("value"),
              child.get<std::string>("default_value", ""),
              child.get<std::string>("pattern_description", "")};
          else if (has_text("alias"))
            {
              ParameterList::Path target = path;
              target.push_back(child.get<std::string>("alias"));
              list.entries[child_path].pattern =
                "the values of <" + join_path(target) + ">";
            }
          else
            {
              list.subsections.insert(child_path);
              collect(child, child_path, list);
            }
        }
    }
  } // namespace



  ParameterList::ParameterList(const ParameterHandler &prm)
  {
    std::stringstream json;
    prm.print_parameters(json, ParameterHandler::JSON);
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(json, tree);
    collect(tree, {}, *this);
  }



  bool
  ParameterList::Entry::is_changed() const
  {
    if (value == default_value)
      return false;
    std::istringstream texts[2] = {std::istringstream(value),
                                   std::istringstream(default_value)};
    double             numbers[2];
    for (unsigned int i = 0; i < 2; ++i)
      if (!(texts[i] >> numbers[i]) || !(texts[i] >> std::ws).eof())
        return true;
    return numbers[0] != numbers[1];
  }



  std::string
  join_path(const ParameterList::Path &path)
  {
    std::string result;
    for (const std::string &name : path)
      result += (result.empty() ? "" : "/") + name;
    return result;
  }
} // namespace isochor
