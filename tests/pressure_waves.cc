/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Pressure waves in nearly incompressible bodies, u-p with orthogonal
// subscales: the first axial mode of a column of height 1 between smooth walls
// has the period 4/c, c² = (K + 4/3 G)/ρ. The stabilisation must not answer to
// the gradient ρ a of the pressure that drives it, nor to that of bodies at
// rest.

#include "run_scene.h"

using namespace isochor;

namespace
{
  constexpr double density = 1000, shear_modulus = 1e4;

  double
  period(const double nu)
  {
    const double K = shear_modulus * 2 * (1 + nu) / (3 * (1 - 2 * nu));
    return 4 / std::sqrt((K + 4. / 3 * shear_modulus) / density);
  }

  /** The scene of a column of @p n cells, one tenth as wide. */
  template <int dim>
  std::string
  column(const double nu, const unsigned int n)
  {
    const std::string  width = std::to_string(std::max(0.1, 1. / n));
    const unsigned int m     = std::max(1u, n / 10);
    const std::string  third =
      dim == 3 ? ", " + std::to_string(m) : std::string();
    return "Grid/Upper corner = " + width + ", 1" +
           (dim == 3 ? ", " + width : "") +
           "\nGrid/Subdivisions = " + std::to_string(m) + ", " +
           std::to_string(n) + third + "\nMaterial/Young modulus = " +
           std::to_string(2 * shear_modulus * (1 + nu)) +
           "\nMaterial/Poisson ratio = " + std::to_string(nu) +
           "\nMaterial/Density = 1000\nDynamics/Inertia = true\n"
           "Boundary conditions/Displacement = left: x=0; right: x=0; " +
           (dim == 3 ? "front: z=0; back: z=0; " : "") +
           "bottom: y=0\nPostprocess/Point probes = top: 0.05, 1" +
           (dim == 3 ? ", 0.05\n" : "\n");
  }

  /** The period, by the times at which the top is where it started. */
  template <int dim>
  void
  test_period(const std::string &what,
              const double       nu,
              const unsigned int n,
              const std::string &settings,
              const double       tolerance)
  {
    const std::string top = "Displacement y of top (m)";
    const double      T   = period(nu);
    test::record_columns({top});
    const auto problem = test::run_scene<dim>(
      column<dim>(nu, n) + "Dynamics/Initial velocity = 0, 1e-4*sin(pi/2*y)" +
      (dim == 3 ? ", 0" : "") + "\nTime/Step size = " + std::to_string(T / 90) +
      "\nTime/End time = " + std::to_string(2.1 * T) + "\n" + settings);
    const auto         &seen = test::recorded();
    const auto         &u    = seen.columns.at(top);
    std::vector<double> crossings;
    for (unsigned int i = 1; i < u.size(); ++i)
      if (u[i - 1] * u[i] < 0)
        crossings.push_back(seen.times[i - 1] +
                            (seen.times[i] - seen.times[i - 1]) * u[i - 1] /
                              (u[i - 1] - u[i]));
    const double found =
      crossings.size() < 2 ?
        0. :
        2 * (crossings.back() - crossings.front()) / (crossings.size() - 1.);
    test::check_error("period, " + what, std::abs(found / T - 1), tolerance);
    // the scheme loses 2.8e-4 of the energy, the stabilisation nothing
    const double lost = test::get(*problem, "Energy lost by the scheme (J)"),
                 E    = test::get(*problem, "Kinetic energy (J)") +
                     test::get(*problem, "Strain energy (J)");
    test::check_error("energy, " + what, std::abs(lost) / E, 4e-4);
  }

  /** Two liquids of which one is three times as heavy, one on the other in the
   * same field: the gradient of the pressure jumps between them. */
  void
  test_layers()
  {
    const auto problem = test::run_scene<2>(
      column<2>(0.5, 10) +
      "Grid/Subdivisions = 2, 10\nQuadrature/Type = points\n"
      "Material points/Materials in zones = 2: y > 0.5\n"
      "Material 2/Young modulus = 30000\nMaterial 2/Poisson ratio = 0.5\n"
      "Material 2/Density = 3000\nBoundary conditions/Gravity = 0, -10\n"
      "Time/Step size = 0.01\nTime/End time = 0.1\n"
      "Postprocess/Reactions = bottom\n");
    test::check_error("two layers at rest: kinetic energy",
                      test::get(*problem, "Kinetic energy (J)"),
                      1e-12);
    test::check_error(
      "two layers at rest: weight",
      test::relative(test::get(*problem, "Reaction y on bottom (N)"), 2000),
      1e-7);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_period<2>("0.499, 10 cells", 0.499, 10, "", 0.003);
  test_period<2>("0.4999, 20 cells", 0.4999, 20, "", 0.005);
  test_period<2>("0.4999, 20 cells, kept grid",
                 0.4999,
                 20,
                 "Grid reset/Steps between resets = 0\n",
                 0.005);
  test_period<2>("0.4999, 20 cells, points",
                 0.4999,
                 20,
                 "Quadrature/Type = points\n",
                 0.005);
  test_period<2>(
    "0.4999, 20 cells, Q1", 0.4999, 20, "Grid/Shape functions = Q1\n", 0.006);
  test_period<3>("in space, 0.499, 10 cells", 0.499, 10, "", 0.003);
  test_layers();
  return 0;
}
