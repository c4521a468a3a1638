/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/time_integrator.h>

namespace isochor
{
  void
  TimeIntegrator::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry("Scheme",
                      "Bossak",
                      Patterns::Selection("Bossak|Newmark"),
                      "Bossak: of second order, damps only what the steps "
                      "don't resolve, by 'Spectral radius'. Newmark: with "
                      "'Newmark beta' and 'Newmark gamma'.");
    prm.declare_entry("Spectral radius",
                      "0.9",
                      Patterns::Double(0, 1),
                      "Of Bossak's scheme: the factor per step by which "
                      "oscillations decay that are much faster than the steps. "
                      "1: none does (the trapezoidal rule).");
    prm.declare_entry("Newmark beta",
                      "0.25",
                      Patterns::Double(0.0001, 0.5),
                      "0.25 with gamma = 0.5: constant average acceleration, "
                      "the trapezoidal rule.");
    prm.declare_entry("Newmark gamma",
                      "0.5",
                      Patterns::Double(0.5, 1),
                      "Above 0.5 all frequencies are damped, and the scheme is "
                      "of first order only.");
  }



  void
  TimeIntegrator::parse_parameters(ParameterHandler &prm)
  {
    if (prm.get("Scheme") == "Newmark")
      {
        beta  = prm.get_double("Newmark beta");
        gamma = prm.get_double("Newmark gamma");
        alpha = 0;
        return;
      }
    const double rho = prm.get_double("Spectral radius");
    alpha            = (rho - 1) / (rho + 1);
    beta             = (1 - alpha) * (1 - alpha) / 4;
    gamma            = 0.5 - alpha;
  }
} // namespace isochor
