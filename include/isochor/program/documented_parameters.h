/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_documented_parameters_h
#define isochor_documented_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <ostream>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Sections of which a scene may have any number, with names of its own. */
  inline const std::vector<std::string> example_sections =
    {"Interaction: <name> - <partner>", "Rigid body: <name>"};

  /** Print all parameters as a parameter file: their documentation as comments
   * and, where only some words are allowed, which these are. deal.II's own
   * printing leaves the latter out. The example_sections are comments. */
  void
  print_documented_parameters(const ParameterHandler &prm, std::ostream &out);
} // namespace isochor

#endif
