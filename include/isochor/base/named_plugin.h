/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_named_plugin_h
#define isochor_named_plugin_h

#include <string>
#include <vector>

namespace isochor
{
  /** A boundary of the grid, or "everywhere", that @p parameter names. */
  struct NamedBoundary
  {
    std::string parameter, name;
    /** Nodes there are active by the condition, wherever the body is. */
    bool has_own_nodes = false;
  };

  /**
   * What boundary conditions and post-processors know of themselves. There is
   * one object of each plugin, whose parameters stand in the common section
   * ("Postprocess"), and one more for each section "Postprocess: <instance>",
   * which names the plugin as its `Type`.
   */
  struct NamedPlugin
  {
    /** @p section: the common one. */
    explicit NamedPlugin(const std::string &section)
      : section(section)
    {}
    virtual ~NamedPlugin() = default;

    /** Those of the parameters, each once. */
    virtual std::vector<NamedBoundary>
    named_boundaries() const
    {
      return {};
    }

    /** As it is registered, with ": <instance>" behind it. A checkpoint keeps
     * the object's state by this name. */
    std::string name;
    /** The section with its parameters. */
    std::string section;
    /** What the user calls this object; empty in the common section. Columns of
     * the statistics and files of output carry it. */
    std::string instance;

    /** The path of one of its parameters, for messages. */
    std::string
    parameter(const std::string &entry) const
    {
      return section + "/" + entry;
    }
  };
} // namespace isochor

#endif
