/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Bodies in space whose points come to other cells and ranks by the thousand,
// and ranks that have no points: all is as on one rank.

#include "ranks_alike.h"

/** A block in a larger box, pressed and sheared, in which points come to other
 * cells and ranks by the thousand. */
void
test_crossings(const std::string &name, const std::string &settings)
{
  compare_results<3>(
    "3D, sheared, " + name,
    "Grid/Type = box\nGrid/Lower corner = -0.25, 0, -0.25\n"
    "Grid/Upper corner = 1.25, 1, 1.25\nGrid/Subdivisions = 9, 6, 9\n"
    "Material points/Region = (x > 0) * (x < 1) * (z > 0) * (z < 1)\n"
    "Material/Young modulus = 1000\nMaterial/Poisson ratio = 0.49\n"
    "Boundary conditions/Displacement = bottom: x=0, y=0, z=0; "
    "top: x=0.2*t, y=-0.02*t, z=0.1*t\n"
    "Postprocess/Reactions = top\n"
    "Postprocess/Write energies = always\n"
    "Time/End time = 1\nTime/Step size = 0.2\n" +
      settings,
    {"Reaction x on top (N)", "Reaction y on top (N)", "Strain energy (J)"});
  test::check("thousands of points come to another cell",
              shares.n_crossings > 2000,
              std::to_string(shares.n_crossings));
}

/** A block that only one of several ranks has cells for. */
void
test_idle_ranks()
{
  compare_results<3>(
    "3D, ranks without points",
    "Grid/Type = box\nGrid/Upper corner = 4, 1, 1\n"
    "Grid/Subdivisions = 16, 4, 4\nGrid reset/Tolerated imbalance = 100\n"
    "Quadrature/Type = points\nMaterial points/Region = x < 0.75\n"
    "Material/Young modulus = 1000\nMaterial/Poisson ratio = 0.3\n"
    "Material/Density = 1\nDynamics/Inertia = true\n"
    "Grid reset/Steps between resets = 1\n"
    "Dynamics/Initial velocity = 1 + 0.2*sin(pi*x), 0, 0\n"
    "Boundary conditions/Displacement = bottom: y=0; back: z=0\n"
    "Time/End time = 2\nTime/Step size = 0.25\n",
    {"Strain energy (J)", "Kinetic energy (J)"});
  test::check("a rank had none, if there are several",
              shares.has_idle_rank ==
                (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1),
              "");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string quadrature : {"points", "CPDI"})
    test_crossings(quadrature, "Quadrature/Type = " + quadrature + '\n');
  test_crossings("plastic",
                 "Quadrature/Type = CPDI\nNewton/Tolerance = 1e-10\n"
                 "Material/Model = J2\nMaterial/J2/Yield stress = 20\n");
  test_crossings("dynamic",
                 "Quadrature/Type = points\nMaterial/Density = 1\n"
                 "Dynamics/Inertia = true\n"
                 "Grid reset/Steps between resets = 1\n");
  test_idle_ranks();
  return 0;
}
