/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Single stress points against independent closed-form values, states at which
// return maps and spectral formulas tend to break, and wrong parameters.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "closed_form_stresses.h"
#include "material_test_tools.h"

using namespace isochor;

const double G_1000 = 1000 / 2.6, K_1000 = 1000 / 1.2; // E = 1000, nu = 0.3

template <int dim>
void
test_neo_hookean()
{
  test::WorstError error;
  unsigned int     n_states = 0;
  for (const NeoHookeanState &state : neo_hookean_states)
    {
      if (dim == 2 && state.stretch[2] != 1)
        continue;
      ++n_states;
      const auto material =
        test::make_material<dim>("Neo-Hookean",
                                 "set Young modulus = 70\n"
                                 "set Poisson ratio = " +
                                   Patterns::Tools::to_string(state.nu));
      test::Point<dim> point(*material);
      Tensor<2, dim>   F;
      for (unsigned int i = 0; i < dim; ++i)
        F[i][i] = state.stretch[i];
      F[0][1] = state.shear;
      point.evaluate(F);

      const double J = determinant(F);
      const double scale =
        std::abs(state.cauchy[0]) + std::abs(state.cauchy[3]);
      const auto  &tau        = point.response.deviatoric_stress;
      const double computed[] = {tau[0][0], tau[1][1], tau[2][2], tau[0][1]};
      for (unsigned int i = 0; i < 4; ++i)
        error.add(std::abs(computed[i] / J -
                           (state.cauchy[i] - (i < 3 ? state.mean : 0))) /
                    scale,
                  "deviator, state " + std::to_string(n_states));
      error.add(std::abs(point.response.volumetric_strain -
                         material->inverse_bulk_modulus() * state.mean) *
                  material->shear_modulus() / scale,
                "theta, state " + std::to_string(n_states));
    }
  std::cout << n_states << " states, ";
  error.report("Neo-Hookean, dim " + std::to_string(dim), 1e-10);
}

/** A history that holds @p principal values of b^e along the columns of @p Q,
 * and zero plastic strain. */
template <int dim>
std::vector<double>
history_of(const std::array<double, 3> &principal, const Tensor<2, 3> &Q)
{
  Tensor<2, 3> b;
  for (unsigned int i = 0; i < 3; ++i)
    b[i][i] = principal[i];
  const SymmetricTensor<2, 3> b_rotated = symmetrize(Q * b * transpose(Q));
  std::vector<double>         history(n_symmetric_components<dim> + 1);
  for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
    history[i] = b_rotated.access_raw_entry(i);
  return history;
}

/** Evaluate a point that has b^e = @p principal along @p Q before the step and
 * J = @p J, and does not move in it. */
template <int dim>
test::Point<dim>
evaluate_history(const MaterialModel<dim>    &material,
                 const std::array<double, 3> &principal,
                 const Tensor<2, 3>          &Q,
                 const double                 J)
{
  test::Point<dim> point(material);
  point.history_n = history_of<dim>(principal, Q);
  Kinematics<dim> kinematics;
  kinematics.set_increment(unit_symmetric_tensor<dim>());
  kinematics.F = unit_symmetric_tensor<dim>();
  kinematics.J = J;
  point.status = material.evaluate(kinematics,
                                   point.history_n.data(),
                                   point.history.data(),
                                   point.response);
  return point;
}

const std::array<unsigned int, 3> permutations[] = {{{0, 1, 2}},
                                                    {{1, 2, 0}},
                                                    {{2, 0, 1}},
                                                    {{0, 2, 1}},
                                                    {{2, 1, 0}},
                                                    {{1, 0, 2}}};

/** | Q^T t Q - diag(expected) |. */
double
principal_error(const SymmetricTensor<2, 3> &t,
                const Tensor<2, 3>          &Q,
                const std::array<double, 3> &expected)
{
  Tensor<2, 3> difference = transpose(Q) * Tensor<2, 3>(t) * Q;
  for (unsigned int i = 0; i < 3; ++i)
    difference[i][i] -= expected[i];
  return difference.norm();
}

/** The trial stress is D ε with the Hencky strains of the history, the first
 * time; in 3D also as one step from the virgin state. */
