/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/time_integrator.h>

namespace isochor
{
  /** Newmark's scheme with β and γ as given; α = 0. */
  class Newmark : public NewmarkFamily
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Newmark beta",
                        "0.25",
                        Patterns::Double(0.0001, 0.5),
                        "0.25 with gamma = 0.5: constant average acceleration, "
                        "the trapezoidal rule.");
      prm.declare_entry("Newmark gamma",
                        "0.5",
                        Patterns::Double(0.5, 1),
                        "Above 0.5 all frequencies are damped, and the scheme "
                        "is of first order only.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      beta  = prm.get_double("Newmark beta");
      gamma = prm.get_double("Newmark gamma");
    }
  };

  ISOCHOR_REGISTER(TimeIntegrator, Newmark, "Newmark")
} // namespace isochor
