/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Plasticity through the whole method: confined tension and compression at
// finite strain against closed forms, the elastic-plastic cylinder and
// Prandtl's footing on coarse grids; loads on the surface of the body.

#include <array>

#include "scene.h"

using namespace isochor;

const std::array<std::pair<std::string, std::string>, 2> formulations = {
  {{"u", "Formulation/Type = u\n"},
   {"u-p + PPP", "Formulation/Type = u-p\nFormulation/Stabilisation = PPP\n"}}};

/** Largest relative deviation of the Cauchy stresses xx, yy, zz, xy, ... */
template <int dim>
double
stress_error(const MaterialPointMethod<dim> &problem,
             const std::array<double, 6>    &expected)
{
  double             worst = 0, scale = 0;
  const PointLayout &l = problem.material_points().layout();
  for (const double value : expected)
    scale = std::max(scale, std::abs(value));
  for (const auto &point : problem.material_points().handler())
    for (unsigned int i = 0; i < (dim == 2 ? 4 : 6); ++i)
      test::add_error(
        worst,
        std::abs(point.get_properties()[l.stress + i] - expected[i]) / scale);
  return worst;
}

/** E = 70 Pa, ν = 0.3; the grid follows the body to the stretch λ = 1 + e. */
template <int dim>
std::string
confined_scene(const double e)
{
  std::ostringstream scene;
  scene << (dim == 2 ? "Grid/Subdivisions = 3, 3\n" :
                       "Grid/Lower corner = 0, 0, 0\n"
                       "Grid/Upper corner = 1, 1, 1\n"
                       "Grid/Subdivisions = 2, 2, 2\n"
                       "Material points/Points per cell = 4\n")
        << "Grid/Diagonals = alternating\n"
        << "Grid/Stretch = x: 0 -> 0, 1 -> " << e << "*t\n"
        << "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.3\n"
        << "Boundary conditions/Displacement = left: x=0; right: x=" << e
        << "*t; bottom: y=0; top: y=0"
        << (dim == 2 ? "\n" : "; front: z=0; back: z=0\n")
        << "Time/Step size = 0.1\n";
  return scene.str();
}

const double shear_modulus = 70 / 2.6, bulk_modulus = 70 / 1.2;

/** F = diag(λ, 1, 1), J2: dev τ keeps its direction, τ_xx - τ_yy = ±σ_Y. */
template <int dim>
void
test_confined_j2(const double e)
{
  const double yield_stress = 5, J = 1 + e;
  const double p = bulk_modulus * (J - 1), s = std::copysign(yield_stress, e);
  const std::array<double, 6> expected = {
    {p + 2. / 3 * s / J, p - 1. / 3 * s / J, p - 1. / 3 * s / J, 0., 0., 0.}};
  for (const auto &formulation : formulations)
    {
      const auto problem = test::run_scene<dim>(
        confined_scene<dim>(e) + formulation.second +
        "Material/Model = J2\nMaterial/J2/Yield stress = 5\n");
      test::check_error("J2, confined " +
                          std::string(e > 0 ? "tension" : "compression") +
                          " at finite strain, dim " + std::to_string(dim) +
                          ", " + formulation.first,
                        stress_error(*problem, expected),
                        1e-8);
    }
}

/**
 * The same for Mohr-Coulomb and a compression: two planes flow equally, with
 * the plastic multiplier x of each
 *   ε_a = ln λ + 2 (1 - sin ψ) x,  ε_l = -(1 + sin ψ) x,
 *   τ_l (1 + sin φ) - τ_a (1 - sin φ) = 2 c cos φ.
 */
