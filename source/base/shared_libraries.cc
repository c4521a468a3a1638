/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/utilities.h>

#include <isochor/base/file_names.h>
#include <isochor/base/shared_libraries.h>

#include <dlfcn.h>

#include <fstream>
#include <iterator>

namespace isochor
{
  namespace
  {
    const char *const parameter = "Additional shared libraries";



    // deal.II has a library for debugging and one for speed. Both in one
    // program destroy the same objects twice at its end, and the dynamic linker
    // doesn't mind.
#ifdef DEBUG
    const std::string build_type = "Debug", other_deal_ii = "libdeal.ii.so";
#else
    const std::string build_type = "Release", other_deal_ii = "libdeal.ii.g.so";
#endif



    /** Whether the file @p path asks for the one that this program does not
     * use. */
    bool
    needs_other_deal_ii(const std::string &path)
    {
      std::ifstream     file(path, std::ios::binary);
      const std::string content(std::istreambuf_iterator<char>(file), {});
      return content.find(other_deal_ii) != std::string::npos;
    }



    void
    load(const std::string &name, const std::string &origin)
    {
      // dlopen() looks for a name without a slash in the system's directories
      const std::string path =
        name.find('/') == std::string::npos ? "./" + name : name;
      if (needs_other_deal_ii(path))
        throw ParameterError(
          origin + ": the library <" + name + "> of the parameter <" +
          parameter +
          "> was built for the other one of deal.II's libraries, <" +
          other_deal_ii + ">. Build it with -D CMAKE_BUILD_TYPE=" + build_type +
          ", as this program is.");
      if (dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL) == nullptr)
        throw ParameterError(origin + ": the library <" + name +
                             "> of the parameter <" + parameter +
                             "> can't be loaded: " + dlerror());
    }
  } // namespace



  void
  declare_shared_libraries(ParameterHandler &prm)
  {
    prm.declare_entry(parameter,
                      "",
                      Patterns::List(Patterns::FileName()),
                      "Shared libraries (.so) with plugins of your own: "
                      "materials, boundary conditions, solvers, "
                      "post-processors. See doc/extending.md.");
  }



  void
  load_shared_libraries(const std::vector<ParameterStatement> &statements)
  {
    const ParameterStatement *last = nullptr;
    for (const ParameterStatement &statement : statements)
      if (!statement.is_subsection &&
          statement.path == std::vector<std::string>{parameter})
        last = &statement;
    if (last != nullptr)
      for (const std::string &name : Utilities::split_string_list(last->value))
        load(path_of_file(name, *last), last->origin);
  }
} // namespace isochor
