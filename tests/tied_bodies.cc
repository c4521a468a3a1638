/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Bodies with less than a cell between them are tied to each other by the nodes
// they share: told at the start, on any number of ranks, where points have
// domains, which say what belongs together.

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** What is told at the start of what fills @p region, in cells of 0.05 m. */
  std::string
  told_of(const std::string &region, const std::string &settings)
  {
    const auto problem = test::run_scene<2>(
      "Grid/Upper corner = 0.2, 1\nGrid/Subdivisions = 4, 20\n"
      "Material points/Lattice spacing = 0.0125\n"
      "Material points/Region = " +
      region +
      "\nMaterial/Young modulus = 1e6\nMaterial/Poisson ratio = 0\n"
      "Formulation/Type = u\n"
      "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
      "Boundary conditions/Gravity = 0, -1e-3*t\n"
      "Dynamics/Inertia = true\nQuadrature/Type = CPDI\n"
      "Time/Step size = 0.01\nTime/End time = 0.01\n" +
      settings);
    return test::warning_of(*problem, "bodies that are one");
  }

  void
  test_message(const std::string &what,
               const std::string &region,
               const std::string &numbers,
               const std::string &settings = "")
  {
    const std::string told = told_of(region, settings);
    test::check(what,
                numbers.empty() ? told.empty() :
                                  told.find(numbers) != std::string::npos,
                told);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession  mpi(argc, argv);
  const std::string half = "y < 0.4 || (y > 0.425 && y < 0.8)";
  test_message("half a cell between two", half, "has 2 parts");
  test_message("the nodes they share",
               half,
               "they are as one body, as 5 nodes of the grid belong to "
               "several, one of them at (0 0.4)");
  test_message("half a cell, cell-filled + boundary",
               half,
               "has 2 parts",
               "Quadrature/Type = cell-filled + boundary\n");
  test_message("points that are split before the first step",
               half,
               "has 2 parts",
               "Material points/Lattice spacing = 0.025\n"
               "Material points/Split at share of cell = 0.2\n");
  test_message("points have no domains",
               half,
               "",
               "Quadrature/Type = points\n");
  test_message("two of three are tied",
               "y < 0.2 || (y > 0.225 && y < 0.4) || (y > 0.6 && y < 0.8)",
               "they are as 2 bodies");
  test_message("two cells between them", "y < 0.4 || (y > 0.5 && y < 0.8)", "");
  test_message("one body", "y < 0.8", "");
  test_message("a disc",
               "(x - 0.1)^2 + (y - 0.3)^2 < 0.09^2",
               "",
               "Material points/Lattice spacing = 0\n");
}
