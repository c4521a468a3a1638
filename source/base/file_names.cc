/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/utilities.h>

#include <isochor/base/file_names.h>
#include <isochor/base/parameter_list.h>

#include <filesystem>

namespace isochor
{
  std::string
  path_of_file(const std::string &name, const ParameterStatement &statement)
  {
    // "scene.prm:12"; the origin of an option has no line
    const auto colon = statement.origin.rfind(':');
    if (name.empty() || colon == std::string::npos ||
        std::filesystem::path(name).is_absolute())
      return name;
    const std::filesystem::path scene = statement.origin.substr(0, colon);
    const std::filesystem::path beside =
      (scene.parent_path() / name).lexically_normal();
    std::error_code code;
    const bool      is_beside = std::filesystem::exists(beside, code),
               is_here        = std::filesystem::exists(name, code);
    if (is_here && !(is_beside && std::filesystem::equivalent(beside, name)))
      throw ParameterError(
        statement.origin + ": the file <" + name + "> of the parameter <" +
        join_path(statement.path) + "> is relative to the parameter file: <" +
        beside.string() + ">, " +
        (is_beside ? "but there is one in the working directory, too" :
                     "which does not exist, but there is one in the working "
                     "directory") +
        ". To say which: --set \"" + join_path(statement.path) + "=" + name +
        "\", relative to the working directory, or an absolute path");
    return beside.string();
  }



  namespace
  {
    /** @p value, whose names of files have become @p path_of(name). */
    template <typename PathOf>
    std::string
    changed(const std::string &value,
            const std::string &pattern,
            const PathOf      &path_of)
    {
      if (pattern.rfind("[List of <[FileName", 0) == 0)
        {
          std::string all;
          for (const std::string &name : Utilities::split_string_list(value))
            all += (all.empty() ? "" : ", ") + path_of(name);
          return all;
        }
      return pattern.rfind("[FileName", 0) == 0 ? path_of(value) : value;
    }
  } // namespace



  std::string
  with_paths_of_files(const ParameterStatement &statement,
                      const std::string        &pattern)
  {
    return changed(statement.value, pattern, [&](const std::string &name) {
      return path_of_file(name, statement);
    });
  }



  void
  make_file_names_absolute(ParameterHandler &prm)
  {
    for (const auto &[path, entry] : ParameterList(prm).entries)
      {
        const std::string value =
          changed(entry.value, entry.pattern, [](const auto &name) {
            return name.empty() ? name :
                                  std::filesystem::absolute(name)
                                    .lexically_normal()
                                    .string();
          });
        if (value == entry.value)
          continue;
        for (unsigned int i = 0; i + 1 < path.size(); ++i)
          prm.enter_subsection(path[i]);
        prm.set(path.back(), value);
        for (unsigned int i = 0; i + 1 < path.size(); ++i)
          prm.leave_subsection();
      }
  }
} // namespace isochor
