/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Domains of material points are split where the grid is fine and neighbours
// with them, so that homogeneous states stay exact, and nothing is lost.

#include <isochor/step/material_point_method.h>

#include <iomanip>

#include "scene.h"

using namespace isochor;

namespace
{
  /** Sums over the points: current volume, mass, mass times place, and the
   * second moments of the mass, that within the domains included, as a domain
   * and its parts have them. */
  template <int dim>
  std::vector<double>
  moments(const MaterialPoints<dim> &points)
  {
    const PointLayout  &l = points.layout();
    std::vector<double> sums(2 + dim + dim * dim);
    for (const auto &particle : points.handler())
      {
        const auto           values = particle.get_properties();
        const Tensor<2, dim> F = deformation_gradient<dim>(values.data(), l);
        const Point<dim>     x = particle.get_location();
        const double         m = values[l.mass];
        sums[0] += values[l.volume] * determinant(F);
        sums[1] += m;
        // of a simplex: m / ((d + 1) (d + 2)) sum of r r^T over its corners
        std::array<Tensor<1, dim>, dim + 1> corners;
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            {
              corners[c + 1][d] = values[l.domain + c * dim + d];
              corners[0][d] -= corners[c + 1][d];
            }
        Tensor<2, dim> second =
          m * outer_product(Tensor<1, dim>(x), Tensor<1, dim>(x));
        for (const auto &corner : corners)
          second +=
            m / ((dim + 1) * (dim + 2)) * outer_product(F * corner, F * corner);
        for (unsigned int a = 0; a < dim; ++a)
          {
            sums[2 + a] += m * x[a];
            for (unsigned int b = 0; b < dim; ++b)
              sums[2 + dim + a * dim + b] += second[a][b];
          }
      }
    Utilities::MPI::sum(sums, MPI_COMM_WORLD, sums);
    return sums;
  }
} // namespace

/** A block that ends inside of the grid is stretched to twice its length, along
 * with the grid, and contracts freely; the grid is fine in places, some of
 * which move through it. Compared is with the same block on a uniform grid. */
template <int dim>
void
test_tension(const std::string &formulation,
             const std::string &quadrature,
             const std::string &n_points,
             const std::string &size)
{
  const std::string n = (dim == 2 ? "4" : "2");
  const std::string scene =
    "Grid/Type = adaptive\nGrid/Coarse cells = box\nGrid/Subdivisions = " + n +
    ", " + n + (dim == 3 ? ", " + n : "") +
    "\nGrid/Stretch = y: 0 -> 0, 1 -> t\nMaterial/Young modulus = 70\n"
    "Material points/Region = if(x < 0.75, 1, 0)\n"
    "Material/Density = 3\n"
    "Material/Poisson ratio = " +
    (formulation == "u" ? "0.3" : "0.499") +
    "\nFormulation/Type = " + formulation +
    "\nQuadrature/Type = " + quadrature +
    "\nMaterial points/Points per cell = " + n_points +
    "\nNewton/Tolerance = 1e-12\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0; top: y=t" +
    (dim == 3 ? "; front: z=0; back: z=0" : "") +
    "\nTime/Step size = " + (dim == 2 ? "0.05" : "0.125") + "\n";
  const auto uniform =
    test::run_scene<dim>(scene + "Adaptive grid/Maximum level = 1\n"
                                 "Adaptive grid/Minimum level = 1\n"
                                 "Material points/Split at share of cell = "
                                 "9\n");
  const auto graded = test::run_scene<dim>(
    scene + "Adaptive grid/Maximum level = " + (dim == 2 ? "3" : "2") +
    "\nAdaptive grid/Minimum level = 1\n"
    "Adaptive grid/Cell size = " +
    size + '\n');
  const std::string name = formulation + ", " + quadrature + ", " + n_points +
                           " points, dim " + std::to_string(dim);
  // the state is that of any point of the uniform one
  const PointLayout                     &l = graded->material_points().layout();
  std::vector<double>                    exact(l.n_properties);
  const Particles::ParticleHandler<dim> &points =
    uniform->material_points().handler();
  if (points.n_locally_owned_particles() > 0)
    {
      const auto values = points.begin()->get_properties();
      exact.assign(values.begin(), values.end());
    }
  Utilities::MPI::max(exact, MPI_COMM_WORLD, exact);
  double stress = 0, F = 0;
  for (const auto &particle : graded->material_points().handler())
    {
      const auto values = particle.get_properties();
      for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
        test::add_error(stress,
                        std::abs(values[l.stress + i] - exact[l.stress + i]));
      for (unsigned int i = 0; i < dim * dim; ++i)
        test::add_error(F, std::abs(values[l.F + i] - exact[l.F + i]));
    }
  test::check_error(name + ": stress", stress / exact[l.stress + 1], 1e-8);
  test::check_error("deformation gradient", F, 1e-8);

  const auto was               = moments(uniform->material_points()),
             is                = moments(graded->material_points());
  const unsigned int n_uniform = points.n_global_particles(),
                     n_graded =
                       graded->material_points().handler().n_global_particles();
  test::check("points are split",
              n_graded > 1.2 * n_uniform,
              std::to_string(n_graded) + " of " + std::to_string(n_uniform));
  double worst = 0;
  for (unsigned int i = 0; i < was.size(); ++i)
    test::add_error(worst, std::abs(is[i] / was[i] - 1));
  test::check_error("volume, mass, centre, second moments", worst, 1e-9);
}