template <int dim>
void
test_mohr_coulomb()
{
  test::Random     random;
  test::WorstError error;
  unsigned int     n_case = 0;
  for (const MohrCoulombReturn &state : mohr_coulomb_returns)
    {
      const auto material = test::make_material<dim>(
        "Mohr-Coulomb",
        "set Young modulus = 1000\nset Poisson ratio = 0.3\n"
        "subsection Mohr-Coulomb\n"
        "set Cohesion = " +
          std::to_string(state.cohesion) +
          "\nset Friction angle = " + std::to_string(state.phi) +
          "\nset Dilation angle = " + std::to_string(state.psi) + "\nend");
      const double mean =
        (state.trial[0] + state.trial[1] + state.trial[2]) / 3;
      const double J = std::exp(mean / K_1000);
      const double plastic_norm =
        std::sqrt(2. / 3. *
                  (state.plastic_strain[0] * state.plastic_strain[0] +
                   state.plastic_strain[1] * state.plastic_strain[1] +
                   state.plastic_strain[2] * state.plastic_strain[2]));
      for (const auto &permutation : permutations)
        {
          const Tensor<2, 3> Q =
            test::in_space(random.template rotation<dim>());
          std::array<double, 3> b, expected;
          for (unsigned int i = 0; i < 3; ++i)
            {
              const unsigned int A = permutation[i];
              const double       strain =
                (state.trial[A] - mean) / (2 * G_1000) + mean / (3 * K_1000);
              b[i]        = std::exp(2 * strain);
              expected[i] = state.stress[A];
            }
          const std::string where = "case " + std::to_string(n_case);
          const auto        check = [&](const test::Point<dim> &point) {
            const SymmetricTensor<2, 3> tau =
              test::kirchhoff_stress(*material, point.response, 1);
            error.add(principal_error(tau, Q, expected) / 50, where);
            error.add(std::abs(point.history[n_symmetric_components<dim>] -
                               plastic_norm) /
                        0.01,
                      where + ", plastic strain");
          };
          check(evaluate_history<dim>(*material, b, Q, J));
          if (dim == 3)
            {
              Tensor<2, dim> V;
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < dim; ++j)
                  for (unsigned int k = 0; k < dim; ++k)
                    V[i][j] += Q[i][k] * std::sqrt(b[k]) * Q[j][k];
              test::Point<dim> point(*material);
              point.evaluate(V);
              check(point);
            }
        }
      ++n_case;
    }
  error.report("Mohr-Coulomb returns, dim " + std::to_string(dim), 1e-10);
}

/** In logarithmic strains the radial return is that of small strains: the trial
 * state with a given dev τ is b̄^e = exp(dev τ / G). */
template <int dim>
void
test_j2()
{
  test::Random     random;
  test::WorstError error;
  unsigned int     n_case = 0;
  for (const J2Return &state : j2_returns)
    {
      const auto material =
        test::make_material<dim>("J2",
                                 "set Young modulus = 1000\n"
                                 "set Poisson ratio = 0.3\n"
                                 "subsection J2\nset Yield stress = " +
                                   std::to_string(state.yield_stress) +
                                   "\nend");
      const double mean =
        (state.trial[0] + state.trial[1] + state.trial[2]) / 3;
      for (const auto &permutation : permutations)
        {
          const Tensor<2, 3> Q =
            test::in_space(random.template rotation<dim>());
          std::array<double, 3> b, expected;
          for (unsigned int i = 0; i < 3; ++i)
            {
              b[i] = std::exp((state.trial[permutation[i]] - mean) / G_1000);
              expected[i] = state.stress[permutation[i]] - mean;
            }
          const test::Point<dim> point =
            evaluate_history<dim>(*material, b, Q, 1);
          const std::string where = "case " + std::to_string(n_case);
          error.add(principal_error(point.response.deviatoric_stress,
                                    Q,
                                    expected) /
                      100,
                    where);
          error.add(std::abs(point.history[n_symmetric_components<dim>] -
                             state.plastic_strain) /
                      0.1,
                    where + ", plastic strain");
        }
      ++n_case;
    }
  error.report("J2 returns, dim " + std::to_string(dim), 1e-10);
}

/** A bar (in plane strain: a sheet) of which each step makes exp(1/n) of its
 * length: where directions stay the return map is exact, whatever the step.
 * 3G (√(2/3) |e| - α) = σ_Y + H α. */
