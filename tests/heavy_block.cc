/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Heavy bodies in a smooth box in dynamics, u-p with PPP and the defaults: what
// is at rest stays so, what vibrates does so with its period. With a weight in
// the stabilisation that depended on accelerations they fed their own
// vibrations, from 0.01 to 1e6 J in 0.1 s.

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::string box =
    "Grid/Upper corner = 1, 1.25\nMaterial points/Region = y < 1\n"
    "Material/Density = 1000\nDynamics/Inertia = true\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
    "Output/Terminal = quiet\nQuadrature/Type = CPDI\n";

  /** The weight acts all of a sudden: the block of rubber may breathe, whose
   * kinetic energy is at most the work of the weight. */
  void
  test_rest(const std::string &what, const std::string &settings)
  {
    const auto problem = test::run_scene<2>(
      box +
      "Grid/Subdivisions = 8, 10\nMaterial/Young modulus = 3e6\n"
      "Material/Poisson ratio = 0.499\nTime/End time = 0.1\n"
      "Boundary conditions/Gravity = 0, -10\n" +
      settings);
    const double K = test::get(*problem, "Kinetic energy (J)");
    // the static energy W² H/(6 M A), M the modulus of compression between
    // smooth walls, is half of the weight's work down to there
    const double modulus = 3e6 * (1 - 0.499) / ((1 + 0.499) * (1 - 2 * 0.499));
    const double largest = 1e4 * 1e4 / (6 * modulus);
    test::check("rubber at rest, " + what + ": kinetic energy",
                K >= 0 && K < largest,
                std::to_string(K) + " of " + std::to_string(largest));
  }

  /** An incompressible block whose weight comes slowly doesn't move. */
  void
  test_incompressible(const std::string &what, const std::string &settings)
  {
    const auto problem = test::run_scene<2>(
      box +
      "Grid/Subdivisions = 8, 10\nMaterial/Young modulus = 3000\n"
      "Material/Poisson ratio = 0.5\nTime/Step size = 0.02\n"
      "Boundary conditions/Gravity = 0, -10*min(t/0.4, 1)\n"
      "Postprocess/Reactions = bottom\n" +
      settings);
    test::check_error("incompressible block, " + what + ": kinetic energy",
                      test::get(*problem, "Kinetic energy (J)"),
                      1e-12);
    test::check_error(
      "incompressible block, " + what + ": weight",
      test::relative(test::get(*problem, "Reaction y on bottom (N)"), 1e4),
      1e-8);
  }

  /** The first standing wave of an incompressible gel with a free surface,
   * linear: potential and shear parts with velocities zero where the box is and
   * stresses zero at the surface give ω = 4.06535 / s for G = 1000 Pa,
   * 1000 kg/m³, g = 10 m/s², 1 m wide and deep. */
  void
  test_standing_wave(const std::string &grid)
  {
    const double omega = 4.06535, amplitude = 0.002;
    for (const double time : {0.4, 0.78})
      {
        const auto problem = test::run_scene<2>(
          box + grid +
          "Material/Young modulus = 3000\nMaterial/Poisson ratio = 0.5\n"
          "Boundary conditions/Gravity = 0, -10\n"
          "Dynamics/Initial velocity = "
          "-4.3556e-5*(-pi*cosh(pi*y) + 343.966*cos(2.580207*y))*sin(pi*x), "
          "-4.3556e-5*(pi*sinh(pi*y) - 418.808*sin(2.580207*y))*cos(pi*x)\n"
          "Time/Step size = 0.02\nPostprocess/Point probes = l: 0, 1\n"
          "Time/End time = " +
          std::to_string(time) + "\n");
        const double u = test::get(*problem, "Displacement y of l (m)");
        test::check_error("standing wave at t = " + std::to_string(time),
                          std::abs(u - amplitude * std::sin(omega * time)) /
                            amplitude,
                          0.025);
      }
  }

  /** A body that weighs next to nothing lands on a gel at rest, soon after
   * t = 0.58: what carries the gel doesn't feel it. */
  void
  test_landing()
  {
    const std::string reaction = "Reaction y on bottom (N)";
    test::record_columns({reaction});
    const auto problem = test::run_scene<2>(
      "Grid/Upper corner = 1, 2.5\nGrid/Subdivisions = 8, 20\n"
      "Material points/Region = (y < 0.5 && x < 0.75) || (y > 2.125 && y < "
      "2.375 && x > 0.25 && x < 0.5)\n"
      "Material points/Materials in zones = 2: y > 1\n"
      "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.499\n"
      "Material/Density = 1\nMaterial 2/Young modulus = 100\n"
      "Material 2/Poisson ratio = 0.499\nMaterial 2/Density = 0.001\n"
      "Boundary conditions/Displacement = bottom: x=0, y=0; left: x=0\n"
      "Boundary conditions/Gravity = "
      "0, -20*if(t < 0.4, (t/0.4)^2*(3-2*t/0.4), 1)\n"
      "Dynamics/Inertia = true\nDynamics/Spectral radius = 0\n"
      "Time/Step size = 0.01\nPostprocess/Reactions = bottom\n"
      "Time/End time = 0.7\n");
    const double               weight = 20 * 0.5 * 0.75;
    const auto                &seen   = test::recorded();
    const std::vector<double> &force  = seen.columns.at(reaction);
    double                     worst  = 0;
    for (unsigned int n = 0; n < force.size(); ++n)
      if (seen.times[n] > 0.5)
        worst = std::max(worst, test::relative(force[n], weight));
    test::check_error("reaction below a gel that a body lands on", worst, 0.02);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_rest("CPDI", "Time/Step size = 0.002\n");
  test_rest("points", "Quadrature/Type = points\nTime/Step size = 0.002\n");
  test_rest("on a one-sided wall",
            "Boundary conditions/Displacement = left: x=0; right: x=0\n"
            "Boundary conditions/Walls = bottom: n>=0\n"
            "Time/Step size = 0.002\n");
  test_rest("adaptive, shorter steps",
            "Grid/Type = adaptive\nGrid/Subdivisions = 4, 5\n"
            "Time/Step size = 0.0005\n");
  test_incompressible("box", "");
  test_incompressible("kept grid", "Grid reset/Steps between resets = 5\n");
  test_standing_wave("Grid/Subdivisions = 16, 20\n");
  test_landing();
  return 0;
}
