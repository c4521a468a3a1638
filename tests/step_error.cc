/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Step sizes that follow the error of the steps (Time/Tolerated error).

#include "run_scene.h"

using namespace isochor;

template <int dim>
bool
warns(const MaterialPointMethod<dim> &problem, const std::string &subject)
{
  for (const auto &warning : test::all_warnings(problem).all())
    if (warning.subject == subject)
      return true;
  return false;
}

constexpr double density = 2, modulus = 2000, speed = 0.1, length = 1;
/** Of the first natural vibration of a bar (1/s). */
const double frequency = test::pi / 2 / length * std::sqrt(modulus / density);

/** A bar, held on the left, whose first natural vibration starts from where it
 * is fastest: the tip is at u = v_0 / ω sin(ω t). */
const std::string bar =
  "Grid/Upper corner = 1, 0.0625\nGrid/Subdivisions = 32, 2\n" +
  test::keep_grid +
  "Formulation/Type = u\nMaterial/Young modulus = 2000\n"
  "Material/Poisson ratio = 0\nMaterial/Density = 2\n"
  "Material points/Points per cell = 3\n"
  "Dynamics/Inertia = true\nDynamics/Spectral radius = 1\n"
  "Dynamics/Initial velocity = 0.1*sin(pi*x/2), 0\n"
  "Boundary conditions/Displacement = left: x=0; bottom: y=0; top: y=0\n"
  "Postprocess/Point probes = tip: 1, 0.03125\n"
  "Time/Output interval = 1e9\n";

/** The error of one step of the trapezoidal rule is Δt³ ω² v / 12, at the
 * beginning, in the root mean square. */
void
test_estimate()
{
  for (const double dt : {1e-3, 5e-4})
    {
      const std::string size    = std::to_string(dt);
      const auto        problem = test::run_scene<2>(
        bar + "Time/Tolerated error = 1\nTime/Step size = " + size +
        "\nTime/End time = " + size + '\n');
      const double expected =
        dt * dt * dt * frequency * frequency * speed / std::sqrt(2.) / 12;
      test::check_error("estimate for a step of " + size + " s",
                        test::relative(test::get(*problem, "Error of step (m)"),
                                       expected),
                        3e-3);
    }
}

/** Of steps that have a hundredth of the error, sizes are a 4.6th, and the
 * error at the end, of second order in them, is a 22nd. */
void
test_convergence()
{
  const double end   = 0.25,
               exact = speed / frequency * std::sin(frequency * end);
  double before      = 0;
  for (const double tolerance : {1e-5, 1e-7})
    {
      std::ostringstream settings, name;
      settings << "Time/Tolerated error = " << tolerance
               << "\nTime/End time = " << end
               << "\nTime/Step size = 1e-4\nTime/Maximum step size = 0.1\n";
      name << "bar, tolerance " << tolerance << ": ";
      const auto   problem = test::run_scene<2>(bar + settings.str());
      const double error =
        std::abs(test::get(*problem, "Displacement x of tip (m)") - exact);
      test::check_error(name.str() + "error of a step, at most",
                        test::largest_in_statistics("Error of step (m)"),
                        tolerance);
      test::check_error(name.str() + "error at the end",
                        error,
                        before == 0 ? 5e-4 : before / 12);
      test::check(name.str() + "number of steps",
                  test::recorded().times.size() < (before == 0 ? 50 : 200),
                  std::to_string(test::recorded().times.size()));
      before = error;
    }
}

/** A block falls for 0.2 s and meets the ground: no step resolves the fall,
 * many the rest. */
void
test_fall()
{
  const std::string block =
    "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 1\n"
    "Grid/Subdivisions = 16, 8\n"
    "Material points/Region = x > 0.5 && x < 1.5 && y > 0.25 && y < 0.75\n"
    "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
    "Formulation/Type = u\nDynamics/Inertia = true\n"
    "Boundary conditions/Walls = bottom: n >= 0\n"
    "Boundary conditions/Gravity = 0, -10\n"
    "Postprocess/Point probes = foot: 1, 0.26\n"
    "Time/Step size = 0.001\nTime/Maximum step size = 0.1\n"
    "Time/Tolerated error = 1e-4\nTime/Output interval = 0.2\n";
  const auto   fall    = test::run_scene<2>(block + "Time/End time = 0.2\n");
  const double n_steps = test::recorded().times.size();
  test::check("block that falls: steps grow",
              n_steps <= 12,
              std::to_string(n_steps));
  test::check_error("it falls by g t²/2",
                    std::abs(test::get(*fall, "Displacement y of foot (m)") +
                             0.2),
                    1e-10);
  const auto impact = test::run_scene<2>(block + "Time/End time = 0.25\n");
  test::check("it meets the ground: steps are cut",
              test::get(*impact, "Step cuts") > 0 &&
                test::recorded().times.size() > n_steps + 10,
              std::to_string(test::recorded().times.size()));
  test::check("no step was too small for that",
              !warns(*impact, "the smallest step is too large"),
              test::all_warnings(*impact).summary());
  const auto coarse = test::run_scene<2>(
    block + "Time/End time = 0.25\nTime/Minimum step size = 0.001\n"
            "Time/Tolerated error = 1e-7\n");
  test::check("steps that may not be smaller are told",
              warns(*coarse, "the smallest step is too large"),
              test::all_warnings(*coarse).summary());
}