template <int dim>
void
test_stretched_j2()
{
  const double hardening = 300, yield_stress = 100;
  const auto   material =
    test::make_material<dim>("J2",
                             "set Young modulus = 1000\n"
                             "set Poisson ratio = 0.3\n"
                             "subsection J2\nset Yield stress = 100\n"
                             "set Hardening modulus = 300\nend");
  const double strain = dim == 2 ? 2 / std::sqrt(3.) : 1.;
  const double alpha =
    (3 * G_1000 * strain - yield_stress) / (3 * G_1000 + hardening);
  test::WorstError error;
  for (const unsigned int n_steps : {1, 4, 40})
    {
      test::Point<dim> point(*material);
      Tensor<2, dim>   step(unit_symmetric_tensor<dim>());
      for (unsigned int i = 0; i < dim; ++i)
        step[i][i] = std::exp((i == 0 ? 1. : -1. / (dim - 1)) / n_steps);
      for (unsigned int i = 0; i < n_steps; ++i)
        {
          point.evaluate(step);
          if (i + 1 < n_steps)
            point.commit(step);
        }
      const std::string where = std::to_string(n_steps) + " steps";
      error.add(std::abs(point.history[n_symmetric_components<dim>] - alpha),
                where + ", plastic strain");
      error.add(std::abs(std::sqrt(1.5) *
                           point.response.deviatoric_stress.norm() /
                           (yield_stress + hardening * alpha) -
                         1),
                where + ", stress");
    }
  error.report("J2, a bar stretched to e, dim " + std::to_string(dim), 1e-12);
}

/** Without a trial state to return from there is nothing to compute: reported,
 * not silently wrong. */
template <int dim>
void
test_failure_is_reported()
{
  std::istringstream names(PluginRegistry<MaterialModel<dim>>::names());
  bool               reported = true;
  for (std::string name; std::getline(names, name, '|');)
    {
      const auto       material = test::make_material<dim>(name);
      test::Point<dim> point(*material);
      Tensor<2, dim>   F(unit_symmetric_tensor<dim>());
      F[0][1] = std::numeric_limits<double>::quiet_NaN();
      point.evaluate(F);
      reported = reported && point.status == StressStatus::return_map_failed;
    }
  test::report("not-a-number is reported, dim " + std::to_string(dim),
               reported,
               "status is success");
}

void
test_rejected(const std::string &name,
              const std::string &settings,
              const std::string &parameter)
{
  std::string message = "accepted";
  try
    {
      test::make_material<2>(name, settings);
    }
  catch (const std::exception &exception)
    {
      message = exception.what();
    }
  test::report(parameter + " out of range is named",
               message.find(parameter) != std::string::npos,
               message);
}

/** With 1/K = 0 and friction K θ^e says nothing: only u-p has a mean stress. */
void
test_pressure_is_needed()
{
  const auto material =
    test::make_material<2>("Mohr-Coulomb",
                           "set Poisson ratio = 0.5\nsubsection "
                           "Mohr-Coulomb\nset Friction angle = 20\nend");
  test::Point<2> point(*material);
  point.evaluate(Tensor<2, 2>(unit_symmetric_tensor<2>()));
  const bool fails = point.status == StressStatus::return_map_failed;
  point.pressure   = 0.;
  point.evaluate(Tensor<2, 2>(unit_symmetric_tensor<2>()));
  test::report("friction and nu = 0.5 need the pressure",
               fails && point.status == StressStatus::success,
               "failed " + std::to_string(fails));
}

int
main()
{
  test_neo_hookean<2>();
  test_neo_hookean<3>();
  test_mohr_coulomb<2>();
  test_mohr_coulomb<3>();
  test_j2<2>();
  test_j2<3>();
  test_stretched_j2<2>();
  test_stretched_j2<3>();
  test_failure_is_reported<2>();
  test_failure_is_reported<3>();

  test_rejected("Neo-Hookean", "set Young modulus = 0", "<Young modulus>");
  test_rejected("Neo-Hookean", "set Poisson ratio = 0.51", "<Poisson ratio>");
  test_rejected("Neo-Hookean", "set Density = -1", "<Density>");
  const std::string j2 = "subsection J2\nset ",
                    mc = "subsection Mohr-Coulomb\nset ";
  test_rejected("J2", j2 + "Yield stress = 0\nend", "<J2/Yield stress>");
  test_rejected("J2",
                j2 + "Hardening modulus = -1\nend",
                "<J2/Hardening modulus>");
  test_rejected("J2",
                j2 + "Saturation exponent = 3\nend",
                "<J2/Saturation stress>");
  test_rejected("Mohr-Coulomb",
                mc + "Cohesion = 0\nend",
                "<Mohr-Coulomb/Cohesion>");
  test_rejected("Mohr-Coulomb",
                mc + "Friction angle = 90\nend",
                "<Mohr-Coulomb/Friction angle>");
  test_rejected("Mohr-Coulomb",
                mc + "Dilation angle = 1\nend",
                "<Mohr-Coulomb/Dilation angle>");
  test_pressure_is_needed();
  return 0;
}
