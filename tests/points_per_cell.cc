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

/** The least number of points in a cell, for @p n points per cell as seeded. */
template <int dim>
unsigned int
least_points(const std::string &quadrature,
             const unsigned int n,
             const std::string &more)
{
  const auto problem = test::run_scene<dim>(
    "Grid/Type = adaptive\nGrid/Coarse cells = box\nGrid/Subdivisions = " +
    std::string(dim == 2 ? "4, 4" : "2, 2, 2") +
    "\nAdaptive grid/Maximum level = " + (dim == 2 ? "3" : "2") +
    "\nAdaptive grid/Cell size = if(t > 0.05, 0.01 + 0.3*sqrt((x - 0.4)^2 + "
    "(y - 0.3)^2), 1)\nMaterial/Poisson ratio = 0.3\nFormulation/Type = u-p\n"
    "Quadrature/Type = " +
    quadrature + "\nMaterial points/Points per cell = " + std::to_string(n) +
    '\n' + more +
    "\nBoundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0; "
    "top: y=0" +
    (dim == 3 ? "; front: z=0; back: z=0" : "") +
    "\nTime/Step size = 0.1\nTime/End time = 0.2\n");
  const MaterialPoints<dim> &points = problem->material_points();
  std::vector<unsigned int>  n_points(
    problem->last_statistics().get("Cells of grid"), 0);
  for (const auto &particle : points.handler())
    ++n_points[particle.get_surrounding_cell()->active_cell_index()];
  Utilities::MPI::sum(n_points, MPI_COMM_WORLD, n_points);
  return *std::min_element(n_points.begin(), n_points.end());
}

template <int dim>
void
check(const std::string &quadrature,
      const unsigned int n,
      const std::string &more,
      const unsigned int expected)
{
  const unsigned int least = least_points<dim>(quadrature, n, more);
  test::check(quadrature + ", dim " + std::to_string(dim) + ", " +
                std::to_string(n) + " points in each cell, " + more,
              least >= expected,
              "a cell has " + std::to_string(least));
}

/** Merging leaves alone what splitting asks for: the numbers of points that
 * come and go in the last of four steps on a grid that stays. */
void
test_rest()
{
  const auto problem = test::run_scene<2>(
    "Grid/Type = adaptive\nGrid/Coarse cells = box\nGrid/Subdivisions = 4, 4\n"
    "Adaptive grid/Maximum level = 2\n"
    "Adaptive grid/Cell size = 0.06 + 0.4*y\nMaterial/Poisson ratio = 0.3\n"
    "Material points/Points per cell = 3\n"
    "Material points/Least points per cell = 6\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
    "Time/Step size = 0.1\nTime/End time = 0.4\n");
  const Statistics &statistics = problem->last_statistics();
  test::check("at rest nothing is split and merged again",
              statistics.get("Points added by splitting") == 0 &&
                statistics.get("Points removed by merging") == 0,
              std::to_string(statistics.get("Points added by splitting")));
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
    "Material points/Least points per cell = 8\n"
    "Quadrature/Type = cell-filled\nFormulation/Type = u\n"
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

template <int dim>
void
test_dimension(const std::vector<unsigned int> &numbers)
{
  for (const std::string quadrature : {"points", "cell-filled"})
    for (const unsigned int n : numbers)
      check<dim>(quadrature,
                 n,
                 "Material points/Least points per cell = " + std::to_string(n),
                 n);
  // by itself
  check<dim>("points", 1 << dim, "", 1 << dim);
  check<dim>("points", dim + 1, "", 1);
  check<dim>("CPDI", 1 << dim, "", 1 << dim);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_dimension<2>({1, 3, 4, 6, 12});
  test_dimension<3>({1, 4});
  test_rest();
  test_plastic_body();
  // points without domains leave cells empty, else the others prove nothing
  const unsigned int least =
    least_points<2>("points", 3, "Material points/Domains = if needed");
  test::check("without domains a cell is empty",
              least == 0,
              "a cell has " + std::to_string(least));
  return 0;
}
