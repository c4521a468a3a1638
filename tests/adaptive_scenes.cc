/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Scenes on adaptive grids: homogeneous states across levels, a grid that
// follows a body and changes in each step, what is conserved when points are
// split.

#include <isochor/step/material_point_method.h>

#include "scene.h"

using namespace isochor;

namespace
{
  template <int dim>
  std::string
  box(const unsigned int n)
  {
    const std::string number = std::to_string(n);
    return "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
           "Grid/Subdivisions = " +
           number + ", " + number + (dim == 3 ? ", " + number : "") + "\n";
  }

  const std::string law = "Material/Young modulus = 100\n"
                          "Material/Density = 0\n";

  /** Sums over the points: volume, mass, and mass times place. */
  template <int dim>
  std::vector<double>
  moments(const MaterialPoints<dim> &points)
  {
    const PointLayout  &l = points.layout();
    std::vector<double> sums(2 + dim);
    for (const auto &particle : points.handler())
      {
        const auto       values = particle.get_properties();
        const Point<dim> x      = particle.get_location();
        sums[0] += values[l.volume] *
                   determinant(deformation_gradient<dim>(values.data(), l));
        sums[1] += values[l.mass];
        for (unsigned int d = 0; d < dim; ++d)
          sums[2 + d] += values[l.mass] * x[d];
      }
    Utilities::MPI::sum(sums, MPI_COMM_WORLD, sums);
    return sums;
  }

  /** The largest difference between the points' stresses. */
  template <int dim>
  double
  variation_of_stress(const MaterialPoints<dim> &points)
  {
    const PointLayout  &l = points.layout();
    const unsigned int  n = n_symmetric_components<dim>;
    std::vector<double> least(n, 1e300), most(n, -1e300);
    for (const auto &particle : points.handler())
      for (unsigned int i = 0; i < n; ++i)
        {
          const double s = particle.get_properties()[l.stress + i];
          least[i]       = std::min(least[i], s);
          most[i]        = std::max(most[i], s);
        }
    double worst = 0;
    for (unsigned int i = 0; i < n; ++i)
      test::add_error(worst,
                      Utilities::MPI::max(most[i], MPI_COMM_WORLD) -
                        Utilities::MPI::min(least[i], MPI_COMM_WORLD));
    return worst;
  }
} // namespace

/** A block is compressed between smooth walls on a grid of three levels: the
 * stress is the same everywhere. */
template <int dim>
void
test_patch(const std::string &formulation, const std::string &quadrature)
{
  const auto problem = test::run_scene<dim>(
    box<dim>(dim == 2 ? 3 : 2) + law +
    "Adaptive grid/Maximum level = 2\n"
    "Adaptive grid/Cell size = 0.1 + abs(x - 0.3)/2 + abs(y - 0.4)/2\n"
    "Adaptive grid/Resets between changes = 0\n"
    "Material points/Points per cell = " +
    std::string(dim == 2 ? "4" : "8") +
    "\nMaterial/Poisson ratio = 0.3\n"
    "Formulation/Type = " +
    formulation + "\nQuadrature/Type = " + quadrature +
    "\nGrid reset/Steps between resets = 0\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0; "
    "top: y=-0.1*t" +
    (dim == 3 ? "; front: z=0; back: z=0" : "") + "\nTime/Step size = 0.5\n");
  const MaterialPoints<dim> &points = problem->material_points();
  test::check_error(formulation + ", " + quadrature + ", dim " +
                      std::to_string(dim) + ": homogeneous across levels",
                    variation_of_stress(points),
                    1e-10);
  // by the law: uniaxial strain, J = 0.9
  const PointLayout &l     = points.layout();
  double             error = 0;
  for (const auto &particle : points.handler())
    {
      const auto values = particle.get_properties();
      test::add_error(error,
                      std::abs(determinant(
                                 deformation_gradient<dim>(values.data(), l)) -
                               0.9));
    }
  test::check_error("volume of its points", error, 1e-12);
}

/** A block is stretched by a half, and with it its grid, whose fine cells move
 * through it in the other direction: points come to other cells in each step
 * and are split. The state stays homogeneous, and nothing is lost. */
