/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Volumes of points in plastic flow. On a grid that is reset material passes
// between domains, so that det F stays near 1, and mass and momentum are what
// they were. On one that is kept rows of cells don't neck by turns.

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** Two bodies of metal, in @p regions, hit each other and part. */
  template <int dim>
  void
  test_impact(const std::string &name,
              const std::string &box,
              const std::string &regions,
              const std::string &velocity,
              const std::string &end)
  {
    const std::string scene = box + "Material points/Region = " + regions +
                              "\nQuadrature/Type = CPDI\n"
                              "Material/Model = J2\n"
                              "Material/Young modulus = 100\n"
                              "Material/Poisson ratio = 0.49\n"
                              "Material/Density = 1\n"
                              "Material/J2/Yield stress = 5\n"
                              "Dynamics/Inertia = true\n"
                              "Dynamics/Initial velocity = " +
                              velocity +
                              "\nNewton/Tolerance = 1e-10\n"
                              "Time/Step size = 0.01\n";
    std::map<std::string, double>  before;
    const std::vector<std::string> columns = {"Mass (kg)",
                                              "Momentum x (kg m/s)",
                                              "Momentum y (kg m/s)"};
    {
      const auto problem =
        test::run_scene<dim>(scene + "Time/End time = 0.01\n");
      for (const std::string &column : columns)
        before[column] = test::get(*problem, column);
    }
    const auto problem = test::run_scene<dim>(scene + "Time/End time = " + end);
    for (const std::string &column : columns)
      test::check_error(name + ", " + column,
                        std::abs(test::get(*problem, column) - before[column]) /
                          before["Mass (kg)"],
                        column == "Mass (kg)" ? 1e-13 : 1e-9);
    test::check_error(name + ", smallest det F",
                      1 - test::get(*problem, "Smallest J"),
                      0.1);
    test::check_error(name + ", largest det F",
                      test::get(*problem, "Largest J") - 1,
                      0.1);
    test::check_error(name + ", plastic work is missing",
                      test::get(*problem, "Plastic work (J)") > 0 ? 0 : 1,
                      0.5);
  }

  /** Simo's round bar, one half of it, pulled by 3.5 mm on a grid that is kept
   * and has more rows of cells than its neck needs. Reference: quadratic finite
   * elements, doc/benchmarks/necking_calculix.py. */
  void
  test_neck_on_kept_grid()
  {
    const auto problem =
      test::run_scene<2>("Grid/Type = trapezoid\n"
                         "Grid/Corners = 0, 0; 6.2975, 0; 6.413, 26.667; "
                         "0, 26.667\n"
                         "Grid/Subdivisions = 8, 128\n"
                         "Grid/Diagonals = alternating\n"
                         "Grid reset/Steps between resets = 0\n"
                         "Formulation/Geometry = axisymmetric\n"
                         "Material/Model = J2\n"
                         "Material/Young modulus = 206900\n"
                         "Material/Poisson ratio = 0.29\n"
                         "Material/J2/Yield stress = 450\n"
                         "Material/J2/Hardening modulus = 129.24\n"
                         "Material/J2/Saturation stress = 715\n"
                         "Material/J2/Saturation exponent = 16.93\n"
                         "Boundary conditions/Displacement = left: x = 0; "
                         "bottom: y = 0; top: x = 0, y = 7*t\n"
                         "Time/Step size = 0.02\nTime/End time = 0.5\n"
                         "Postprocess/Point probes = neck: 6.297, 0\n"
                         "Postprocess/Reactions = bottom\n");
    test::check_error(
      "neck on a kept grid, its displacement",
      std::abs(test::get(*problem, "Displacement x of neck (m)") / -0.847 - 1),
      0.025);
    test::check_error(
      "neck on a kept grid, force",
      std::abs(test::get(*problem, "Reaction y on bottom (N)") / -73.68e3 - 1),
      0.005);
    test::check_error("neck on a kept grid, det F",
                      std::max(1 - test::get(*problem, "Smallest J"),
                               test::get(*problem, "Largest J") - 1),
                      0.025);
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_neck_on_kept_grid();
  test_impact<2>("discs",
                 "Grid/Lower corner = -1, 0\nGrid/Upper corner = 2, 1.5\n"
                 "Grid/Subdivisions = 24, 12\n",
                 "(x+0.1)^2 + (y-0.5)^2 < 0.09 || "
                 "(x-0.9)^2 + (y-0.5)^2 < 0.09",
                 "1 - 1.5*(x > 0.4), 0.2*(x > 0.4)",
                 "0.6");
  test_impact<3>("blocks",
                 "Grid/Lower corner = -1, 0, 0\nGrid/Upper corner = 2, 1, 1\n"
                 "Grid/Subdivisions = 12, 4, 4\n",
                 "y > 0.25 && y < 0.75 && z > 0.25 && z < 0.75 && "
                 "(x > -0.6 && x < 0.1 || x > 0.2 && x < 0.8)",
                 "1 - 1.5*(x > 0.15), 0.1*(x > 0.15), 0",
                 "0.4");
  return 0;
}
