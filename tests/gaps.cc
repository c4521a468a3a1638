/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A gap between points that is a part of a few cells when they are seeded, and
// many cells when the grid, which moves, has brought smaller ones: it is
// integrated all the same, whether points are split or not. Counted as outside
// of the body it closes, and load and volume are lost without a word.

#include <array>

#include "run_scene.h"

using namespace isochor;

namespace
{
  struct Result
  {
    double force, volume;
  };

  /** A block under tension. The rows of cells in its lower half become ten
   * times (3D: 2.5 times) flatter. Points of @p region are left out. */
  template <int dim>
  Result
  stretched_block(const std::string &region, const std::string &split)
  {
    const bool        solid   = (dim == 3);
    const std::string n       = solid ? "3" : "4";
    const auto        problem = test::run_scene<dim>(
      "Grid/Subdivisions = " + n + ", " + n + (solid ? ", " + n : "") +
      "\nGrid/Stretch = y: 0 -> 0, 0.5 -> -" + (solid ? "0.3" : "0.45") +
      "*min(1, t/0.75), 1 -> 0.2*t\n"
             "Material/Young modulus = 100\nMaterial/Density = 0\n"
             "Material/Poisson ratio = 0.3\n"
             "Material points/Region = " +
      region + "\nMaterial points/Split at share of cell = " + split +
      "\nQuadrature/Type = cell-filled\nFormulation/Type = u-p\n"
             "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0; "
             "top: y=0.2*t" +
      (solid ? "; front: z=0; back: z=0" : "") +
      "\nPostprocess/Reactions = top\nTime/Step size = 0.25\n");
    const Statistics &statistics = test::last_statistics(*problem);
    return {statistics.get("Reaction y on top (N)"),
            statistics.get("Volume in the grid " +
                           std::string(solid ? "(m^3)" : "(m^2)"))};
  }

  template <int dim>
  void
  test_gap(const std::string &outside_of, const std::string &split)
  {
    const std::string what =
      "dim " + std::to_string(dim) + ", split at " + split;
    const Result whole = stretched_block<dim>("1", "0"),
                 gap   = stretched_block<dim>(outside_of, split);
    // of the grid in which the last step was made, at t = 0.75
    test::check_error(what + ": volume", std::abs(gap.volume - 1.15), 1e-12);
    test::check_error(what + ": force",
                      std::abs(gap.force / whole.force - 1),
                      1e-9);
  }

  /** A cavity that the body has from the start stays empty, also where points,
   * which are as large as the cells here, are split. */
  void
  test_own_cavity()
  {
    std::array<double, 2> force;
    for (unsigned int split = 0; split < 2; ++split)
      {
        const auto problem = test::run_scene<2>(
          "Grid/Subdivisions = 8, 8\n"
          "Material points/Region = abs(x - 0.5) > 0.12 || abs(y - 0.5) > "
          "0.12\nMaterial points/Points per cell = 1\n"
          "Material points/Split at share of cell = " +
          std::string(split != 0 ? "0.5" : "0") +
          "\nMaterial/Young modulus = 100\nMaterial/Density = 0\n"
          "Quadrature/Type = cell-filled\n"
          "Boundary conditions/Displacement = bottom: x=0, y=0; top: x=0, "
          "y=-0.02*t\nPostprocess/Reactions = top\nTime/Step size = 0.5\n");
        force[split] = test::get(*problem, "Reaction y on top (N)");
      }
    test::check_error("the body's own cavity stays empty",
                      std::abs(force[1] / force[0] - 1),
                      0.01);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const std::string split : {"0", "0.5"})
    {
      test_gap<2>("(x - 0.5)^2 + (y - 0.15)^2 > 0.12^2", split);
      test_gap<3>("(x - 0.5)^2 + (y - 0.2)^2 + (z - 0.5)^2 > 0.13^2", split);
    }
  test_own_cavity();
  return 0;
}
