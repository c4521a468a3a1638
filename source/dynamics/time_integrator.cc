/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/time_integrator.h>

namespace isochor
{
  void
  TimeIntegrator::declare_schemes(ParameterHandler &prm)
  {
    prm.declare_entry("Inertia",
                      "false",
                      Patterns::Bool(),
                      "Whether the body has inertia, or is in equilibrium at "
                      "all times (quasi-static), as with 'Scheme = statics'.");
    prm.declare_entry("Scheme",
                      "Bossak",
                      Patterns::Selection(
                        PluginRegistry<TimeIntegrator>::names()),
                      "Bossak: of second order, damps only what the steps "
                      "don't resolve, by 'Spectral radius'. Newmark: with "
                      "'Newmark beta' and 'Newmark gamma'. statics: no inertia "
                      "(quasi-static).");
    PluginRegistry<TimeIntegrator>::declare_parameters(prm);
  }



  std::unique_ptr<TimeIntegrator>
  TimeIntegrator::create(ParameterHandler &prm)
  {
    auto scheme = PluginRegistry<TimeIntegrator>::create(
      prm.get_bool("Inertia") ? prm.get("Scheme") : "statics");
    scheme->parse_parameters(prm);
    return scheme;
  }
} // namespace isochor
