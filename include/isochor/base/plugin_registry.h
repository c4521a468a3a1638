/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_plugin_registry_h
#define isochor_plugin_registry_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Does nothing. Who uses a registry needs this function and so, for linkers
   * that leave out libraries of which nothing is needed, the library itself,
   * with the plugins in it. */
  void
  need_plugins_of_library();

  /** The names of the parameters that @p declare declares at the level where it
   * is called, not those of subsections. */
  std::set<std::string>
  declared_parameters(void (*declare)(ParameterHandler &));

  /**
   * The plugins of one kind (material models, linear solvers, ...) by name.
   * A plugin is one `.cc` file that holds its class and ends with
   * @code
   *   ISOCHOR_REGISTER(MaterialModel, NeoHookean, "Neo-Hookean")
   * @endcode
   * (or ISOCHOR_REGISTER_FOR_DIMENSION for a class template on `dim`). Each
   * class has a static `declare_parameters(ParameterHandler &)` and a default
   * constructor; its virtual `parse_parameters(ParameterHandler &)` reads what
   * the former declared, from the same subsection. Post-processors and boundary
   * conditions without parameters need neither.
   */
  template <typename Interface>
  class PluginRegistry
  {
  public:
    using Factory     = std::function<std::unique_ptr<Interface>()>;
    using Declaration = void (*)(ParameterHandler &);

    /** Make a plugin known. Called from static objects before main(), or when
     * a shared library is loaded. */
    static bool
    add(const std::string &name, Factory create, Declaration declare)
    {
      // not the place to throw; declare_parameters() will
      if (!entries().emplace(name, Entry{std::move(create), declare}).second)
        name_used_twice() = name;
      return true;
    }

    /** "first|second|...", the pattern of a Patterns::Selection. */
    static std::string
    names()
    {
      std::string list;
      for (const auto &entry : entries())
        list += (list.empty() ? "" : "|") + entry.first;
      return list;
    }

    /** Declare the parameters of all plugins of this kind. */
    static void
    declare_parameters(ParameterHandler &prm)
    {
      AssertThrow(name_used_twice().empty(),
                  ExcMessage("Two plugins have the name <" + name_used_twice() +
                             ">. Rename one of them where it is registered."));
      for (const auto &entry : entries())
        entry.second.declare(prm);
    }

    /** Declare the parameters of plugin @p name. */
    static void
    declare_parameters(const std::string &name, ParameterHandler &prm)
    {
      entry(name).declare(prm);
    }

    /** The names of the parameters of plugin @p name. */
    static std::set<std::string>
    parameters(const std::string &name)
    {
      return declared_parameters(entry(name).declare);
    }

    /** A new object of plugin @p name, its parameters not yet parsed. */
    static std::unique_ptr<Interface>
    create(const std::string &name)
    {
      return entry(name).create();
    }

    /** Append a new object of every plugin, with its name, for kinds of which
     * all take part and their parameters decide what they do. */
    static void
    create_all(std::vector<std::unique_ptr<Interface>> &objects)
    {
      for (const auto &entry : entries())
        {
          objects.push_back(entry.second.create());
          objects.back()->name = entry.first;
        }
    }

  private:
    struct Entry
    {
      Factory     create;
      Declaration declare;
    };

    static const Entry &
    entry(const std::string &name)
    {
      const auto found = entries().find(name);
      AssertThrow(found != entries().end(),
                  ExcMessage("There is no plugin named <" + name +
                             ">. Known are: " + names() + "."));
      return found->second;
    }

    static std::map<std::string, Entry> &
    entries()
    {
      need_plugins_of_library();
      static std::map<std::string, Entry> all;
      return all;
    }

    static std::string &
    name_used_twice()
    {
      static std::string name;
      return name;
    }
  };

} // namespace isochor

/** Register class @p Class as plugin @p name of interface @p Interface. */
#define ISOCHOR_REGISTER(Interface, Class, name)                  \
  [[maybe_unused]] static const bool isochor_registered_##Class = \
    ::isochor::PluginRegistry<Interface>::add(                    \
      name,                                                       \
      []() -> std::unique_ptr<Interface> {                        \
        return std::make_unique<Class>();                         \
      },                                                          \
      &Class::declare_parameters);

/** Register the class template @p Class for dim = 2 and 3. */
#define ISOCHOR_REGISTER_FOR_DIMENSION(Interface, Class, name)    \
  [[maybe_unused]] static const bool isochor_registered_##Class = \
    ::isochor::PluginRegistry<Interface<2>>::add(                 \
      name,                                                       \
      []() -> std::unique_ptr<Interface<2>> {                     \
        return std::make_unique<Class<2>>();                      \
      },                                                          \
      &Class<2>::declare_parameters) &&                           \
    ::isochor::PluginRegistry<Interface<3>>::add(                 \
      name,                                                       \
      []() -> std::unique_ptr<Interface<3>> {                     \
        return std::make_unique<Class<3>>();                      \
      },                                                          \
      &Class<3>::declare_parameters);

#endif