template <int dim>
void
test_confined_mohr_coulomb(const double phi, const double psi)
{
  const double c = 0.5, e = -0.3;
  const double sin_phi = std::sin(phi * numbers::PI / 180),
               cos_phi = std::cos(phi * numbers::PI / 180),
               sin_psi = std::sin(psi * numbers::PI / 180);
  const double lambda  = bulk_modulus - 2. / 3 * shear_modulus;
  const auto   stress  = [&](const double x) {
    const double a = std::log(1 + e) + 2 * (1 - sin_psi) * x,
                 l = -(1 + sin_psi) * x, trace = a + 2 * l;
    return std::array<double, 2>{{lambda * trace + 2 * shear_modulus * a,
                                  lambda * trace + 2 * shear_modulus * l}};
  };
  const auto f = [&](const double x) {
    const auto tau = stress(x);
    return tau[1] * (1 + sin_phi) - tau[0] * (1 - sin_phi) - 2 * c * cos_phi;
  };
  const auto tau = stress(f(0) / (f(0) - f(1))); // f is linear
  AssertThrow(f(0) > 0, ExcMessage("The state must be plastic."));
  const std::array<double, 6> expected = {
    {tau[0] / (1 + e), tau[1] / (1 + e), tau[1] / (1 + e), 0., 0., 0.}};

  std::ostringstream material;
  material << "Material/Model = Mohr-Coulomb\n"
           << "Material/Mohr-Coulomb/Cohesion = " << c << '\n'
           << "Material/Mohr-Coulomb/Friction angle = " << phi << '\n'
           << "Material/Mohr-Coulomb/Dilation angle = " << psi << '\n';
  for (const auto &formulation : formulations)
    {
      const auto problem = test::run_scene<dim>(
        confined_scene<dim>(e) + formulation.second + material.str());
      std::ostringstream what;
      what << "Mohr-Coulomb, phi = " << phi << ", psi = " << psi
           << ", confined compression at finite strain, dim " << dim << ", "
           << formulation.first;
      test::check_error(what.str(), stress_error(*problem, expected), 1e-8);
    }
}

/** Pressure in the bore over σ_Y at a displacement of the bore of u σ_Y / G,
 * ν = 1/2, b/a = 2, and the limit 2/√3 ln 2 for all ν. */
void
test_cylinder()
{
  const std::string scene =
    "Grid/Type = gmsh\nGrid/File = " SOURCE_DIR "/quarter_ring.msh\n"
    "Material/Model = J2\nMaterial/J2/Yield stress = 1e-5\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
    "Boundary conditions/Surfaces of body = bore: inner\n"
    "Quadrature/Type = CPDI\n"
    "Interaction: bore - place/Displacement = x=1e-5*t*x, y=1e-5*t*y\n";
  const auto pressure = [&](const std::string &settings) {
    return test::run_scene<2>(scene + settings)
             ->last_statistics()
             .get("Force x on bore by place (N)") /
           1e-5;
  };
  const std::string incompressible =
    "Material/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n";
  const std::array<std::array<double, 2>, 4> curve = {
    {{{0.28867513459481287, 0.4330127018922193}},
     {{0.4510548978043951, 0.6094867991258044}},
     {{0.649519052838329, 0.7207815213969601}},
     {{1.1547005383792515, 0.8003774225686291}}}};
  for (const auto &point : curve)
    {
      std::ostringstream time;
      time.precision(17);
      time << "Time/End time = " << point[0]
           << "\nTime/Step size = " << point[0] / 20 << '\n';
      std::ostringstream what;
      what << "cylinder, nu = 0.5, p = " << point[1] << " yield stresses";
      test::check_error(what.str(),
                        std::abs(
                          pressure(incompressible + time.str()) / point[1] - 1),
                        0.01);
    }
  test::check_error("cylinder, nu = 0.3, limit pressure",
                    std::abs(pressure("Material/Young modulus = 2.6\n"
                                      "Material/Poisson ratio = 0.3\n"
                                      "Time/End time = 3\n"
                                      "Time/Step size = 0.1\n") /
                               0.8003774225686291 -
                             1),
                    0.003);
}

/** Prandtl: q/c = 2 + π, with 8 cells per width; u is much too stiff. And with
 * friction, φ = ψ = 20°, N_c = (exp(π tan φ) tan²(45° + φ/2) - 1) cot φ. */
