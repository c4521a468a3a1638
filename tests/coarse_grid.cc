/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A run says at its end if cells were too large for what the body did.

#include "run_scene.h"

using namespace isochor;

namespace
{
  std::string
  beam(const unsigned int n_cells)
  {
    std::ostringstream scene;
    scene << "Grid/Lower corner = 0, -0.3\nGrid/Upper corner = 1.1, 0.2\n"
          << "Grid/Subdivisions = " << 11 * n_cells << ", " << 5 * n_cells
          << "\nMaterial points/Region = x < 1 && y > 0 && y < 0.1\n"
             "Material/Young modulus = 5e6\nMaterial/Poisson ratio = 0.499\n"
             "Boundary conditions/Displacement = left: x=0, y=0\n";
    return scene.str();
  }



  void
  test_beam(const unsigned int n_cells,
            const std::string &history,
            const bool         is_coarse)
  {
    const auto problem = test::run_scene<2>(
      beam(n_cells) + "Boundary conditions/Gravity = 0, -9.81*" + history +
      "\nTime/Step size = 0.5\n");
    const std::string told = test::warning_of(*problem, "coarse grid");
    test::check(std::to_string(n_cells) + " cells over the height of a beam, " +
                  history,
                told.empty() != is_coarse &&
                  (told.empty() || told.find("up to t = 1 ") == 0),
                told);
  }



  /** The beam swings for half of its period, so that it ends where it hardly
   * moves, or for a whole one, so that its stresses end near zero. */
  void
  test_vibration(const unsigned int n_cells,
                 const double       end,
                 const bool         is_coarse)
  {
    const auto problem =
      test::run_scene<2>(beam(n_cells) +
                         "Dynamics/Inertia = true\n"
                         "Boundary conditions/Gravity = 0, -1\n"
                         "Time/Step size = 0.02\nTime/End time = " +
                         std::to_string(end) + "\n");
    const std::string told = test::warning_of(*problem, "coarse grid");
    test::check(std::to_string(n_cells) + " cells over the height of a beam " +
                  "that swings until t = " + std::to_string(end),
                told.empty() != is_coarse &&
                  (told.empty() || told.find("up to t = ") == 0),
                told);
  }



  /** Two discs that bounce, ten cells across: their stresses are wrong by 57 %
   * in the mean, but they fly rightly, with more energy than they store. */
  void
  test_impact()
  {
    const auto problem = test::run_scene<2>(
      "Grid/Lower corner = -1, 0\nGrid/Upper corner = 2, 1\n"
      "Grid/Subdivisions = 48, 16\nMaterial points/Points per cell = 4\n"
      "Material points/Region = (x+0.1)^2 + (y-0.5)^2 < 0.09 || (x-0.9)^2 + "
      "(y-0.5)^2 < 0.09\nMaterial/Density = 1\n"
      "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.3\n"
      "Formulation/Type = u\nQuadrature/Type = CPDI\n"
      "Dynamics/Inertia = true\n"
      "Dynamics/Initial velocity = 1 - 2*(x > 0.4), 0\n"
      "Time/Step size = 0.01\nTime/End time = 0.5\n");
    const std::string told = test::warning_of(*problem, "coarse grid");
    test::check("two discs that bounce", told.empty(), told);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_beam(1, "t", true);
  test_beam(2, "t", true);
  test_beam(4, "t", false);
  // what is left without load isn't what was computed
  test_beam(1, "t*(1-t)", false);
  test_vibration(2, 0.4, true);
  test_vibration(2, 0.8, true);
  test_vibration(6, 0.4, false);
  test_vibration(6, 0.8, false);
  test_impact();
  return 0;
}
