/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// <Grid reset/Steps between resets = auto>, the default: vibrations keep their
// energy with each quadrature, and where resets are needed, or cost nothing,
// the grid is put back in each step.

#include "run_scene.h"

using namespace isochor;

const std::string dynamics = "Dynamics/Inertia = true\n";

/** Nobody has said how often the grid is put back: what a scene loses of its
 * energy within a cycle. */
void
test_loss(const std::string &name, const std::string &settings)
{
  for (const std::string quadrature : {"points"})
    {
      const auto problem =
        test::run_scene<2>("Quadrature/Type = " + quadrature + '\n' + settings);
      // no more than the largest energy
      const double energy = test::largest_in_statistics("Kinetic energy (J)");
      const double lost =
        test::get(*problem, "Energy lost by the scheme (J)") / energy;
      test::check(name + ", " + quadrature + ": energy is kept",
                  std::abs(lost) < 0.01,
                  std::to_string(lost));
      test::check(name + ", " + quadrature + ": no warning",
                  test::all_warnings(*problem).all().empty(),
                  test::all_warnings(*problem).summary());
    }
}

/** Whether the grid is put back in each step of a scene. */
template <int dim>
bool
is_put_back(const std::string &settings)
{
  const auto problem = test::run_scene<dim>(settings);
  return test::work(*problem).row("searches for all points").skipped == 0;
}

/** A block that is pressed, or moves, on a few cells. */
const std::string block =
  "Grid/Upper corner = 1.5, 1\nGrid/Subdivisions = 6, 4\n"
  "Material points/Region = x < 1 && y < 0.8\n"
  "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
  "Time/Step size = 0.02\nTime/End time = 0.1\n";
const std::string held =
  "Boundary conditions/Displacement = bottom: x = 0, y = 0\n"
  "Boundary conditions/Gravity = 5*t, -1\n";

/** What is as with a reset in each step is that to the last bit. */
void
test_same(const std::string &name, const std::string &settings)
{
  std::vector<double> work, volume;
  for (const std::string interval : {"", "1"})
    {
      const auto problem = test::run_scene<2>(
        block + held + settings + "Postprocess/Write energies = always\n" +
        (interval.empty() ?
           std::string() :
           "Grid reset/Steps between resets = " + interval + '\n'));
      work.push_back(test::get(*problem, "External work (J)"));
      volume.push_back(test::get(*problem, "Largest J"));
    }
  test::check(name + ": as with a reset in each step",
              work[0] == work[1] && volume[0] == volume[1],
              std::to_string(work[1] - work[0]));
}

void
test_choice()
{
  const std::string vibrates = block + held + dynamics;
  test::check("a block that vibrates: kept", !is_put_back<2>(vibrates), "");
  test::check("a grid that is stretched: put back",
              is_put_back<2>(vibrates +
                             "Grid/Stretch = x: 0 -> 0, 1.5 -> 0.01*t\n"),
              "");
  test::check("a floor that also pulls: kept",
              !is_put_back<2>(block + dynamics +
                              "Boundary conditions/Gravity = 0, -1\n"
                              "Boundary conditions/Walls = bottom: n = 0\n"),
              "");
  test::check("three dimensions: kept",
              !is_put_back<3>("Grid/Subdivisions = 2, 2, 2\n"
                              "Boundary conditions/Gravity = 0, -1, 0\n"
                              "Time/Step size = 0.1\nTime/End time = 0.3\n" +
                              dynamics),
              "");
}

/** A parameter of kept grids has no effect only where the grid isn't. */
void
test_idle(const std::string &name,
          const std::string &settings,
          const bool         is_idle)
{
  const auto problem = test::run_scene<2>(
    block + held + settings + "Grid reset/Smallest element quality = 0.2\n");
  std::string told;
  for (const auto &warning : test::all_warnings(*problem).all())
    if (warning.subject == "no effect of <Grid reset/Smallest element quality>")
      told = test::one_line(warning.text);
  test::check(name + ": what is said of the quality of cells",
              is_idle ? told.find("auto>, which is 1") != std::string::npos :
                        told.empty(),
              '"' + told + '"');
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_loss("cantilever",
            "Grid/Lower corner = 0, -0.8\nGrid/Upper corner = 1.2, 0.4\n"
            "Grid/Subdivisions = 48, 48\nMaterial points/Points per cell = 4\n"
            "Material points/Region = x < 1 && abs(y) < 0.05\n"
            "Material/Young modulus = 1e7\nMaterial/Poisson ratio = 0.49\n"
            "Material/Density = 1000\n"
            "Boundary conditions/Displacement = left: x = 0, y = 0\n"
            "Boundary conditions/Gravity = 0, -10\n"
            "Time/End time = 0.5\nTime/Step size = 0.01\n" +
              dynamics);
  test_loss("spinning square",
            "Grid/Lower corner = -1, -1\nGrid/Upper corner = 1, 1\n"
            "Grid/Subdivisions = 10, 10\nMaterial points/Points per cell = 4\n"
            "Material points/Region = abs(x) < 0.5 && abs(y) < 0.5\n"
            "Material/Young modulus = 1e5\nMaterial/Poisson ratio = 0.3\n"
            "Dynamics/Initial velocity = -y, x\n"
            "Time/End time = 6.2832\nTime/Step size = 0.12566\n" +
              dynamics);
  test_loss("tube",
            "Grid/Upper corner = 2.8, 2.8\nGrid/Subdivisions = 14, 14\n"
            "Grid/Diagonals = alternating\nMaterial points/Region = "
            "x^2 + y^2 > 1 && x^2 + y^2 < 4\n"
            "Material/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n"
            "Material/Density = 1\n"
            "Boundary conditions/Displacement = left: x = 0; bottom: y = 0\n"
            "Dynamics/Initial velocity = "
            "0.2*x/(x^2 + y^2), 0.2*y/(x^2 + y^2)\n"
            "Time/End time = 4.26\nTime/Step size = 0.0426\n" +
              dynamics);
  for (const std::string quadrature : {"points", "CPDI"})
    test_same("statics, " + quadrature,
              "Quadrature/Type = " + quadrature + '\n');
  test_same("dynamics, CPDI", dynamics + "Quadrature/Type = CPDI\n");
  test_choice();
  test_idle("statics", "", true);
  test_idle("dynamics, CPDI", dynamics + "Quadrature/Type = CPDI\n", true);
  test_idle("dynamics", dynamics, false);
  return 0;
}
