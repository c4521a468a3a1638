/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// 10^5 random strain paths per plastic law: never fails, never leaves the yield
// surface, keeps the invariants of its flow; and, for Mohr-Coulomb, the plastic
// strain of every return lies in the cone of the flow rule.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "material_test_tools.h"

using namespace isochor;

std::array<double, 3>
principal_values(const SymmetricTensor<2, 3> &t)
{
  const auto pairs = eigenvectors(t, SymmetricTensorEigenvectorMethod::jacobi);
  std::array<double, 3> values = {
    {pairs[0].first, pairs[1].first, pairs[2].first}};
  std::sort(values.begin(), values.end(), std::greater<double>());
  return values;
}

/** Run paths of four steps of very different sizes; call
 * check(point, F_increment, label) after each. */
template <int dim, typename Check>
void
run_paths(const MaterialModel<dim> &material,
          const unsigned int        n_paths,
          const Check              &check)
{
  const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
  test::Random         random;
  for (unsigned int path = 0; path < n_paths; ++path)
    {
      test::Point<dim> point(material);
      const double     amplitude = std::pow(10., -2.5 + 2 * random());
      for (unsigned int step = 0; step < 4; ++step)
        {
          const Tensor<2, dim> F_increment =
            one + random.template gradient<dim>(std::min(0.3, amplitude));
          point.evaluate(F_increment);
          check(point,
                F_increment,
                "path " + std::to_string(path) + ", step " +
                  std::to_string(step));
          point.commit(F_increment);
        }
    }
}

template <int dim>
void
test_j2(const unsigned int n_paths,
        const double       hardening,
        const double       saturation,
        const double       exponent)
{
  const auto material = test::make_material<dim>(
    "J2",
    "subsection J2\nset Yield stress = 1e4\nset Hardening modulus = " +
      std::to_string(hardening) +
      "\nset Saturation stress = " + std::to_string(saturation) +
      "\nset Saturation exponent = " + std::to_string(exponent) + "\nend");
  test::WorstError surface, determinant_b;
  unsigned int     n_failed = 0, n_plastic = 0;
  run_paths<dim>(
    *material,
    n_paths,
    [&](const test::Point<dim> &point,
        const Tensor<2, dim> &,
        const std::string &where) {
      const double alpha = point.history[n_symmetric_components<dim>];
      const double yield_stress =
        1e4 + hardening * alpha +
        (saturation - 1e4) * (1 - std::exp(-exponent * alpha));
      const double norm = point.response.deviatoric_stress.norm();
      surface.add(std::max(0., norm / (std::sqrt(2. / 3.) * yield_stress) - 1),
                  where);
      SymmetricTensor<2, 3> b;
      for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
        b.access_raw_entry(i) = point.history[i];
      determinant_b.add(std::abs(determinant(b) - 1), where);
      n_failed += (point.status != StressStatus::success);
      n_plastic += (alpha > point.history_n[n_symmetric_components<dim>]);
      if (alpha < point.history_n[n_symmetric_components<dim>])
        surface.add(1, where + ", plastic strain fell");
    });
  const std::string label =
    "J2, H = " + Patterns::Tools::to_string(hardening) +
    ", delta = " + Patterns::Tools::to_string(exponent) + ", dim " +
    std::to_string(dim);
  test::report(label + ", success, elastic and plastic steps",
               n_failed == 0 && n_plastic > n_paths && n_plastic < 4 * n_paths,
               std::to_string(n_failed) + " failed");
  surface.report(label + ", yield surface", 1e-9);
  determinant_b.report(label + ", det of elastic strain", 1e-10);
}

/**
 * How far the plastic strain increment @p e is from the cone of the flow rule
 * at the stress @p tau (both principal, in descending order): on a plane e = λ
 * (1 + sin ψ, 0, -(1 - sin ψ)); on an edge the sum of two such; at the apex the
 * cone of all six, which the planes through adjacent ones bound.
 */
double
flow_rule_violation(const std::array<double, 3> &e,
                    const std::array<double, 3> &tau,
                    const double                 sin_psi,
                    const double                 stress_tolerance)
{
  const double larger = 1 + sin_psi, smaller = 1 - sin_psi;
  const bool   equal_1_2   = tau[0] - tau[1] < stress_tolerance;
  const bool   equal_2_3   = tau[1] - tau[2] < stress_tolerance;
  const double on_edge_1_2 = smaller * (e[0] + e[1]) + larger * e[2];
  const double on_edge_2_3 = smaller * e[0] + larger * (e[1] + e[2]);
  if (equal_1_2 && equal_2_3)
    return std::max({0., -on_edge_1_2, -on_edge_2_3});
  else if (equal_1_2)
    return std::max({std::abs(on_edge_1_2), -e[1], -e[0]});
  else if (equal_2_3)
    return std::max({std::abs(on_edge_2_3), e[1], e[2]});
  else
    return std::max(
      {std::abs(e[1]), std::abs(smaller * e[0] + larger * e[2]), -e[0]});
}

