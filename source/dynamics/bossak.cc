/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/time_integrator.h>

namespace isochor
{
  /**
   * With α = (ρ - 1)/(ρ + 1), β = (1 - α)²/4, γ = 1/2 - α the scheme is of
   * second order, stable for any step in linear problems, and multiplies what
   * the step is far too long for by ρ per step: the generalised-α method of
   * Chung & Hulbert, J. Appl. Mech. 60 (1993) 371-375, with α_f = 0. ρ = 1 is
   * the trapezoidal rule (β = 1/4, γ = 1/2, α = 0).
   */
  class Bossak : public NewmarkFamily
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Spectral radius",
                        "0.9",
                        Patterns::Double(0, 1),
                        "Of Bossak's scheme: the factor per step by which "
                        "oscillations decay that are much faster than the "
                        "steps. 1: none does (the trapezoidal rule). From 0.95 "
                        "on bodies that turn several times may gain energy "
                        "with another <Quadrature/Type> than CPDI.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const double rho = prm.get_double("Spectral radius");
      alpha            = (rho - 1) / (rho + 1);
      beta             = (1 - alpha) * (1 - alpha) / 4;
      gamma            = 0.5 - alpha;
    }
  };

  ISOCHOR_REGISTER(TimeIntegrator, Bossak, "Bossak")
} // namespace isochor
