/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A run says at its end if cells were too large for what the body did.

#include "run_scene.h"

using namespace isochor;

namespace
{
  void
  test_beam(const unsigned int n_cells,
            const std::string &history,
            const bool         is_coarse)
  {
    std::ostringstream scene;
    scene << "Grid/Lower corner = 0, -0.3\nGrid/Upper corner = 1.1, 0.2\n"
          << "Grid/Subdivisions = " << 11 * n_cells << ", " << 5 * n_cells
          << "\nMaterial points/Region = x < 1 && y > 0 && y < 0.1\n"
             "Material/Young modulus = 5e6\nMaterial/Poisson ratio = 0.499\n"
             "Boundary conditions/Displacement = left: x=0, y=0\n"
             "Boundary conditions/Gravity = 0, -9.81*"
          << history << "\nTime/Step size = 0.5\n";
    const auto        problem = test::run_scene<2>(scene.str());
    const std::string told =
      test::warning_of(*problem, "a grid that is too coarse");
    test::check(std::to_string(n_cells) + " cells over the height of a beam, " +
                  history,
                told.empty() != is_coarse &&
                  (told.empty() || told.find("At t = 1 s") == 0 ||
                   told.find("At t = 1 ") == 0),
                told);
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
}
