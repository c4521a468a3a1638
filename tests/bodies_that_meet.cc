/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Bodies are one where they have nodes of the grid in common: told once they
// come to that, on any number of ranks.

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** What is told of a block that lies on the ground, 1 m high, and another one
   * 1 m above it that comes down with 1 m/s, in cells of 0.25 m. */
  std::string
  told_of(const std::string &settings)
  {
    const auto problem = test::run_scene<2>(
      "Grid/Upper corner = 1, 4\nGrid/Subdivisions = 4, 16\n"
      "Material points/Region = y < 1 || (y > 2 && y < 3)\n"
      "Material/Young modulus = 1e4\nMaterial/Density = 1\n"
      "Formulation/Type = u\nDynamics/Inertia = true\n"
      "Dynamics/Initial velocity = 0, if(y > 1.5, -1, 0)\n"
      "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
      "Quadrature/Type = points\n"
      "Grid reset/Steps between resets = 1\nTime/Step size = 0.1\nTime/End time = 1\n" +
      settings);
    return test::warning_of(*problem, "bodies in one field");
  }

  void
  test_message(const std::string &settings, const std::string &begin)
  {
    const std::string told = told_of(settings);
    test::check("told: '" + begin + "', " + settings,
                begin.empty() ? told.empty() : told.find(begin) == 0,
                told);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  // the lower side is in the row of cells above the lower block from 0.8 s on
  const std::string two = "at t = 0.8 bodies have come to share nodes";
  test_message("", two);
  test_message("Quadrature/Type = points", two);
  test_message("Time/End time = 0.7", "");
  test_message("Grid reset/Steps between resets = 0",
               "2 bodies share no node of a grid that is not reset");
  test_message("Material points/Region = y > 2 && y < 3", "");
  test_message("Material points/Region = y < 1 || (y > 2 && y < 2.5) || "
               "(y > 3 && y < 3.5)",
               two);
  return 0;
}
