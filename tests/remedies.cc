/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Each warning in a scene that deserves it, and the same scene with the remedy
// that the warning names: it runs, and the warning is gone.

#include <isochor/base/explanation.h>

#include <filesystem>
#include <set>

#include "scene_messages.h"

namespace
{
  struct Case
  {
    std::string warning, scene, remedy;
    /** The warning comes before the first step. */
    bool at_start = false;
  };

  /** What all scenes have, if they don't say otherwise. */
  const std::string common = "Time/Step size = 1\n";

  const std::vector<Case> cases = {
    {"a body in part outside of the grid",
     "Grid/Subdivisions = 4, 4\n"
     "Boundary conditions/Displacement = left: x=0; bottom: y=0; right: x=0.03*t\n"
     "Time/Step size = 0.1\n",
     "Grid/Stretch = x: 0 -> 0, 1 -> 0.03*t\n"},
    {"a body smaller than a cell",
     "Grid/Upper corner = 10, 10\n"
     "Grid/Subdivisions = 4, 4\n"
     "Material points/Lattice spacing = 0.02\n"
     "Material points/Region = x < 0.06 && y < 0.06\n"
     "Boundary conditions/Displacement = bottom: x = 0, y = 0\n",
     "Grid/Upper corner = 0.1, 0.1\n",
     true},
    {"a boundary that leaves the body behind",
     "Grid/Subdivisions = 4, 4\n"
     "Boundary conditions/Displacement = left: x=0; bottom: y=0; top: y=-0.06*t\n"
     "Time/Step size = 0.25\n",
     "Grid/Stretch = y: 0 -> 0, 1 -> -0.06*t\n"},
    {"a condition that compares nothing",
     good + "Material points/Region = y\n",
     "Material points/Region = y < 0.5\n",
     true},
    {"a load on a support",
     good + "Boundary conditions/Traction = bottom: 0, -1e4*t\n",
     "Boundary conditions/Traction = top: 0, -1e4*t\n"},
    {"a part of the body too thin for the grid",
     "Grid/Lower corner = 0, -1\n"
     "Grid/Upper corner = 1.25, 0.5\n"
     "Grid/Subdivisions = 10, 12\n"
     "Material points/Region = x < 1 && y > 0 && y < 0.125\n"
     "Material points/Points per cell = 1\n"
     "Material/Density = 1000\n"
     "Material/Young modulus = 1e7\n"
     "Material/Poisson ratio = 0.499\n"
     "Boundary conditions/Displacement = left: x=0, y=0\n"
     "Boundary conditions/Gravity = 0, -1*t\n"
     "Time/Step size = 0.5\n",
     "Grid/Subdivisions = 40, 48\n"},
    {"a region that is finer than the points",
     "Grid/Subdivisions = 8, 8\n"
     "Material points/Region = abs(x - 0.51) > 0.004\n"
     "Boundary conditions/Displacement = bottom: x = 0, y = 0\n"
     "Boundary conditions/Gravity = 0, -1\n",
     "Grid/Subdivisions = 250, 2\n",
     true},
    {"bodies in one field",
     "Grid/Upper corner = 1, 2.25\n"
     "Grid/Subdivisions = 4, 9\n"
     "Quadrature/Type = points\n"
     "Material points/Region = y < 1 || y > 1.25\n"
     "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0; top: y=-0.3*t\n"
     "Time/Step size = 0.1\n",
     "Quadrature/Type = CPDI\n"
     "Material points/Bodies = lower: y < 1.1; upper: y > 1.1\n"
     "Interaction: lower - upper/Law = unilateral\n"
     "Grid/Upper corner = 1, 2.5\n"
     "Grid/Subdivisions = 4, 10\n"
     "Material points/Region = y < 1 || (y > 1.25 && y < 2.25)\n"
     "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
     "Boundary conditions/Surfaces of body = roof: y > 2.24\n"
     "Interaction: roof - place/Displacement = y=-0.3*t\n"},
    {"coarse grid",
     "Grid/Upper corner = 1.25, 0.5\n"
     "Grid/Lower corner = 0, -0.5\n"
     "Grid/Subdivisions = 10, 8\n"
     "Material points/Region = x < 1 && abs(y) < 0.125\n"
     "Boundary conditions/Displacement = left: x=0, y=0\n"
     "Boundary conditions/Gravity = 0, -1\n",
     "Grid/Subdivisions = 40, 32\n"
     "Grid/Shape functions = Q1\n"},
    {"contradictory conditions",
     good + "Boundary conditions/Walls = left: n = 0.1*t\n"
            "Boundary conditions/Displacement = left: x=0; bottom: y=0\n",
     "Boundary conditions/Displacement = bottom: y=0\n",
     true},
    {"domains longer than the cells",
     "Grid/Upper corner = 4, 1.25\n"
     "Grid/Subdivisions = 16, 5\n"
     "Material points/Region = x < 1 && y < 1\n"
     "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
     "Boundary conditions/Surfaces of body = end: x > 0.99\n"
     "Interaction: end - place/Displacement = x=2.5*t\n"
     "Time/Step size = 0.05\n",
     "Material points/Split at share of cell = 0.1\n"},
    {"domains that don't fit together",
     good + "Material points/Points per cell in zones = 9: y > 0.5\n",
     "Material points/Points per cell in zones = 12: y > 0.5\n",
     true},
    {"doubtful units",
     good + "Material/Model = Mohr-Coulomb\n"
            "Material/Mohr-Coulomb/Cohesion = 1e3\n"
            "Material/Mohr-Coulomb/Friction angle = 0.52\n",
     "Material/Mohr-Coulomb/Friction angle = 30\n",
     true},
    {"energy balance",
     "Grid/Lower corner = 0, -0.8\n"
     "Grid/Upper corner = 1.2, 0.4\n"
     "Grid/Subdivisions = 24, 24\n"
     "Quadrature/Type = points\n"
     "Grid reset/Steps between resets = 1\n"
     "Material points/Region = x < 1 && abs(y) < 0.05\n"
     "Material/Young modulus = 1e7\n"
     "Material/Poisson ratio = 0.3\n"
     "Boundary conditions/Displacement = left: x=0, y=0\n"
     "Boundary conditions/Gravity = 0, -10\n"
     "Dynamics/Inertia = true\n"
     "Time/Step size = 0.01\n"
     "Time/End time = 0.6\n",
     "Grid reset/Steps between resets = 0\n"
     "Grid reset/Smallest element quality = 0\n"},
    {"grid at its maximum level",
     "Grid/Type = adaptive\n"
     "Grid/Subdivisions = 2, 2\n"
     "Adaptive grid/Maximum level = 1\n"
     "Adaptive grid/Target of relative error = 0.02\n"
     "Boundary conditions/Displacement = bottom: x=0, y=0\n"
     "Boundary conditions/Surfaces of body = roof: y > 0.99\n"
     "Interaction: roof - place/Displacement = x=0.01*t, y=0\n",
     "Adaptive grid/Target of relative error = 0.5\n"},
    {"limit load",
     "Grid/Upper corner = 1.5, 1.25\n"
     "Grid/Subdivisions = 6, 5\n"
     "Material points/Region = x < 1 && y < 1\n"
     "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
     "Boundary conditions/Surfaces of body = roof: y > 0.99\n"
     "Boundary conditions/Traction on body = roof: 0, -2500*t\n"
     "Material/Model = Mohr-Coulomb\n"
     "Material/Mohr-Coulomb/Cohesion = 1e3\n"
     "Material/Mohr-Coulomb/Friction angle = 0\n"
     "Time/Step size = 0.02\n",
     "Boundary conditions/Traction on body =\n"
     "Interaction: roof - place/Displacement = y=-0.01*t\n"},
    {"material points too far apart for the grid",
     "Grid/Upper corner = 4, 1.5\n"
     "Grid/Subdivisions = 16, 6\n"
     "Quadrature/Type = points\n"
     "Material points/Region = y < 1.03\n"
     "Material points/Lattice spacing = 0.17\n"
     "Boundary conditions/Displacement = left: x=0, y=0\n",
     "Material points/Lattice spacing = 0.1\n",
     true},
    {"material interface within cells",
     "Grid/Subdivisions = 5, 5\n"
     "Quadrature/Type = points\n"
     "Material points/Lattice spacing = 0.05\n"
     "Material points/Materials in zones = 2: y > 0.5\n"
     "Material 2/Young modulus = 1e8\n"
     "Boundary conditions/Displacement = bottom: x=0, y=0\n",
     "Quadrature/Type = CPDI\n",
     true},
    {"no effect of <Formulation/PPP coefficient>",
     good + "Formulation/Type = u\n"
            "Formulation/PPP coefficient = 8\n",
     "Formulation/PPP coefficient = 1\n",
     true},
    {"no material at <top> of <Boundary conditions/Displacement>",
     good + "Material points/Region = y < 0.5\n"
            "Boundary conditions/Displacement = bottom: x=0, y=0; top: y=0\n",
     "Boundary conditions/Displacement = bottom: x=0, y=0\n",
     true},
    {"nothing loads the scene",
     "Grid/Subdivisions = 4, 4\n"
     "Boundary conditions/Displacement = bottom: x=0, y=0\n",
     "Boundary conditions/Gravity = 0, -1\n"},
    {"parts of one body in contact",
     "Grid/Lower corner = -0.2, -0.2\nGrid/Upper corner = 2.4, 1.2\n"
     "Grid/Subdivisions = 26, 14\nMaterial points/Region = x > 0 && x < 2 && y "
     "> 0 && y < 1 && (x < 0.3 || y < 0.3 || y > 0.7)\n"
     "Material/Young modulus = 1000\nTime/Step size = 0.05\n"
     "Boundary conditions/Surfaces of body = top: y > 0.9999 && x > 1.7; low: "
     "y < 0.0001\n"
     "Interaction: low - place/Displacement = x=0, y=0\n"
     "Interaction: top - place/Displacement = y=-0.4*t\n",
     "Material points/Bodies = web: x < 0.3; lower: x > 0.3 && y < 0.5; upper: "
     "x > 0.3 && y > 0.5\n"},
    {"rigid-body mode",
     "Grid/Subdivisions = 4, 4\n"
     "Boundary conditions/Gravity = 0, -1\n",
     "Dynamics/Inertia = true\n",
     true},
    {"rounded to the points",
     good + "Material points/Region = y < 0.6\n"
            "Quadrature/Type = points\n",
     "Quadrature/Type = CPDI\n",
     true},
    {"surface in part off the body",
     "Grid/Subdivisions = 8, 8\n"
     "Material points/Region = x*x+y*y > 0.16\n"
     "Quadrature/Type = points\n"
     "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
     "Boundary conditions/Surfaces of body = bore: x*x+y*y < 0.25\n"
     "Boundary conditions/Pressure on body = bore: 1e3*t\n",
     "Quadrature/Type = CPDI\n",
     true},
    {"the iterative linear solver failed",
     "Grid/Subdivisions = 8, 8\n"
     "Material/Poisson ratio = 0.4999\n"
     "Boundary conditions/Displacement = bottom: x=0, y=0\n"
     "Boundary conditions/Gravity = 0, -1\n"
     "Linear solver/Solver = Block FGMRES\n"
     "Linear solver/Block FGMRES/Maximum iterations = 2\n",
     "Linear solver/Block FGMRES/Maximum iterations = 500\n"},
    {"the smallest step is too large",
     "Grid/Subdivisions = 4, 4\n"
     "Material points/Region = y < 0.5\n"
     "Grid/Upper corner = 1, 2\n"
     "Grid/Subdivisions = 4, 8\n"
     "Boundary conditions/Displacement = bottom: y=0\n"
     "Boundary conditions/Gravity = 0, -10\n"
     "Material/Young modulus = 1e5\n"
     "Dynamics/Inertia = true\n"
     "Time/Tolerated error = 1e-6\n"
     "Time/Step size = 0.02\n"
     "Time/Minimum step size = 0.02\n"
     "Time/End time = 0.1\n",
     "Time/Minimum step size = 1e-6\n"},
    {"undetermined pressure",
     "Grid/Subdivisions = 4, 4\n"
     "Material/Poisson ratio = 0.5\n"
     "Material/Density = 1\n"
     "Boundary conditions/Gravity = 0, -t\n"
     "Boundary conditions/Displacement = left: x=0, y=0; right: x=0, y=0; bottom: x=0, y=0; top: x=0, y=0\n",
     "Boundary conditions/Displacement = left: x=0, y=0; right: x=0, y=0; bottom: x=0, y=0\n",
     true},
    {"unstable equilibrium",
     "Grid/Lower corner = 0, -0.5\n"
     "Grid/Upper corner = 1.125, 0.5\n"
     "Grid/Subdivisions = 18, 16\n"
     "Material points/Region = x < 1 && abs(y) < 0.0625\n"
     "Boundary conditions/Displacement = left: x=0, y=0\n"
     "Boundary conditions/Surfaces of body = end: x > 0.99\n"
     "Boundary conditions/Traction on body = end: -1e4*t, 0\n"
     "Time/Step size = 0.25\n",
     "Boundary conditions/Traction on body = end: -1e4*t, 1e2*t\n"
     "Dynamics/Inertia = true\n"
     "Time/Step size = 0.01\n"},
    {"volume drift",
     "Grid/Subdivisions = 8, 8\n"
     "Grid reset/Steps between resets = 0\n"
     "Material/Poisson ratio = 0.499\n"
     "Material points/Points per cell = 1\n"
     "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
     "Boundary conditions/Surfaces of body = plate: y > 0.99 && x < 0.5\n"
     "Interaction: plate - place/Displacement = x=0, y=-0.28*t\n"
     "Time/Step size = 0.125\n",
     "Grid/Subdivisions = 32, 32\n"},
    {"volumetric locking",
     good + "Formulation/Type = u\n"
            "Material/Poisson ratio = 0.49\n",
     "Formulation/Type = u-p\n",
     true}};

  void
  test_case(const Case &one)
  {
    const std::string warning = "WARNING " + one.warning + " | ";
    const std::string before  = messages<2>(common + one.scene, one.at_start);
    const std::string after =
      messages<2>(common + one.scene + one.remedy, one.at_start);
    test::check(one.warning,
                before.find(warning) != std::string::npos &&
                  before.find("ERROR") == std::string::npos &&
                  after.find(warning) == std::string::npos &&
                  after.find("ERROR") == std::string::npos,
                "before: " + before + "after: " + after);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  std::filesystem::create_directory("scene_checks");
  std::set<std::string> tried;
  for (const Case &one : cases)
    {
      test_case(one);
      tried.insert(find_explanation(one.warning)->name);
    }
  std::string others;
  for (const Explanation &one : all_explanations())
    if (tried.count(one.name) == 0)
      others += " " + one.name + ";";
  std::cout << "Not tried:" << others << std::endl;
  return 0;
}