void
test_footing()
{
  const std::string scene =
    "Grid/Type = gmsh\nGrid/File = " SOURCE_DIR "/strip_footing.msh\n"
    "Material points/Physical groups = ground\n"
    "Material/Model = Mohr-Coulomb\nMaterial/Mohr-Coulomb/Cohesion = 1e3\n"
    "Material/Young modulus = 1e7\nMaterial/Poisson ratio = 0.49\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0; "
    "bottom: x=0, y=0; footing: y=-3e-3*t\n"
    "Postprocess/Reactions = footing\nTime/Step size = 0.1\n";
  const auto bearing_capacity = [&](const std::string &settings) {
    const auto problem = test::run_scene<2>(scene + settings);
    return -2 * problem->last_statistics().get("Reaction y on footing (N)") /
           1e3;
  };
  std::array<double, 2> error;
  for (unsigned int i = 0; i < 2; ++i)
    error[i] = bearing_capacity(formulations[i].second) / (2 + numbers::PI) - 1;
  test::check_error("Prandtl's footing, u-p + PPP", std::abs(error[1]), 0.03);
  test::check("Prandtl's footing, u is too stiff",
              error[0] > 0.2,
              std::to_string(error[0]));

  const double tan_phi = std::tan(numbers::PI / 9),
               tan_55  = std::tan(55 * numbers::PI / 180);
  const double N_c =
    (std::exp(numbers::PI * tan_phi) * tan_55 * tan_55 - 1) / tan_phi;
  const std::string friction = "Material/Young modulus = 5e7\n"
                               "Material/Mohr-Coulomb/Friction angle = 20\n"
                               "Material/Mohr-Coulomb/Dilation angle = 20\n" +
                               formulations[1].second;
  for (const std::string nu : {"0.3", "0.5"})
    test::check_error("Prandtl's footing with friction, u-p + PPP, nu = " + nu,
                      std::abs(
                        bearing_capacity(
                          friction + "Material/Poisson ratio = " + nu + '\n') /
                          N_c -
                        1),
                      0.05);
}

/** One step of a Neo-Hookean square under a pressure that follows it: the
 * in-plane stress is -p; and under a dead load on one side. */
void
test_surface_loads()
{
  const std::string scene =
    "Grid/Subdivisions = 3, 3\nGrid/Upper corner = 1.5, 1.5\n"
    "Material points/Region = x < 1 && y < 1\n"
    "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.3\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
    "Boundary conditions/Surfaces of body = right: x > 0.999; top: y > 0.999\n"
    "Newton/Reuse factorisation = 0\n";
  for (const auto &formulation : formulations)
    {
      auto problem =
        test::run_scene<2>(scene + formulation.second +
                           "Boundary conditions/Pressure on body = "
                           "right: 4*t; top: 4*t\n");
      double             worst = 0;
      const PointLayout &l     = problem->material_points().layout();
      for (const auto &point : problem->material_points().handler())
        for (const unsigned int i : {0, 1, 3})
          test::add_error(worst,
                          std::abs(point.get_properties()[l.stress + i] +
                                   (i < 2 ? 4 : 0)));
      test::check_error("follower pressure, " + formulation.first, worst, 1e-6);
      std::ostringstream details;
      for (const auto &iteration : test::recorded().newton.at(0).iterations)
        details << iteration.displacement << ' ';
      test::check("the follower pressure's tangent is consistent, " +
                    formulation.first,
                  test::recorded().newton.at(0).n_iterations() <= 6,
                  details.str());

      problem = test::run_scene<2>(
        scene + formulation.second +
        "Boundary conditions/Traction on body = right: 4*t, 0\n");
      worst = 0;
      for (const auto &point : problem->material_points().handler())
        {
          const auto values = point.get_properties();
          // nominal stress P_xx = σ_xx F_yy
          test::add_error(worst,
                          std::abs(values[l.stress] * values[l.F + 3] - 4));
          test::add_error(worst, std::abs(values[l.stress + 1]));
        }
      test::check_error("dead load, " + formulation.first, worst, 1e-6);
    }
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_confined_j2<2>(0.5);
  test_confined_j2<2>(-0.3);
  test_confined_j2<3>(-0.3);
  test_confined_mohr_coulomb<2>(0, 0);
  test_confined_mohr_coulomb<2>(20, 0);
  test_confined_mohr_coulomb<2>(20, 20);
  test_confined_mohr_coulomb<3>(0, 0);
  test_confined_mohr_coulomb<3>(20, 10);
  test_surface_loads();
  test_cylinder();
  test_footing();
  return 0;
}
