/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A fine zone of the grid passes through a body: the points are split in front
// of it and merged behind it, the state stays, and nothing is lost.

#include <isochor/step/material_point_method.h>

#include "scene.h"

using namespace isochor;

namespace
{
  /** Of a body: volume, mass, mass times place, momentum. */
  template <int dim>
  std::vector<double>
  sums(const MaterialPoints<dim> &points)
  {
    const PointLayout  &l = points.layout();
    std::vector<double> sums(2 + 2 * dim);
    for (const auto &particle : points.handler())
      {
        const auto   values = particle.get_properties();
        const double m      = values[l.mass];
        sums[0] += values[l.volume] *
                   determinant(deformation_gradient<dim>(values.data(), l));
        sums[1] += m;
        for (unsigned int d = 0; d < dim; ++d)
          {
            sums[2 + d] += m * particle.get_location()[d];
            if (l.dynamic)
              sums[2 + dim + d] += m * values[l.velocity + d];
          }
      }
    Utilities::MPI::sum(sums, MPI_COMM_WORLD, sums);
    return sums;
  }

  /** Numbers of points: at the start, the most, at the end. */
  struct PointNumbers
  {
    double first = 0, most = 0, last = 0;
  };
  PointNumbers numbers_of_points;
  double       largest_imbalance = 0;
} // namespace

