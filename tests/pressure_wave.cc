/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The axial mode of a nearly incompressible column between smooth walls has the
// period 4 L sqrt(rho/M), M the modulus of compression between walls: what the
// stabilisation takes for an oscillation must not be the pressure that drives
// its motion. With alpha/G alone the period was 20 % too long with 40 cells at
// nu = 0.4999.

#include "run_scene.h"

using namespace isochor;

namespace
{
  template <int dim>
  void
  test_column(const std::string &what,
              const std::string &scene,
              const double       nu,
              const double       tolerance)
  {
    const double modulus = 3e4 * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    const double exact   = 4 / std::sqrt(modulus / 1000);
    const auto   problem = test::run_scene<dim>(
      "Quadrature/Type = CPDI\nOutput/Terminal = quiet\n" + scene +
      "Material/Young modulus = 3e4\nMaterial/Density = 1000\n"
        "Material/Poisson ratio = " +
      std::to_string(nu) + "\nDynamics/Inertia = true\nTime/Step size = " +
      std::to_string(exact / 90) +
      "\nTime/End time = " + std::to_string(exact) + '\n');
    // after a period the column is where it was, and passes with the velocity
    // of the start
    const double late =
      test::get(*problem, "Displacement y of top (m)") / 1e-4 / exact;
    test::check_error(what + ", nu = " + std::to_string(nu) + ": period",
                      std::abs(late),
                      tolerance);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession  mpi(argc, argv);
  const std::string smooth =
    "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
    "Dynamics/Initial velocity = 0, 1e-4*sin(pi/2*y)\n"
    "Postprocess/Point probes = top: 0.05, 1\n";
  const std::string coarse = smooth + "Grid/Upper corner = 0.1, 1\n"
                                      "Grid/Subdivisions = 2, 20\n",
                    fine   = smooth + "Grid/Upper corner = 0.1, 1\n"
                                      "Grid/Subdivisions = 4, 40\n";
  for (const double nu : {0.499, 0.4999})
    {
      test_column<2>("20 cells", coarse, nu, 0.01);
      test_column<2>("40 cells", fine, nu, 0.003);
    }
  test_column<2>("20 cells, points",
                 coarse + "Quadrature/Type = points\n",
                 0.499,
                 0.01);
  test_column<2>("40 cells, axisymmetric",
                 fine + "Formulation/Geometry = axisymmetric\n",
                 0.4999,
                 0.01);
  test_column<3>(
    "10 cells in space",
    "Grid/Upper corner = 0.1, 1, 0.1\nGrid/Subdivisions = 1, 10, 1\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0; front: z=0; "
    "back: z=0; bottom: y=0\n"
    "Dynamics/Initial velocity = 0, 1e-4*sin(pi/2*y), 0\n"
    "Postprocess/Point probes = top: 0.05, 1, 0.05\n",
    0.4999,
    0.01);
}