/** A block on a grid that moves with it would be through the ground in one of
 * the steps that its fall allows. */
void
test_cells_crossed()
{
  const auto problem = test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 2\n"
    "Grid/Subdivisions = 16, 16\n"
    "Material points/Region = x > 0.5 && x < 1.5 && y > 1.25 && y < 1.75\n"
    "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
    "Formulation/Type = u\nDynamics/Inertia = true\n"
    "Boundary conditions/Walls = bottom: n >= 0\n"
    "Boundary conditions/Gravity = 0, -10\n"
    "Postprocess/Point probes = foot: 1, 1.26\n"
    "Time/Step size = 0.02\nTime/Maximum step size = 0.5\n"
    "Time/Tolerated error = 1e-3\nTime/Output interval = 0.54\n"
    "Time/End time = 0.54\n" +
    test::keep_grid);
  test::check("a falling block doesn't cross more than a cell in a step",
              test::get(*problem, "Displacement y of foot (m)") > -1.3 &&
                test::recorded().times.size() > 10,
              std::to_string(test::recorded().times.size()));
}

/** A bar that swings through cells of which it fills parts, some by corners of
 * domains only. */
void
test_swinging_bar()
{
  const auto problem = test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Lower corner = 0, -0.5\n"
    "Grid/Upper corner = 1.1, 0.2\nGrid/Subdivisions = 44, 28\n"
    "Material points/Region = x < 1 && y > 0 && y < 0.1\n"
    "Material/Young modulus = 5e6\nMaterial/Poisson ratio = 0.499\n"
    "Material/Density = 1000\nDynamics/Inertia = true\n"
    "Boundary conditions/Displacement = left: x=0, y=0\n"
    "Boundary conditions/Gravity = 0, -9.81\n"
    "Postprocess/Point probes = tip: 1, 0.05\n"
    "Time/Step size = 0.02\nTime/Maximum step size = 0.1\n"
    "Time/Tolerated error = 1e-3\nTime/Output interval = 0.4\n"
    "Time/End time = 0.4\n");
  test::check("a swinging bar: to the end",
              test::get(*problem, "Time (s)") == 0.4 &&
                test::get(*problem, "Step cuts") > 0,
              std::to_string(test::get(*problem, "Time (s)")));
}

/** A bar is moved suddenly, with v, at a time that no step of its own ends at.
 * The steps that are tried there, each smaller than the last one, find it where
 * the first one did, and no step is shorter than it may be. A wave with the
 * force ρ c v goes through the bar; the time that it needs is 0.01 s, which
 * steps of 1e-3 s resolve to 5 %. */
void
test_sudden_motion()
{
  for (const std::string tolerance : {"1e-6", "1e-5"})
    for (const std::string output : {"1e9", "0.01729998"})
      {
        const auto problem = test::run_scene<2>(
          "Grid/Upper corner = 1, 0.125\nGrid/Subdivisions = 32, 4\n" +
          test::keep_grid +
          "Formulation/Type = u\nMaterial/Young modulus = 1e7\n"
          "Material/Poisson ratio = 0\nMaterial/Density = 1000\n"
          "Dynamics/Inertia = true\nBoundary conditions/Displacement = "
          "left: x=0.5*max(t-0.0173, 0); bottom: y=0; top: y=0\n"
          "Time/Step size = 1e-3\nTime/Maximum step size = 1e-2\n"
          "Time/End time = 0.0273\nTime/Tolerated error = " +
          tolerance + "\nTime/Output interval = " + output + '\n');
        const std::string name =
          "sudden motion, " + tolerance + " m, output " + output + ": ";
        const double force = 1000 * 100 * 0.5 * 0.125;
        test::check_error(name + "work",
                          test::relative(test::get(*problem,
                                                   "External work (J)"),
                                         force * 0.5 * 0.01),
                          tolerance == "1e-6" ? 0.015 : 0.07);
        double shortest = 1, last = 0;
        for (const double time : test::recorded().times)
          {
            shortest = std::min(shortest, time - last);
            last     = time;
          }
        test::check(name + "no short steps",
                    test::get(*problem, "Step cuts") > 0 && shortest > 1e-5,
                    std::to_string(shortest));
      }
}

/** With this pair of Newmark's parameters there is no estimate. */
void
test_no_measure()
{
  std::string message;
  try
    {
      test::run_scene<2>(bar + "Time/Tolerated error = 1\n"
                               "Time/Step size = 1e-3\nTime/End time = 1e-3\n"
                               "Dynamics/Scheme = Newmark\n"
                               "Dynamics/Newmark beta = 0.16666666666666666\n");
    }
  catch (const std::exception &exception)
    {
      message = exception.what();
    }
  test::check("a scheme without a measure of the error",
              message.find("<Time/Tolerated error> has no measure") !=
                std::string::npos,
              message);
}

/** In statics there is no such error. */
void
test_statics()
{
  const auto problem = test::run_scene<2>(
    "Grid/Subdivisions = 2, 2\nTime/Tolerated error = 1e-4\n"
    "Boundary conditions/Displacement = bottom: x=0, y=0; top: y=0.1*t\n");
  test::check("statics: no effect",
              warns(*problem, "no effect of <Time/Tolerated error>"),
              test::all_warnings(*problem).summary());
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_estimate();
  test_convergence();
  test_fall();
  test_cells_crossed();
  test_swinging_bar();
  test_sudden_motion();
  test_no_measure();
  test_statics();
  return 0;
}