namespace isochor
{
  template <int dim>
  class PointCounter : public Postprocessor<dim>
  {
  public:
    void
    evaluate_nodes(const StepResult<dim> &result, Statistics &) override
    {
      numbers_of_points.last = result.points.handler().n_global_particles();
      if (result.time.step == 0)
        numbers_of_points = {numbers_of_points.last, 0, 0};
      numbers_of_points.most =
        std::max(numbers_of_points.most, numbers_of_points.last);
      const double n_own = result.points.handler().n_locally_owned_particles();
      const auto   n     = Utilities::MPI::min_max_avg(n_own, MPI_COMM_WORLD);
      largest_imbalance =
        std::max(result.time.step == 0 ? 0 : largest_imbalance,
                 n.max / n.avg - 1);
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, PointCounter, "Point counter")
} // namespace isochor

template <int dim>
std::string
scene(const std::string &quadrature)
{
  const std::string n = (dim == 2 ? "8" : "4");
  return "Grid/Type = adaptive\nGrid/Coarse cells = box\nGrid/Subdivisions = " +
         n + ", " + n + (dim == 3 ? ", " + n : "") +
         "\nAdaptive grid/Maximum level = " + (dim == 2 ? "2" : "1") +
         "\nMaterial points/Points per cell = " + (dim == 2 ? "4" : "8") +
         "\nMaterial/Density = 2\nQuadrature/Type = " + quadrature + '\n';
}

/** An incompressible body at rest under its weight in a box; a fine band passes
 * through. */
template <int dim>
void
test_rest(const std::string &quadrature)
{
  const double g = 10, density = 2;
  const auto   problem = test::run_scene<dim>(
    scene<dim>(quadrature) +
    "Adaptive grid/Cell size = if(abs(x + 0.15 - 1.3*t) < 0.1, 0.04, 1)\n"
      "Material points/Region = if(y < 0.5, 1, 0)\n"
      "Material/Young modulus = 3000\nMaterial/Poisson ratio = 0.5\n"
      "Formulation/Type = u-p\nFormulation/Stabilisation = PPP\n"
      "Boundary conditions/Gravity = 0, -10" +
    (dim == 3 ? ", 0" : "") +
    "\nBoundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0" +
    (dim == 3 ? "; front: z=0; back: z=0" : "") +
    "\nTime/Step size = 0.1\nTime/End time = 1.3\n");
  const MaterialPoints<dim> &points   = problem->material_points();
  const PointLayout         &l        = points.layout();
  double                     pressure = 0, stress = 0;
  for (const auto &particle : points.handler())
    {
      const auto   values = particle.get_properties();
      const double p      = -density * g * (0.5 - particle.get_location()[1]);
      test::add_error(pressure, std::abs(values[l.pressure] - p));
      for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
        test::add_error(stress,
                        std::abs(values[l.stress + i] - (i < 3 ? p : 0.)));
    }
  const auto        is   = sums(points);
  const double      mass = density * 0.5;
  const auto        n    = numbers_of_points;
  const std::string text = std::to_string(n.first) + ", " +
                           std::to_string(n.most) + ", " +
                           std::to_string(n.last);
  const std::string name =
    "at rest, " + quadrature + ", dim " + std::to_string(dim) + ": ";
  // in space parts of tetrahedra are in several cells, and forces of points
  // those of points anywhere in their cells
  const bool is_exact = (dim == 2 || quadrature == "CPDI");
  test::check_error(name + "pressure",
                    pressure / (density * g * 0.5),
                    is_exact ? 1e-12 : 0.02);
  test::check_error("stress",
                    stress / (density * g * 0.5),
                    is_exact ? 1e-12 : 0.05);
  test::check_error("volume",
                    std::abs(is[0] / 0.5 - 1),
                    is_exact ? 1e-12 : 1e-5);
  test::check_error("mass", std::abs(is[1] / mass - 1), 1e-12);
  test::check_error("centre",
                    std::abs(is[2] / mass - 0.5) +
                      std::abs(is[3] / mass - 0.25),
                    is_exact ? 1e-12 : 1e-5);
  test::check("points are split", n.most > 4 * n.first, text);
  test::check("and merged", n.last == n.first, text);
}

/** An incompressible elastic block is sheared between plates, then a fine band
 * passes through it: parts that are strained alike are merged. */
void
test_sheared()
{
  const auto problem = test::run_scene<2>(
    scene<2>("CPDI") +
    "Adaptive grid/Cell size = if(abs(x + 0.15 - 1.3*(t - 1)) < 0.1, 0.04, 1)\n"
    "Material points/Region = if(x < 0.75, 1, 0) * if(x > 0.25, 1, 0)\n"
    "Material/Young modulus = 3000\nMaterial/Poisson ratio = 0.499\n"
    "Formulation/Type = u-p\n"
    "Boundary conditions/Displacement = bottom: x=0, y=0; "
    "top: x=0.1*min(t,1), y=0\nTime/Step size = 0.1\nTime/End time = 2.4\n");
  const auto is = sums(problem->material_points());
  const auto n  = numbers_of_points;
  test::check_error("sheared: volume", std::abs(is[0] / 0.5 - 1), 5e-5);
  test::check_error("mass", std::abs(is[1] - 1), 1e-12);
  test::check("as many points as it needs",
              n.last <= 12 * n.first,
              std::to_string(n.first) + ", " + std::to_string(n.last));
}

/** A block that flies and vibrates, with and without a fine band that passes
 * through it. */
void
test_motion(const std::string &quadrature)
{
  std::array<std::vector<double>, 2> momentum;
  std::array<double, 2>              energy;
  for (const bool with_band : {false, true})
    {
      const auto problem = test::run_scene<2>(
        scene<2>(quadrature) + "Adaptive grid/Cell size = " +
        (with_band ? "if(abs(x + 0.15 - 1.3*t) < 0.1, 0.04, 1)" : "1") +
        "\nMaterial points/Region = if(x < 0.5, 1, 0) * if(x > 0.25, 1, 0) * "
        "if(y > 0.25, 1, 0) * if(y < 0.75, 1, 0)\n"
        "Material/Young modulus = 20\nMaterial/Poisson ratio = 0.3\n"
        "Formulation/Type = u-p\nDynamics/Inertia = true\n"
        "Dynamics/Initial velocity = 0.2 + 2*(y - 0.5)^2, 0.05\n"
        "Time/Step size = 0.05\nTime/End time = 1.2\n");
      const Statistics &s = problem->last_statistics();
      momentum[with_band] = sums(problem->material_points());
      energy[with_band] =
        s.get("Strain energy (J)") + s.get("Kinetic energy (J)");
    }
  const auto n = numbers_of_points;
  test::check("in motion, " + quadrature + ": points are split",
              n.most > 4 * n.first,
              std::to_string(n.most) + ", " + std::to_string(n.last));
  test::check_error("momentum",
                    std::abs(momentum[1][4] / momentum[0][4] - 1) +
                      std::abs(momentum[1][5] / momentum[0][5] - 1),
                    1e-12);
  test::check_error("energy", std::abs(energy[1] / energy[0] - 1), 0.01);
}

/** A block is carried through a grid that doesn't change: the ranks always have
 * the same number of points, but for a few. */
void
test_balance()
{
  const auto problem = test::run_scene<2>(
    "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
    "Grid/Subdivisions = 32, 32\nAdaptive grid/Maximum level = 0\n"
    "Material/Density = 2\nMaterial/Poisson ratio = 0.3\n"
    "Material points/Points per cell = 4\n"
    "Material points/Region = (x < 0.5) * (y < 0.5)\n"
    "Quadrature/Type = CPDI\n"
    "Interaction: body - place/Displacement = x=0.5*t, y=0.5*t\n"
    "Time/Step size = 0.1\n");
  test::check_error("balance of points", largest_imbalance, 0.05);
  test::check("the same grid",
              problem->last_statistics().get("Changes of grid") == 0,
              "");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_rest<2>("CPDI");
  test_rest<3>("CPDI");
  test_sheared();
  test_motion("CPDI");
  test_balance();
  return 0;
}