template <int dim>
void
test_stretched(const std::string &formulation, const std::string &quadrature)
{
  const auto problem = test::run_scene<dim>(
    box<dim>(dim == 2 ? 4 : 2) + law +
    "Material/Poisson ratio = 0.3\nMaterial/Density = 2\n"
    "Grid/Stretch = y: 0 -> 0, 1 -> 0.5*t\n"
    "Adaptive grid/Maximum level = 2\n"
    "Adaptive grid/Cell size = 0.1 + abs(x + t - 1)/2\n"
    "Material points/Points per cell = " +
    std::string(dim == 2 ? "4" : "8") + "\nFormulation/Type = " + formulation +
    "\nQuadrature/Type = " + quadrature +
    "\nBoundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0; "
    "top: y=0.5*t" +
    (dim == 3 ? "; front: z=0; back: z=0" : "") + "\nTime/Step size = 0.25\n");
  const MaterialPoints<dim> &points = problem->material_points();
  const auto                 sums   = moments(points);
  const double changes = problem->last_statistics().get("Changes of grid");
  test::check(formulation + ", " + quadrature + ", dim " + std::to_string(dim) +
                ": the grid changes",
              changes >= 3,
              std::to_string(changes) + " changes");
  // the stress is 58 Pa
  test::check_error("homogeneous", variation_of_stress(points), 1e-9);
  test::check_error("volume", std::abs(sums[0] / 1.5 - 1), 1e-12);
  test::check_error("mass", std::abs(sums[1] / 2 - 1), 1e-12);
  test::check_error("centre",
                    std::abs(sums[2] / 2 - 0.5) + std::abs(sums[3] / 2 - 0.75),
                    1e-12);
}

/** A block is carried through a grid that is fine at its side only; it stays
 * free of stress, and keeps volume, mass and moments but for the motion. */
template <int dim>
void
test_carried()
{
  const unsigned int n       = (dim == 2 ? 8 : 4);
  const auto         problem = test::run_scene<dim>(
    box<dim>(n) + law +
    "Material/Poisson ratio = 0.3\nMaterial/Density = 2\n"
            "Material points/Region = (x < 0.25) * (y < 0.5)\n"
            "Material points/Points per cell = " +
    std::string(dim == 2 ? "4" : "8") +
    "\n"
            "Adaptive grid/Maximum level = 1\n"
            "Adaptive grid/Cell size = if(abs(x - 0.2 - 0.5*t) < 0.05, " +
    std::to_string(0.6 / n) +
    ", 1)\n"
            "Quadrature/Type = CPDI\n"
            "Formulation/Type = u-p\n"
            "Interaction: body - place/Displacement = x=0.5*t, y=0" +
    (dim == 3 ? ", z=0" : "") + "\nTime/Step size = 0.25\n");
  const MaterialPoints<dim> &points = problem->material_points();
  const auto                 sums   = moments(points);
  const double               depth = 1, area = 0.125 * depth, mass = 2 * area;
  const double changes = problem->last_statistics().get("Changes of grid");
  test::check("CPDI, dim " + std::to_string(dim) + ": the grid follows a body",
              changes >= 3,
              std::to_string(changes) + " changes");
  test::check_error("free of stress", variation_of_stress(points), 1e-8);
  test::check_error("its volume", std::abs(sums[0] / area - 1), 1e-10);
  test::check_error("its mass", std::abs(sums[1] / mass - 1), 1e-12);
  test::check_error("its centre",
                    std::abs(sums[2] / mass - 0.625) +
                      std::abs(sums[3] / mass - 0.25),
                    1e-8);
}

/** A block flies freely through a grid that is fine in front of it and changes
 * in each step: it keeps its momentum, and no stress arises. */
template <int dim>
void
test_flight(const std::string &quadrature)
{
  const auto problem = test::run_scene<dim>(
    box<dim>(8) + law +
    "Material/Poisson ratio = 0.3\nMaterial/Density = 2\n"
    "Material points/Region = (x < 0.25) * (y > 0.25) * (y < 0.5)\n"
    "Material points/Points per cell = 4\n"
    "Adaptive grid/Maximum level = 1\n"
    "Adaptive grid/Cell size = if(abs(x - 0.2 - 0.5*t) < 0.1, 0.075, 1)\n"
    "Quadrature/Type = " +
    quadrature +
    "\nFormulation/Type = u\nDynamics/Inertia = true\n"
    "Dynamics/Initial velocity = 0.5, 0.25\nTime/Step size = 0.125\n");
  const MaterialPoints<dim> &points     = problem->material_points();
  const Statistics          &statistics = problem->last_statistics();
  const double               mass       = 0.125;
  const double               changes    = statistics.get("Changes of grid");
  test::check(quadrature + ": the grid changes in flight",
              changes >= 4,
              std::to_string(changes) + " changes");
  test::check_error(
    "momentum in flight",
    std::abs(statistics.get("Momentum x (kg m/s)") / (0.5 * mass) - 1) +
      std::abs(statistics.get("Momentum y (kg m/s)") / (0.25 * mass) - 1),
    1e-10);
  test::check_error("no stress in flight", variation_of_stress(points), 1e-8);
}

