/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/diagnosis/diagnoses.h>

#include <algorithm>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  Diagnoses<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Diagnosis");
    prm.declare_entry("Level",
                      "all",
                      Patterns::Selection("all|essential|none"),
                      "Which warnings are looked for (doc/warnings.md): all, "
                      "without those that are advice, or none. Results are the "
                      "same; errors of the scene remain.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  Diagnoses<dim>::parse_parameters(ParameterHandler &prm, const bool print)
  {
    prm.enter_subsection("Diagnosis");
    const std::string level = prm.get("Level");
    prm.leave_subsection();
    found.print_here(print);
    if (level == "none")
      return;
    PluginRegistry<Diagnosis<dim>>::create_all(all);
    if (level == "essential")
      all.erase(std::remove_if(all.begin(),
                               all.end(),
                               [](const auto &one) {
                                 const auto *const text =
                                   find_explanation(one->name);
                                 return text != nullptr && !text->is_essential;
                               }),
                all.end());
    for (const auto &one : all)
      one->warnings = &found;
  }



  template <int dim>
  void
  Diagnoses<dim>::each(const std::function<void(Diagnosis<dim> &)> &look) const
  {
    TimerOutput::Scope scope(timer, "diagnosis");
    for (const auto &one : all)
      look(*one);
  }



  template <int dim>
  std::string
  Diagnoses<dim>::run_ended() const
  {
    std::string text;
    for (const auto &one : all)
      if (const std::string line = one->run_ended(); !line.empty())
        text += line + '\n';
    return text;
  }



  template <int dim>
  std::string
  Diagnoses<dim>::run_failed() const
  {
    std::string text;
    for (const auto &one : all)
      if (const std::string hint = one->run_failed(); !hint.empty())
        text += hint + '\n';
    return text;
  }



  template <int dim>
  std::string
  Diagnoses<dim>::save_state() const
  {
    std::string states;
    for (const auto &one : all)
      if (const std::string state = one->save_state(); !state.empty())
        states += one->name + ": " + state + '\n';
    return states;
  }



  template <int dim>
  void
  Diagnoses<dim>::load_state(const std::string &states)
  {
    std::istringstream lines(states);
    for (std::string line; std::getline(lines, line);)
      for (const auto &one : all)
        if (line.rfind(one->name + ": ", 0) == 0)
          one->load_state(line.substr(one->name.size() + 2));
  }



  template class Diagnoses<2>;
  template class Diagnoses<3>;
} // namespace isochor
