/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A body at rest that fills a grid, whose cells are halved around a place by up
// to three levels (in space two) in one step: how many points its new cells
// have.

#include <isochor/step/material_point_method.h>

#include "scene.h"

using namespace isochor;

/** As many points as @p n_points per cell seeded stay in each new one. */
template <int dim>
void
check(const unsigned int n)
{
  const auto problem = test::run_scene<dim>(
    "Grid/Type = adaptive\nGrid/Coarse cells = box\nGrid/Subdivisions = " +
    std::string(dim == 2 ? "4, 4" : "2, 2, 2") +
    "\nAdaptive grid/Maximum level = " + (dim == 2 ? "3" : "2") +
    "\nAdaptive grid/Cell size = if(t > 0.05, 0.01 + 0.3*sqrt((x - 0.4)^2 + "
    "(y - 0.3)^2), 1)\nMaterial/Poisson ratio = 0.3\nFormulation/Type = u-p\n"
    "Quadrature/Type = CPDI\nMaterial points/Points per cell = " +
    std::to_string(n) +
    "\nBoundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0; "
    "top: y=0" +
    (dim == 3 ? "; front: z=0; back: z=0" : "") +
    "\nTime/Step size = 0.1\nTime/End time = 0.2\n");
  const double n_cells = problem->last_statistics().get("Cells of grid");
  const double per_cell =
    problem->material_points().handler().n_global_particles() / n_cells;
  test::check("dim " + std::to_string(dim) + ": points per cell as asked, " +
                std::to_string(n),
              per_cell >= n,
              std::to_string(per_cell));
}

/** A band of small cells passes through a plastic body: the same domains are
 * bisected on any number of ranks (the other one's test has the same output).
 */
void
test_plastic_body()
{
  const auto problem = test::run_scene<2>(
    "Grid/Type = adaptive\nGrid/Coarse cells = box\nGrid/Subdivisions = 4, 4\n"
    "Adaptive grid/Maximum level = 3\n"
    "Adaptive grid/Cell size = 0.02 + 0.3*abs(x - 0.2 - 0.5*t)\n"
    "Material points/Region = (x < 0.8) * (y < 0.7)\n"
    "Material points/Points per cell = 3\n"
    "Quadrature/Type = CPDI\nFormulation/Type = u\n"
    "Formulation/Geometry = axisymmetric\nMaterial/Model = Mohr-Coulomb\n"
    "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0.3\n"
    "Material/Density = 1000\nMaterial/Mohr-Coulomb/Cohesion = 150\n"
    "Material/Mohr-Coulomb/Friction angle = 20\n"
    "Material/Mohr-Coulomb/Dilation angle = 10\n"
    "Boundary conditions/Displacement = bottom: x=0, y=0; left: x=0\n"
    "Boundary conditions/Gravity = 0, -0.6*(1 - exp(-10*t))\n"
    "Newton/Tolerance = 1e-11\nPostprocess/Write energies = always\n"
    "Time/Step size = 0.1\nTime/End time = 1\n");
  const Statistics  &statistics = problem->last_statistics();
  std::ostringstream text;
  text.precision(6);
  text << problem->material_points().handler().n_global_particles()
       << " points, plastic work " << statistics.get("Plastic work (J)")
       << " J";
  test::check("a plastic body: " + text.str(), true, "");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int n : {1, 3, 4, 6, 12})
    check<2>(n);
  for (const unsigned int n : {1, 4, 8})
    check<3>(n);
  test_plastic_body();
  return 0;
}