/** That the quadrature has integrated over the @p volume (m^dim). */
template <int dim>
void
check_volume(const Statistics &statistics,
             const double      volume,
             const double      tolerance)
{
  test::check_error("volume in the grid",
                    std::abs(statistics.get(dim == 2 ?
                                              "Volume in the grid (m^2)" :
                                              "Volume in the grid (m^3)") -
                             volume),
                    tolerance);
}

/** Cells are halved again and again at a wall, or in a corner: the parts of
 * points beside it stay in the grid, and the stress homogeneous. */
template <int dim>
void
test_splitting_at_wall(const std::string &distance)
{
  const auto problem = test::run_scene<dim>(
    box<dim>(1) + law +
    "Material/Density = 2\n"
    "Material/Poisson ratio = 0.3\nGrid/Stretch = y: 0 -> 0, 1 -> -0.1*t\n"
    "Adaptive grid/Maximum level = " +
    std::string(dim == 2 ? "9" : "3") +
    "\nAdaptive grid/Cell size = 2^(-10*t) + " + distance +
    "\nFormulation/Type = u-p\nQuadrature/Type = CPDI\n"
    "Material points/Points per cell = " +
    std::string(dim == 2 ? "4" : "8") +
    "\nBoundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0; "
    "top: y=-0.1*t" +
    (dim == 3 ? "; front: z=0; back: z=0" : "") + "\nTime/Step size = 0.1\n");
  // an error if points have left the grid
  const std::string what =
    "cells ever smaller at " + distance + " = 0, dim " + std::to_string(dim);
  test::check_error(what + ": mass of points",
                    std::abs(moments(problem->material_points())[1] / 2 - 1),
                    1e-12);
  test::check_error(what + ": stress",
                    variation_of_stress(problem->material_points()),
                    1e-9);
  // at the start of the last step
  check_volume<dim>(problem->last_statistics(), 0.91, 1e-9);
}

/** An L-shaped body, fine in its corner, is carried far in a step, into leaves
 * that are up to ten levels coarser: their number stays near the target. */
void
test_number_of_leaves()
{
  test::run_scene<2>(
    "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
    "Grid/Lower corner = 0, -0.25\nGrid/Upper corner = 10, 2.5\n"
    "Grid/Subdivisions = 40, 11\nAdaptive grid/Maximum level = 10\n"
    "Adaptive grid/Target of relative error = 0.0001\n"
    "Adaptive grid/Target number of leaves = 200\n"
    "Material points/Region = (x < 2) * (y > 0) * (y < 2) * (1 - (x > 1)*(y > "
    "1))\nMaterial points/Points per cell = 4\nFormulation/Type = u-p\n"
    "Quadrature/Type = CPDI\nFormulation/Stabilisation = PPP\n"
    "Material/Young modulus = 1000\nMaterial/Density = 1\n"
    "Material/Poisson ratio = 0.3\nBoundary conditions/Gravity = 5*t, 0\n"
    "Boundary conditions/Surfaces of body = base: y < 1e-6\n"
    "Interaction: base - place/Displacement = "
    "x=2.3*min(max(0, t - 6.5), 1), y=0\n"
    "Time/End time = 10\nTime/Step size = 1\n");
  double most = 0;
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    most = test::largest_in_statistics("Leaves of grid");
  most = Utilities::MPI::max(most, MPI_COMM_WORLD);
  // 440 are the coarse ones; 10 048 where levels increase at once
  test::check("a target of 200 leaves, and 440 without a body",
              most < 1500,
              std::to_string(most));
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string quadrature : {"CPDI"})
    {
      test_patch<2>("u", quadrature);
      test_patch<2>("u-p", quadrature);
      test_patch<3>("u-p", quadrature);
    }
  for (const std::string quadrature : {"CPDI"})
    {
      test_stretched<2>("u", quadrature);
      test_stretched<2>("u-p", quadrature);
      test_stretched<3>("u-p", quadrature);
    }
  test_carried<2>();
  test_carried<3>();
  test_flight<2>("CPDI");
  test_splitting_at_wall<2>("x + abs(y - 0.4)");
  test_splitting_at_wall<2>("x + y");
  test_splitting_at_wall<3>("x + y + abs(z - 0.4)");
  test_number_of_leaves();
  return 0;
}