/** E = 1e6; the default cohesion is 1e4. */
template <int dim>
void
test_mohr_coulomb(const unsigned int n_paths,
                  const double       nu,
                  const double       phi,
                  const double       psi,
                  const double       cohesion = 1e4)
{
  const auto material = test::make_material<dim>(
    "Mohr-Coulomb",
    "set Poisson ratio = " + Patterns::Tools::to_string(nu) +
      "\nsubsection Mohr-Coulomb\nset Cohesion = " + std::to_string(cohesion) +
      "\nset Friction angle = " + std::to_string(phi) +
      "\nset Dilation angle = " + std::to_string(psi) + "\nend");
  const double sin_phi = std::sin(phi * numbers::PI / 180);
  const double sin_psi = std::sin(psi * numbers::PI / 180);
  const double c_cos   = cohesion * std::cos(phi * numbers::PI / 180);
  const double G       = material->shear_modulus();

  test::WorstError surface, volume, flow;
  unsigned int     n_failed = 0, n_plastic = 0, n_apex = 0;
  const auto       check = [&](const test::Point<dim> &point,
                         const Tensor<2, dim>   &F_increment,
                         const std::string      &where) {
    if (point.status != StressStatus::success)
      {
        ++n_failed;
        return;
      }
    const double          mean = (phi == 0 ? 0. :
                                                   point.response.volumetric_strain /
                                      material->inverse_bulk_modulus());
    std::array<double, 3> tau =
      principal_values(point.response.deviatoric_stress);
    for (double &t : tau)
      t += mean;
    const double scale =
      2 * c_cos + std::abs(tau[0]) + std::abs(tau[1]) + std::abs(tau[2]);
    const double f =
      (tau[0] - tau[2]) + (tau[0] + tau[2]) * sin_phi - 2 * c_cos;
    // G times rounding of strains of order one is what stresses are worth.
    surface.add(std::max(0., f) / std::max(scale, 1e-4 * G), where);
    if (phi == 0)
      volume.add(std::abs(point.response.volumetric_strain -
                          std::log(determinant(F_increment * point.F))),
                 where);

    const double increment = point.history[n_symmetric_components<dim>] -
                             point.history_n[n_symmetric_components<dim>];
    n_plastic += (increment > 0);
    n_apex += (increment > 0 && tau[0] - tau[2] < 1e-9 * G);
    if (increment < 0)
      surface.add(1, where + ", plastic strain fell");
    if (increment < 1e-9)
      return;

    // Δε^p = ε_trial - ε^e, coaxial: compare the sorted principal strains.
    SymmetricTensor<2, 3> b_n, b;
    for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
      {
        b_n.access_raw_entry(i) = point.history_n[i];
        b.access_raw_entry(i)   = point.history[i];
      }
    const Tensor<2, 3>          F_3 = test::in_space(F_increment);
    const std::array<double, 3> trial =
      principal_values(symmetrize(F_3 * Tensor<2, 3>(b_n) * transpose(F_3)));
    const std::array<double, 3> elastic = principal_values(b);
    std::array<double, 3>       e;
    for (unsigned int i = 0; i < 3; ++i)
      e[i] = 0.5 * std::log(trial[i] / elastic[i]) / increment;
    flow.add(flow_rule_violation(e, tau, sin_psi, 1e-8 * G), where);
  };
  run_paths<dim>(*material, n_paths, check);

  const std::string label =
    "Mohr-Coulomb, nu = " + Patterns::Tools::to_string(nu) +
    ", phi = " + Patterns::Tools::to_string(phi) +
    ", psi = " + Patterns::Tools::to_string(psi) + ", dim " +
    std::to_string(dim);
  test::report(label + ", success, elastic, plastic and apex steps",
               n_failed == 0 && n_plastic > n_paths / 2 &&
                 (cohesion == 0 || n_plastic < 4 * n_paths) &&
                 (n_apex > 0) == (phi > 0),
               std::to_string(n_failed) + " failed, " +
                 std::to_string(n_plastic) + " plastic, " +
                 std::to_string(n_apex) + " apex");
  surface.report(label + ", yield surface", 1e-9);
  flow.report(label + ", flow rule", 1e-6);
  if (phi == 0)
    volume.report(label + ", isochoric flow", 1e-12);
}

template <int dim>
void
test_all()
{
  test_j2<dim>(17000, 0, 0, 0);
  test_j2<dim>(17000, 1e5, 0, 0);
  test_j2<dim>(17000, 1e4, 3e4, 30);

  test_mohr_coulomb<dim>(10000, 0.3, 0, 0);
  test_mohr_coulomb<dim>(10000, 0.5, 0, 0);
  test_mohr_coulomb<dim>(10000, 0.3, 30, 30);
  test_mohr_coulomb<dim>(10000, 0.3, 30, 0);
  test_mohr_coulomb<dim>(10000, 0.2, 40, 10);
  test_mohr_coulomb<dim>(10000, 0.45, 10, 5, 0);
}

int
main()
{
  test_all<2>();
  test_all<3>();
  return 0;
}
