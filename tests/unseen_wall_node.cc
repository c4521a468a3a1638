/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A scene of the fuzzer (seed 576) that crashed: on a kept grid a node at a
// wall that no domain sees any more, since those in its cells see the functions
// of others, where materials meet.

#include "run_scene.h"

using namespace isochor;

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  const auto       problem = test::run_scene<2>(
    "Grid/Upper corner = 2.4, 2.2\nGrid/Subdivisions = 8, 9\n"
          "Grid/Diagonals = alternating\nGrid/Offset = 0.773, 0.487\n"
          "Grid/Shape functions = Q1\nQuadrature/Type = CPDI\n"
          "Formulation/Type = u-p\nFormulation/Stabilisation = none\n"
          "Material points/Points per cell = 12\n"
          "Material points/Region = if(x < 0.7 && y < 1.023 || x > 1.196 && y < "
          "0.550, 1, 0)\nMaterial points/Materials in zones = 2: if(y > 0.2, 1, 0)\n"
          "Material/Model = Mohr-Coulomb\nMaterial/Young modulus = 100\n"
          "Material/Poisson ratio = 0.499\nMaterial/Density = 1\n"
          "Material/Mohr-Coulomb/Cohesion = 1\n"
          "Material/Mohr-Coulomb/Friction angle = 35\n"
          "Material 2/Model = J2\nMaterial 2/Young modulus = 100\n"
          "Material 2/Poisson ratio = 0\nMaterial 2/Density = 1\n"
          "Material 2/J2/Yield stress = 1\n"
          "Dynamics/Inertia = true\nDynamics/Spectral radius = 0.5\n"
          "Boundary conditions/Displacement = left: x=0; bottom: y>=0\n"
          "Boundary conditions/Gravity = 0, -1.735*t\n"
          "Time/Step size = 0.02\nTime/Minimum step size = 0.002\n"
          "Time/Tolerated error = 0.001\nTime/End time = 0.3\n"
          "Grid reset/Steps between resets = 3\n");
  const double volume = test::get(*problem, "Material volume (m^2)");
  test::check("the run ends", volume > 0, std::to_string(volume));
}
