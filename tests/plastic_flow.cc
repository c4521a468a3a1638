/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Small versions of scenes of doc/benchmarks/flow.py, with all defaults:
// volumes of points stay near what they are, and no energy comes from nothing.

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** The smallest value in any step of the scene run last. */
  double
  least(const std::string &column)
  {
    const auto &values = test::recorded().columns.at(column);
    return *std::min_element(values.begin(), values.end());
  }

  double
  most(const std::string &column)
  {
    const auto &values = test::recorded().columns.at(column);
    return *std::max_element(values.begin(), values.end());
  }
} // namespace

/** A copper rod hits a wall. Where old volumes of points are corrected J is
 * 0.03 to 4.3, and 1.2 of 84 J come from nothing. */
void
test_impact()
{
  test::record_columns(
    {"Smallest J", "Largest J", "Energy lost by the scheme (J)"});
  const auto problem = test::run_scene<2>(
    "Grid/Upper corner = 0.008, 0.0128\nGrid/Subdivisions = 20, 32\n"
    "Material points/Region = x < 0.0032 && y < 0.012\n"
    "Formulation/Type = u-p\nFormulation/Geometry = axisymmetric\n"
    "Quadrature/Type = CPDI\nMaterial points/Points per cell = 4\n"
    "Material/Model = J2\nMaterial/Young modulus = 117e9\n"
    "Material/Poisson ratio = 0.35\nMaterial/Density = 8930\n"
    "Material/J2/Yield stress = 400e6\n"
    "Material/J2/Hardening modulus = 100e6\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
    "Dynamics/Inertia = true\nDynamics/Initial velocity = 0, -227\n"
    "Time/End time = 14e-6\nTime/Step size = 0.4e-6\n"
    "Postprocess/Write energies = always\n");
  test::check("J of an impact",
              least("Smallest J") > 0.75 && most("Largest J") < 1.35,
              std::to_string(least("Smallest J")) + " ... " +
                std::to_string(most("Largest J")));
  test::check("no energy from nothing",
              least("Energy lost by the scheme (J)") > -0.005 * 84,
              std::to_string(least("Energy lost by the scheme (J)")));
}

/** A column of weak clay slumps under its weight. With cells of half the size
 * its crest comes down by 0.485 m; where old volumes are corrected the run ends
 * with an error at t = 0.35. */
void
test_slump()
{
  test::record_columns({});
  const auto problem = test::run_scene<2>(
    "Grid/Upper corner = 3.5, 1.2\nGrid/Subdivisions = 35, 12\n"
    "Material points/Region = x < 1 && y < 1\n"
    "Material points/Points per cell = 4\nFormulation/Type = u-p\n"
    "Quadrature/Type = cell-filled\nMaterial/Model = Mohr-Coulomb\n"
    "Material/Young modulus = 500\nMaterial/Poisson ratio = 0.49\n"
    "Material/Density = 1\nMaterial/Mohr-Coulomb/Cohesion = 0.7\n"
    "Boundary conditions/Displacement = left: x=0; bottom: x=0, y=0\n"
    "Boundary conditions/Gravity = 0, -10\nDynamics/Inertia = true\n"
    "Time/End time = 1.5\nTime/Step size = 0.005\n"
    "Postprocess/Point probes = crest: 0, 0.99\n");
  test::check_error(
    "crest of a column that slumps",
    std::abs(test::get(*problem, "Displacement y of crest (m)") + 0.485),
    0.01);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_impact();
  test_slump();
}
