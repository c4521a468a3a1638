/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What is said where points are too far apart for the grid.

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

#include "scene.h"

using namespace isochor;

namespace
{
  /** What is said of a bar of height 1 that is pulled, with points on a
   * lattice. */
  void
  test_sparse_points()
  {
    const auto warned = [](const std::string &spacing,
                           const std::string &quadrature) {
      const auto problem = test::run_scene<2>(
        "Grid/Upper corner = 4, 1.5\nGrid/Subdivisions = 16, 6\n"
        "Material points/Region = y < 1.03\n"
        "Material points/Lattice spacing = " +
        spacing + "\nQuadrature/Type = " + quadrature +
        "\nMaterial/Young modulus = 1000\n"
        "Boundary conditions/Displacement = left: x=0, y=0; right: "
        "x=0.1*t\nTime/Step size = 1\n");
      for (const auto &warning : problem->all_warnings().all())
        if (warning.subject == "material points too far apart for the grid")
          return warning.text;
      return std::string();
    };
    const std::string dense = warned("0.1", "points");
    test::check("no warning for a dense lattice", dense.empty(), dense);
    for (const std::string type : {"points"})
      {
        const std::string sparse = warned("0.17", type);
        test::check("warning for a sparse lattice, " + type,
                    sparse.find("<Lattice spacing>") != std::string::npos &&
                      sparse.find("at t = 0 ") == 0 &&
                      // 0.17² over half of 0.25²
                      sparse.find("has 0.9248 times the volume of its cell") !=
                        std::string::npos,
                    sparse);
      }
    const auto pulled = test::run_scene<2>(
      "Grid/Upper corner = 4, 1.5\nGrid/Subdivisions = 16, 6\n"
      "Material points/Region = x < 2 && y < 1\n"
      "Material points/Lattice spacing = 0.125\nQuadrature/Type = points\n"
      "Material/Young modulus = 0.01\nMaterial/Poisson ratio = 0\n"
      "Material/Density = 1\nDynamics/Inertia = true\n"
      "Dynamics/Initial velocity = 0.75*x, 0\n"
      "Grid reset/Steps between resets = 1\n"
      "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
      "Time/Step size = 0.05\n");
    std::string later;
    for (const auto &warning : pulled->all_warnings().all())
      if (warning.subject == "material points too far apart for the grid")
        later = warning.text;
    test::check("the same at a reset",
                later.find("at t = 0.") == 0 &&
                  later.find("% of its volume, hold no points") !=
                    std::string::npos,
                later);
    std::string message;
    try
      {
        warned("0.6", "points");
      }
    catch (const std::exception &exc)
      {
        message = test::one_line(exc.what());
      }
    test::check("a body that falls apart is an error",
                message.find("falls apart") != std::string::npos,
                message);
    test::check("its pieces",
                message.find("into 14 pieces that share no face, with the "
                             "empty cells 1.") != std::string::npos,
                message);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_sparse_points();
  return 0;
}