/** A block under its weight through which a band of small cells goes, far from
 * the origin: the same points are split and merged, and it says where doubles
 * end. */
void
test_far_away()
{
  const auto run = [](const std::string &X, const std::string &beyond) {
    return test::run_scene<2>(
      "Quadrature/Type = CPDI\nFormulation/Type = u\n"
      "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
      "Grid/Subdivisions = 4, 4\nGrid/Lower corner = " +
      X + ", " + X + "\nGrid/Upper corner = " + beyond + ", " + beyond +
      "\nAdaptive grid/Cell size = if(abs(x - " + X +
      " + 0.15 - 1.3*t) < 0.1, 0.04, 1)\nMaterial points/Region = if(y - " + X +
      " < 0.5, 1, 0)\nMaterial/Young modulus = 3000\n"
      "Material/Poisson ratio = 0.3\nMaterial/Density = 1\n"
      "Boundary conditions/Gravity = 0, -10*t\n"
      "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
      "Postprocess/Reactions = bottom\n"
      "Time/Step size = 0.1\nTime/End time = 0.6\n");
  };
  const auto here = run("0", "1"), far = run("1e6", "1000001");
  const auto n_points = [](const MaterialPointMethod<2> &problem) {
    return problem.material_points().handler().n_global_particles();
  };
  test::check("far away: as many points",
              n_points(*here) == n_points(*far) && n_points(*here) > 200,
              std::to_string(n_points(*here)) + " and " +
                std::to_string(n_points(*far)));
  test::check_error("far away: weight",
                    std::abs(test::get(*far, "Reaction y on bottom (N)") / 3 -
                             1),
                    1e-6);
  test::check_error("far away: smallest J",
                    std::abs(test::get(*far, "Smallest J") -
                             test::get(*here, "Smallest J")),
                    1e-7);
  std::string message;
  try
    {
      run("1e8", "100000001");
    }
  catch (const std::exception &exc)
    {
      message = test::one_line(exc.what());
    }
  test::check("too far away",
              message.find("too far from the origin") != std::string::npos,
              message);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // fine at a corner; fine in a band that moves
  const std::string corner = "0.03 + 0.3*sqrt((x - 0.3)^2 + (y - 0.4)^2)",
                    band   = "if(abs(x + 0.3*t - 0.5) < 0.1, 0.04, 1)";
  for (const std::string formulation : {"u", "u-p"})
    {
      test_tension<2>(formulation, "CPDI", "4", corner);
      test_tension<2>(formulation, "CPDI", "3", band);
    }
  test_tension<3>("u-p", "CPDI", "4", "if(abs(x - 0.3) < 0.1, 0.1, 1)");
  test_far_away();
  return 0;
}
