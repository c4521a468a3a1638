/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A body that is drawn out of the grid by its load, across a boundary that
// nothing holds, between walls: the area doesn't change, so that the stress
// along the load is the load.

#include <array>
#include <string>

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::array<std::string, 6> names = {
    {"left", "right", "bottom", "top", "front", "back"}};

  /** The load acts on side @p free, all others are held across. */
  template <int dim>
  void
  test_side(const unsigned int free,
            const std::string &form,
            const std::string &poisson_ratio,
            const double       load,
            const std::string &settings)
  {
    const unsigned int axis     = free / 2;
    const bool         is_upper = free % 2 == 1;
    const std::string  component(1, "xyz"[axis]);
    std::string        walls, zeros = (dim == 2 ? "0, 0" : "0, 0, 0");
    for (unsigned int side = 0; side < 2 * dim; ++side)
      if (side != free)
        walls += (walls.empty() ? "" : "; ") + names[side] + ": " +
                 "xyz"[side / 2] + "=0";
    std::string traction;
    for (unsigned int a = 0; a < dim; ++a)
      traction += (a > 0 ? ", " : "") +
                  (a == axis ? test::in_short(is_upper ? load : -load) + "*t" :
                               std::string("0"));
    const auto problem = test::run_scene<dim>(
      "Quadrature/Type = CPDI\nGrid/Lower corner = " + zeros +
      "\nGrid/Upper corner = " + (dim == 2 ? "1, 1" : "1, 1, 1") +
      "\nGrid/Subdivisions = " + (dim == 2 ? "4, 4" : "4, 4, 4") +
      "\nFormulation/Type = " + form +
      "\nMaterial/Young modulus = 1e6\nMaterial/Poisson ratio = " +
      poisson_ratio + "\nTime/Step size = 0.25\n" +
      "Boundary conditions/Displacement = " + walls +
      "\nBoundary conditions/Surfaces of body = end: " + component +
      (is_upper ? " > 0.9999" : " < 0.0001") +
      "\nBoundary conditions/Traction on body = end: " + traction +
      "\nPostprocess/Exact stress = " + component + component + ": " +
      test::in_short(load) + "*t\n" + settings);
    test::check_error(std::to_string(dim) + "D, " + names[free] + ", " + form +
                        ", " + settings.substr(0, settings.find('\n')),
                      test::get(*problem,
                                "L2 error of stress " + component + component),
                      1e-6);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (unsigned int side = 0; side < 4; ++side)
    for (const std::string diagonals : {"/", "backslash", "alternating"})
      {
        const std::string grid = "Grid/Diagonals = " + diagonals + '\n';
        test_side<2>(side, "u", "0.3", 4e4, grid);
        test_side<2>(side, "u-p", "0.49", 5e5, grid);
      }
  for (const unsigned int side : {1, 2, 5})
    test_side<3>(side, "u", "0.3", 4e4, "Grid/Diagonals = alternating\n");
  return 0;
}
