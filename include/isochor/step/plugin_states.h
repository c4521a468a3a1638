/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_plugin_states_h
#define isochor_plugin_states_h

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

// What boundary conditions and post-processors remember over a restart.
namespace isochor
{
  using namespace dealii;

  /** Throw if the checkpoint holds the state of a plugin that is not among
   * the @p objects of this program. */
  template <typename Plugin>
  void
  check_names(const std::map<std::string, std::string>   &states,
              const std::vector<std::unique_ptr<Plugin>> &objects)
  {
    for (const auto &state : states)
      AssertThrow(state.second.empty() || std::any_of(objects.begin(),
                                                      objects.end(),
                                                      [&](const auto &object) {
                                                        return object->name ==
                                                               state.first;
                                                      }),
                  ExcMessage("The checkpoint holds the state of <" +
                             state.first +
                             ">, which this program doesn't know. Is it in a "
                             "library that <Additional shared libraries> no "
                             "longer names?"));
  }



  /** Give each of the @p objects its state. One that was not there when the
   * checkpoint was written starts as in a new run. */
  template <typename Plugin>
  void
  load_states(const std::map<std::string, std::string>   &states,
              const std::vector<std::unique_ptr<Plugin>> &objects)
  {
    for (const auto &object : objects)
      if (const auto state = states.find(object->name); state != states.end())
        object->load_state(state->second);
  }
} // namespace isochor

#endif
