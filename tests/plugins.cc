/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What holds for the plugins of a kind, whatever they are called; and what the
// registry says of names.

#include <isochor/dynamics/time_integrator.h>

#include <cmath>
#include <iostream>
#include <string>

using namespace isochor;

namespace
{
  void
  check(const std::string &what, const bool ok, const double value = 0)
  {
    std::cout << what << ": " << (ok ? "OK" : "FAILED, ")
              << (ok ? "" : std::to_string(value)) << std::endl;
  }



  std::unique_ptr<TimeIntegrator>
  make(const std::string &name)
  {
    ParameterHandler prm;
    TimeIntegrator::declare_schemes(prm);
    prm.set("Inertia", true);
    prm.set("Scheme", name);
    return TimeIntegrator::create(prm);
  }



  /** The error of the oscillator x'' = -x from x = 1, v = 0 after time 1, by
   * the equation of motion at the end of each step, solved for Δu. */
  double
  error_of_oscillator(const TimeIntegrator &scheme, const unsigned int n_steps)
  {
    const double dt = 1. / n_steps;
    double       x = 1, v = 0, a = -1;
    for (unsigned int i = 0; i < n_steps; ++i)
      {
        // linear in Δu: from its value at 0
        const double rest =
          scheme.inertial_acceleration(a, scheme.acceleration(0, v, a, dt));
        const double increment = -(rest + x) / (scheme.stiffness(dt) + 1);
        const double new_a     = scheme.acceleration(increment, v, a, dt);
        v                      = scheme.velocity(v, a, new_a, dt);
        a                      = new_a;
        x += increment;
      }
    return std::max(std::abs(x - std::cos(1.)), std::abs(v + std::sin(1.)));
  }



  /** Each scheme converges; a matrix that isn't the derivative would not. */
  void
  test_schemes()
  {
    unsigned int n_static = 0;
    for (const std::string &name :
         Utilities::split_string_list(PluginRegistry<TimeIntegrator>::names(),
                                      '|'))
      {
        const auto scheme = make(name);
        if (!scheme->has_inertia())
          {
            ++n_static;
            continue;
          }
        const double coarse = error_of_oscillator(*scheme, 50);
        const double fine   = error_of_oscillator(*scheme, 100);
        check(name + ": derivative",
              std::abs(scheme->inertial_acceleration(
                         2, scheme->acceleration(0.3, 1, 2, 0.1)) -
                       scheme->inertial_acceleration(
                         2, scheme->acceleration(0, 1, 2, 0.1)) -
                       0.3 * scheme->stiffness(0.1)) < 1e-10);
        // with their default parameters all of them are of second order
        check(name + ": second order",
              coarse / fine > 3.8 && coarse / fine < 4.2,
              coarse / fine);
      }
    check("one scheme without inertia", n_static == 1, n_static);
  }



  class Kind
  {
  public:
    virtual ~Kind() = default;
    static void
    declare_parameters(ParameterHandler &)
    {}
  };
  class One : public Kind
  {};
  class Another : public Kind
  {};
  ISOCHOR_REGISTER(Kind, One, "same name")
  ISOCHOR_REGISTER(Kind, Another, "same name")



  void
  test_names()
  {
    bool             thrown = false;
    ParameterHandler prm;
    try
      {
        PluginRegistry<Kind>::declare_parameters(prm);
      }
    catch (const ExceptionBase &exception)
      {
        thrown =
          std::string(exception.what())
            .find("Two plugins have the name <same name>") != std::string::npos;
      }
    check("two plugins of one name", thrown);
  }
} // namespace



int
main()
{
  test_schemes();
  test_names();
  return 0;
}
