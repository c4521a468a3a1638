/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_time_integrator_h
#define isochor_time_integrator_h

#include <deal.II/base/parameter_handler.h>

namespace isochor
{
  using namespace dealii;

  /**
   * How displacement, velocity and acceleration of a node go together over a
   * step, and which acceleration enters the equation of motion:
   *   Δu      = Δt v_n + Δt² ((1/2 - β) a_n + β a_{n+1}),
   *   v_{n+1} = v_n + Δt ((1 - γ) a_n + γ a_{n+1})            (Newmark 1959),
   *   M ((1 - α) a_{n+1} + α a_n) + f_int(u_{n+1}) = f_ext(t_{n+1})
   *                                (Wood, Bossak & Zienkiewicz, Int. J. Numer.
   *                                Meth. Eng. 15 (1980) 1562-1566).
   * With α = (ρ - 1)/(ρ + 1), β = (1 - α)²/4, γ = 1/2 - α the scheme is of
   * second order, stable for any step in linear problems, and multiplies what
   * the step is far too long for by ρ per step (Chung & Hulbert, J. Appl. Mech.
   * 60 (1993) 371-375, with α_f = 0). ρ = 1 is the trapezoidal rule (β = 1/4,
   * γ = 1/2, α = 0). It needs no forces of the step before, which would be
   * those of another grid.
   */
  class TimeIntegrator
  {
  public:
    TimeIntegrator() = default;
    TimeIntegrator(const double beta, const double gamma, const double alpha)
      : beta(beta)
      , gamma(gamma)
      , alpha(alpha)
    {}

    /** In the subsection "Dynamics". */
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** a_{n+1} of an increment Δu over a step of size @p dt. */
    double
    acceleration(const double increment,
                 const double v_n,
                 const double a_n,
                 const double dt) const
    {
      return (increment - dt * v_n) / (beta * dt * dt) - (0.5 / beta - 1) * a_n;
    }

    /** v_{n+1}. */
    double
    velocity(const double v_n,
             const double a_n,
             const double a,
             const double dt) const
    {
      return v_n + dt * ((1 - gamma) * a_n + gamma * a);
    }

    /** The acceleration that the equation of motion contains. */
    double
    inertial_acceleration(const double a_n, const double a) const
    {
      return (1 - alpha) * a + alpha * a_n;
    }

    /** Its derivative with respect to Δu (1/s²). */
    double
    stiffness(const double dt) const
    {
      return (1 - alpha) / (beta * dt * dt);
    }

  private:
    double beta = 0.25, gamma = 0.5, alpha = 0;
  };
} // namespace isochor

#endif
