/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Statics: the warning of elastic bodies that drift under loads that come and
// go, as the grid is put back again and again.

#include <filesystem>

#include "scene_messages.h"

using namespace isochor;

namespace
{
  /** A nearly incompressible cantilever, 4 m x 1 m. */
  const std::string cantilever =
    "Grid/Lower corner = 0, -2\n"
    "Grid/Upper corner = 4.5, 3.2\n"
    "Grid/Subdivisions = 27, 31\n"
    "Material points/Region = if(x < 4 && y > 0 && y < 1, 1, 0)\n"
    "Formulation/Type = u-p\n"
    "Material/Young modulus = 1000\n"
    "Material/Poisson ratio = 0.499\n"
    "Material/Density = 1\n"
    "Time/Step size = 0.1\n";
  const std::string clamp = "Boundary conditions/Displacement = "
                            "left: x=0, y=0\n",
                    up_and_down =
                      "Boundary conditions/Gravity = 0, 3*sin(2*pi*t)\n";
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  std::filesystem::create_directory("scene_checks");

  const std::string cycles =
    cantilever + clamp + up_and_down + "Time/End time = 4\n";
  expect("up and down, CPDI",
         messages<2>(cycles, false),
         {"WARNING energy balance", "<Grid reset/Steps between resets>"});
  expect("up and down, grid that stays with the body",
         messages<2>(cycles + "Grid reset/Steps between resets = 0\n"
                              "Grid reset/Smallest element quality = 0\n",
                     false),
         {});
  expect("nobody looks",
         messages<2>(cycles + "Postprocess/Write energies = never\n", false),
         {});

  // loads that only grow, in 30 steps
  const std::string growing = cantilever + "Time/End time = 3\n";
  expect("weight that grows",
         messages<2>(growing + clamp +
                       "Boundary conditions/Gravity = 0, -2*t\n",
                     false),
         {});
  // of whose surface a part lies in cells that the body fills in part
  expect("end that is moved",
         messages<2>(growing +
                       "Boundary conditions/Surfaces of body = "
                       "end: if(x > 3.99, 1, 0)\n"
                       "Interaction: end - place/Displacement = y = -0.5*t\n" +
                       clamp,
                     false),
         {});
  return 0;
}
