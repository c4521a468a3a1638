/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Homogeneous plastic flow at finite strain, through the whole method: simple
// shear and plane-strain tension with free sides. The references are written
// here from the equations of the laws, with 2 x 2 matrices and bisection.

#include <algorithm>
#include <array>
#include <functional>

#include "scene.h"
#include "simple_shear.h"

using namespace isochor;

const double shear_modulus = 70 / 2.6, bulk_modulus = 70 / 1.2;
const double yield_stress = 0.5, cohesion = 0.2;

const std::array<std::pair<std::string, std::string>, 2> formulations = {
  {{"u", "Formulation/Type = u\n"},
   {"u-p + PPP", "Formulation/Type = u-p\nFormulation/Stabilisation = PPP\n"}}};

const std::string material_settings =
  "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.3\n"
  "Material/J2/Yield stress = 0.5\nMaterial/Mohr-Coulomb/Cohesion = 0.2\n";

/** Cauchy stresses xx, yy, zz, xy. */
using Stress = std::array<double, 4>;

/** The root of the increasing function @p f in [@p low, @p high]. */
double
root(const std::function<double(double)> &f, double low, double high)
{
  AssertThrow(f(low) < 0 && f(high) > 0, ExcMessage("No root enclosed."));
  for (unsigned int i = 0; i < 100; ++i)
    (f((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

/** Neo-Hookean: dev τ = G dev F Fᵀ. */
Stress
sheared_neo_hookean(const unsigned int n_steps, const double increment)
{
  const double gamma = n_steps * increment, G = shear_modulus;
  return {{2 * G * gamma * gamma / 3,
           -G * gamma * gamma / 3,
           -G * gamma * gamma / 3,
           G * gamma}};
}

/** Tresca and J2: z neither strains nor flows; the elastic stretch in the plane
 * is exp(±ε) at the angle α of the trial state b <- f b fᵀ, ε <= k/(2G) with
 * the shear strength k, τ_1 = -τ_2 = 2Gε. Components xx, yy, zz, xy. */
Stress
sheared_plastic(const unsigned int n_steps,
                const double       h,
                const double       strength)
{
  Stress       b = {{1, 1, 1, 0}}, s{};
  const double G = shear_modulus;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      b[0] += 2 * h * b[3] + h * h * b[1];
      b[3] += h * b[1];
      const double alpha2 = std::atan2(2 * b[3], b[0] - b[1]);
      const double strain =
        std::min(0.5 * std::acosh((b[0] + b[1]) / 2), strength / (2 * G));
      const double C = std::cosh(2 * strain), S = std::sinh(2 * strain);
      b = {{C + S * std::cos(alpha2),
            C - S * std::cos(alpha2),
            1,
            S * std::sin(alpha2)}};
      s = {{2 * G * strain * std::cos(alpha2),
            -2 * G * strain * std::cos(alpha2),
            0,
            2 * G * strain * std::sin(alpha2)}};
    }
  return s;
}

Stress
sheared_j2(const unsigned int n_steps, const double h)
{
  return sheared_plastic(n_steps, h, yield_stress / std::sqrt(3.));
}

Stress
sheared_tresca(const unsigned int n_steps, const double h)
{
  return sheared_plastic(n_steps, h, cohesion);
}

/** Largest relative deviation from @p expected. */
double
stress_error(const MaterialPointMethod<2> &problem, const Stress &expected)
{
  double             worst = 0, scale = 0;
  const PointLayout &l = problem.material_points().layout();
  for (const double value : expected)
    scale = std::max(scale, std::abs(value));
  for (const auto &point : problem.material_points().handler())
    for (unsigned int i = 0; i < 4; ++i)
      test::add_error(
        worst,
        std::abs(point.get_properties()[l.stress + i] - expected[i]) / scale);
  return worst;
}

/** γ = 1 in one step, which only the boundary prescribes, and in twenty. */
void
test_shear(const std::string &model,
           Stress (*reference)(const unsigned int, const double))
{
  for (const auto &formulation : formulations)
    for (const unsigned int n_steps : {1, 20})
      {
        const auto problem = test::run_scene<2>(
          material_settings + "Material/Model = " + model + '\n' +
          formulation.second +
          (n_steps == 1 ?
             "Grid/Type = gmsh\nGrid/File = " SOURCE_DIR "/square.msh\n"
             "Boundary conditions/Displacement = everywhere: x = y*t, y = 0\n" :
             "Grid/Upper corner = 2, 1\nGrid/Subdivisions = 8, 4\n"
             "Grid/Diagonals = alternating\n"
             "Material points/Region = x < 1\n"
             "Boundary conditions/Shear = t\n") +
          "Material points/Points per cell = 6\nNewton/Tolerance = 1e-11\n"
          "Newton/Maximum iterations = 40\n"
          "Time/Step size = " +
          std::to_string(1. / n_steps) +
          "\nTime/Minimum step size = " + std::to_string(1. / n_steps) + '\n');
        const double error =
          stress_error(*problem, reference(n_steps, 1. / n_steps));
        const std::string label =
          model + ", simple shear of 1, " + std::to_string(n_steps) +
          (n_steps == 1 ? " step, " : " steps, ") + formulation.first;
        test::check_error(label, error, 1e-8);
      }
}

/** F = diag(λ, λ_y, 1) in one step with σ_yy = 0: the λ_y for which the radial
 * return of the trial state and p = K (J - 1) give that. */
Stress
pulled_j2(const double lambda, double &lambda_y)
{
  const auto stress = [&](const double f_y) {
    const double J = lambda * f_y, mean = std::log(J) / 3;
    Stress       s    = {{std::log(lambda), std::log(f_y), 0., 0.}}; // strains
    double       norm = 0;
    for (unsigned int i = 0; i < 3; ++i)
      {
        s[i] = 2 * shear_modulus * (s[i] - mean);
        norm += s[i] * s[i];
      }
    const double factor = std::min(1., std::sqrt(2. / 3 / norm) * yield_stress);
    for (unsigned int i = 0; i < 3; ++i)
      s[i] = factor * s[i] / J + bulk_modulus * (J - 1);
    return s;
  };
  lambda_y = root([&](const double f_y) { return stress(f_y)[1]; }, 0.5, 1);
  return stress(lambda_y);
}

/**
 * Tresca flows in the plane only, τ_x - τ_y = 2c, τ_y = 0, and z is elastic
 * with ε_z = 0: 3 K θ = 2c + (K - 2G/3) θ, independent of λ.
 */
Stress
pulled_tresca(const double lambda, double &lambda_y)
{
  const double theta = cohesion / (bulk_modulus + shear_modulus / 3);
  const double J     = std::exp(theta);
  lambda_y           = J / lambda;
  return {{2 * cohesion / J,
           0.,
           (bulk_modulus - 2. / 3 * shear_modulus) * theta / J,
           0.}};
}

/** @p limit is σ_xx of rigid-plastic material; elastic strains let the
 * stress differ from it by about a hundredth. */
void
test_tension(const std::string &model,
             Stress (*reference)(const double, double &),
             const double limit)
{
  double       lambda_y = 0;
  const Stress expected = reference(1.2, lambda_y);
  test::check_error(model + ", plane-strain tension, limit load",
                    std::abs(expected[0] / limit - 1),
                    0.02);
  for (const auto &formulation : formulations)
    {
      const auto problem = test::run_scene<2>(
        material_settings + "Material/Model = " + model + '\n' +
        formulation.second +
        "Grid/Type = gmsh\nGrid/File = " SOURCE_DIR "/square.msh\n"
        "Material points/Points per cell = 6\nNewton/Tolerance = 1e-11\n"
        "Newton/Maximum iterations = 40\nTime/Minimum step size = 1\n"
        "Boundary conditions/Displacement = left: x=0; bottom: y=0; "
        "right: x=0.2*t\n");
      double             worst_F = 0;
      const PointLayout &l       = problem->material_points().layout();
      for (const auto &point : problem->material_points().handler())
        {
          const auto F = point.get_properties();
          test::add_error(worst_F, std::abs(F[l.F] - 1.2));
          test::add_error(worst_F, std::abs(F[l.F + 3] - lambda_y));
        }
      const std::string label =
        model + ", plane-strain tension with free sides, " + formulation.first;
      test::check_error(label + ", F", worst_F, 1e-8);
      test::check_error(label, stress_error(*problem, expected), 1e-8);
    }
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_shear("Neo-Hookean", sheared_neo_hookean);
  test_shear("J2", sheared_j2);
  test_shear("Mohr-Coulomb", sheared_tresca);
  test_tension("J2", pulled_j2, 2 / std::sqrt(3.) * yield_stress);
  test_tension("Mohr-Coulomb", pulled_tresca, 2 * cohesion);
  return 0;
}
