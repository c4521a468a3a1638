/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_parameter_list_h
#define isochor_parameter_list_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The subsections and parameters of a ParameterHandler by path, which it
   * tells only by printing them. */
  struct ParameterList
  {
    /** The names of the enclosing subsections, then its own. */
    using Path = std::vector<std::string>;

    struct Entry
    {
      std::string value, default_value;
      std::string pattern; ///< what is allowed, in words

      /** Whether it has another value than the default, as a text or, where
       * both are numbers, as a number. */
      bool
      is_changed() const;
    };

    /** Of @p prm at its top level. */
    explicit ParameterList(const ParameterHandler &prm);

    std::set<Path>        subsections;
    std::map<Path, Entry> entries;
  };

  /** "Section/Entry". */
  std::string
  join_path(const ParameterList::Path &path);
} // namespace isochor

#endif
