/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_time_integrator_h
#define isochor_time_integrator_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/plugin_registry.h>
#include <isochor/grid/prescribed_motion.h>

#include <memory>

namespace isochor
{
  using namespace dealii;

  /**
   * Interface of the schemes in time: how displacement, velocity and
   * acceleration of a node go together over a step, and which acceleration
   * enters the equation of motion. All relations are between scalars, one
   * component of one node. To add one, write `source/dynamics/<name>.cc`
   * with the class and its registration; its parameters live in the subsection
   * "Dynamics", where `Scheme` names it.
   *
   * Forces are those at the end of the step: those at its start would be of
   * another grid. Statics is the scheme without inertia: nothing else is asked
   * of it, and nothing that goes with velocities is stored or computed.
   */
  class TimeIntegrator
  {
  public:
    virtual ~TimeIntegrator() = default;

    /** Declare `Inertia`, `Scheme` and the parameters of all schemes, in the
     * subsection "Dynamics". */
    static void
    declare_schemes(ParameterHandler &prm);
    /** The scheme that the parameters name: statics if `Inertia` is false. */
    static std::unique_ptr<TimeIntegrator>
    create(ParameterHandler &prm);

    /** For those without parameters. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** Whether the equation of motion contains accelerations at all. */
    virtual bool
    has_inertia() const
    {
      return true;
    }

    /** a_{n+1} (m/s²) of an @p increment Δu over a step of size @p dt. */
    virtual double
    acceleration(const double increment,
                 const double v_n,
                 const double a_n,
                 const double dt) const = 0;

    /** v_{n+1} (m/s), with @p a the acceleration a_{n+1}. */
    virtual double
    velocity(const double v_n,
             const double a_n,
             const double a,
             const double dt) const = 0;

    /** The acceleration that the equation of motion contains. */
    virtual double
    inertial_acceleration(const double /*a_n*/, const double a) const
    {
      return a;
    }

    /** Its derivative with respect to Δu (1/s²). */
    virtual double
    stiffness(const double dt) const = 0;

    /** The share m of the forces at the end of a step in its change of
     * velocity, if it has started with the acceleration of those at its start.
     */
    virtual double
    end_weight() const
    {
      return 0.5;
    }

    /** What to start with for the scheme, in steps of size @p dt, to follow a
     * motion u(t) whose jerk is constant without error in the inertial
     * acceleration. */
    virtual SmoothStart
    smooth_start(const double /*dt*/) const
    {
      return {};
    }
  };

  /**
   * The schemes with
   *   Δu      = Δt v_n + Δt² ((1/2 - β) a_n + β a_{n+1}),
   *   v_{n+1} = v_n + Δt ((1 - γ) a_n + γ a_{n+1})            (Newmark 1959),
   *   M ((1 - α) a_{n+1} + α a_n) + f_int(u_{n+1}) = f_ext(t_{n+1})
   *                                (Wood, Bossak & Zienkiewicz, Int. J. Numer.
   *                                Meth. Eng. 15 (1980) 1562-1566).
   */
  class NewmarkFamily : public TimeIntegrator
  {
  public:
    NewmarkFamily(const double beta  = 0.25,
                  const double gamma = 0.5,
                  const double alpha = 0)
      : beta(beta)
      , gamma(gamma)
      , alpha(alpha)
    {}

    double
    acceleration(const double increment,
                 const double v_n,
                 const double a_n,
                 const double dt) const override
    {
      return (increment - dt * v_n) / (beta * dt * dt) - (0.5 / beta - 1) * a_n;
    }

    double
    velocity(const double v_n,
             const double a_n,
             const double a,
             const double dt) const override
    {
      return v_n + dt * ((1 - gamma) * a_n + gamma * a);
    }

    double
    inertial_acceleration(const double a_n, const double a) const override
    {
      return (1 - alpha) * a + alpha * a_n;
    }

    double
    stiffness(const double dt) const override
    {
      return (1 - alpha) / (beta * dt * dt);
    }

    /** By the last two relations, v_{n+1} - v_n = Δt ((1 - m) a_n + m M^{-1}
     * (f_ext - f_int)). */
    double
    end_weight() const override
    {
      return gamma / (1 - alpha);
    }

    /** By the relations above, a_n = ü + k Δt J and v_n = u̇ + m Δt² J for a
     * jerk J in all steps for one k and one m. With Bossak's γ = 1/2 - α the
     * inertial acceleration then is ü at the end of the step. */
    SmoothStart
    smooth_start(const double dt) const override
    {
      const double k = 0.5 - gamma, m = 1. / 6 - k / 2 - beta;
      return {m * dt * dt, k * dt};
    }

  protected:
    double beta, gamma, alpha;
  };
} // namespace isochor

#endif
