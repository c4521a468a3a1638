/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/utilities.h>

#include <isochor/base/shared_libraries.h>

#include <dlfcn.h>

namespace isochor
{
  namespace
  {
    const char *const parameter = "Additional shared libraries";



    void
    load(const std::string &name, const std::string &origin)
    {
      // dlopen() looks for a name without a slash in the system's directories
      const std::string path =
        name.find('/') == std::string::npos ? "./" + name : name;
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
                      "post-processors; with a path. See "
                      "doc/extending.md.");
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
        load(name, last->origin);
  }
} // namespace isochor
