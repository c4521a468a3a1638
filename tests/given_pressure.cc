/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The return map of Mohr-Coulomb at a given mean stress, as u-p uses it: where
// p = K θ^e it gives the stress and the history of the map that u uses, for any
// p it gives a stress on or inside the surface, and both stress and θ^e are
// continuous at the apex.

#include <algorithm>
#include <array>
#include <cmath>

#include "closed_form_stresses.h"
#include "material_test_tools.h"

using namespace isochor;

struct Parameters
{
  double nu, phi, psi, cohesion; // degrees, Pa
};

template <int dim>
std::unique_ptr<MaterialModel<dim>>
mohr_coulomb(const Parameters &x, const std::string &young_modulus = "1e6")
{
  return test::make_material<dim>(
    "Mohr-Coulomb",
    "set Young modulus = " + young_modulus +
      "\nset Poisson ratio = " + Patterns::Tools::to_string(x.nu) +
      "\nsubsection Mohr-Coulomb\nset Cohesion = " +
      Patterns::Tools::to_string(x.cohesion) +
      "\nset Friction angle = " + Patterns::Tools::to_string(x.phi) +
      "\nset Dilation angle = " + Patterns::Tools::to_string(x.psi) + "\nend");
}

std::string
name(const Parameters &x, const int dim)
{
  return "nu = " + Patterns::Tools::to_string(x.nu) +
         ", phi = " + Patterns::Tools::to_string(x.phi) +
         ", psi = " + Patterns::Tools::to_string(x.psi) + ", dim " +
         std::to_string(dim);
}

std::array<double, 3>
principal_values(const SymmetricTensor<2, 3> &t)
{
  const auto pairs = eigenvectors(t, SymmetricTensorEigenvectorMethod::jacobi);
  std::array<double, 3> values = {
    {pairs[0].first, pairs[1].first, pairs[2].first}};
  std::sort(values.begin(), values.end(), std::greater<double>());
  return values;
}

/** τ at the given pressure. */
template <int dim>
SymmetricTensor<2, 3>
stress(const test::Point<dim> &point)
{
  return point.response.deviatoric_stress +
         *point.pressure * unit_symmetric_tensor<3>();
}

/** Find the p at which θ^e = p/K; θ^e falls with p. */
template <int dim>
void
solve_pressure(test::Point<dim>     &point,
               const Tensor<2, dim> &F_increment,
               const double          bound)
{
  double       low = -bound, high = bound;
  const double inverse_K = point.material.inverse_bulk_modulus();
  for (unsigned int i = 0; i < 120; ++i)
    {
      point.pressure = (low + high) / 2;
      point.evaluate(F_increment);
      (point.response.volumetric_strain > *point.pressure * inverse_K ? low :
                                                                        high) =
        *point.pressure;
    }
}

/** How often a return of u ended where. */
struct RegionCounts
{
  unsigned int elastic = 0, plane = 0, edge = 0, apex = 0;
};

/** Along random paths of u. */
template <int dim>
void
test_coincidence(const Parameters &x, RegionCounts &counts)
{
  const auto           material = mohr_coulomb<dim>(x);
  const double         G        = material->shear_modulus();
  const double         K        = 1 / material->inverse_bulk_modulus();
  const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
  test::Random         random;
  test::WorstError     tau, history;
  const unsigned int   n_paths = 1000;
  for (unsigned int path = 0; path < n_paths; ++path)
    {
      test::Point<dim> point(*material);
      const double     amplitude = std::pow(10., -2.5 + 1.5 * random());
      for (unsigned int step = 0; step < 3; ++step)
        {
          const Tensor<2, dim> F_increment =
            one + random.template gradient<dim>(amplitude);
          const std::string where =
            "path " + std::to_string(path) + ", step " + std::to_string(step);
          test::Point<dim> given = point;
          point.evaluate(F_increment);
          solve_pressure(given, F_increment, 3 * K);

          const auto expected =
            test::kirchhoff_stress(*material, point.response, 1);
          tau.add((stress(given) - expected).norm() / G, where);
          for (unsigned int i = 0; i < point.history.size(); ++i)
            history.add(std::abs(given.history[i] - point.history[i]), where);

          const auto   p         = principal_values(expected);
          const double tolerance = 1e-9 * G;
          const bool   equal_1_2 = p[0] - p[1] < tolerance;
          const bool   equal_2_3 = p[1] - p[2] < tolerance;
          const auto   n         = n_symmetric_components<dim>;
          if (point.history[n] == point.history_n[n])
            ++counts.elastic;
          else
            ++(equal_1_2 && equal_2_3 ? counts.apex :
               equal_1_2 || equal_2_3 ? counts.edge :
                                        counts.plane);
          point.commit(F_increment);
        }
    }
  const std::string label = name(x, dim);
  tau.report(label + ", stress where p = K theta", 1e-10);
  history.report(label + ", history where p = K theta", 1e-10);
}

/** Any p, on both sides of the apex. */
template <int dim>
void
test_surface(const Parameters &x)
{
  const auto           material = mohr_coulomb<dim>(x);
  const double         G        = material->shear_modulus();
  const double         sin_phi  = std::sin(x.phi * numbers::PI / 180);
  const double         c_cos = x.cohesion * std::cos(x.phi * numbers::PI / 180);
  const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
  test::Random         random;
  test::WorstError     surface, trace_of_deviator, continuity;
  unsigned int         n_failed = 0, n_beyond = 0;
  for (unsigned int path = 0; path < 5000; ++path)
    {
      test::Point<dim> point(*material);
      const double     amplitude =
        std::min(0.3, std::pow(10., -2.5 + 2 * random()));
      for (unsigned int step = 0; step < 4; ++step)
        {
          const std::string where =
            "path " + std::to_string(path) + ", step " + std::to_string(step);
          // the first path: nothing but volume change
          const Tensor<2, dim> F_increment =
            path == 0 ? (1 + 0.1 * random()) * one :
                        one + random.template gradient<dim>(amplitude);
          const double apex = c_cos / sin_phi;

          std::array<SymmetricTensor<2, 3>, 2> tau;
          std::array<double, 2>                theta;
          for (const unsigned int i : {0, 1})
            {
              point.pressure = apex + (2. * i - 1) * 1e-10 * G;
              point.evaluate(F_increment);
              tau[i]   = stress(point);
              theta[i] = point.response.volumetric_strain;
            }
          continuity.add((tau[1] - tau[0]).norm() / G, where + ", stress");
          continuity.add(std::abs(theta[1] - theta[0]), where + ", theta");

          point.pressure = 2 * amplitude * G * random();
          point.evaluate(F_increment);
          n_failed += (point.status != StressStatus::success);
          n_beyond += (*point.pressure > apex);
          const auto   p     = principal_values(stress(point));
          const double scale = 2 * c_cos + std::abs(*point.pressure) + 1e-4 * G;
          surface.add(
            std::max(0., (p[0] - p[2]) + (p[0] + p[2]) * sin_phi - 2 * c_cos) /
              scale,
            where);
          trace_of_deviator.add(std::abs(p[0] + p[1] + p[2] -
                                         3 * std::min(*point.pressure, apex)) /
                                  scale,
                                where);
          point.commit(F_increment);
        }
    }
  const std::string label = name(x, dim) + ", any p";
  test::report(label + ", success on both sides of the apex",
               n_failed == 0 && n_beyond > 1000 && n_beyond < 19000,
               std::to_string(n_failed) +
                 " failed, beyond: " + std::to_string(n_beyond));
  surface.report(label + ", yield surface", 1e-9);
  trace_of_deviator.report(label + ", mean stress", 1e-9);
  continuity.report(label + ", continuous at the apex", 1e-7);
}

/** Independent closed-form returns, their mean stress given. */
void
test_closed_forms()
{
  const double     K = 1000 / 1.2, G = 1000 / 2.6;
  test::WorstError error;
  unsigned int     n_states = 0;
  for (const MohrCoulombReturn &state : mohr_coulomb_returns)
    {
      if (state.phi == 0)
        continue;
      ++n_states;
      const auto material =
        mohr_coulomb<3>({0.3, state.phi, state.psi, state.cohesion}, "1000");
      const double mean =
        (state.trial[0] + state.trial[1] + state.trial[2]) / 3;
      test::Point<3> point(*material);
      Tensor<2, 3>   F;
      double         pressure = 0;
      for (unsigned int i = 0; i < 3; ++i)
        {
          F[i][i] =
            std::exp((state.trial[i] - mean) / (2 * G) + mean / (3 * K));
          pressure += state.stress[i] / 3;
        }
      point.pressure = pressure;
      point.evaluate(F);
      const std::string where = "state " + std::to_string(n_states);
      for (unsigned int i = 0; i < 3; ++i)
        error.add(std::abs(stress(point)[i][i] - state.stress[i]) / 50, where);
      // at the apex θ^e is anything that is not less
      const bool apex = state.stress[0] - state.stress[2] < 1e-9;
      error.add(apex ?
                  std::max(0.,
                           pressure / K - point.response.volumetric_strain) :
                  std::abs(point.response.volumetric_strain - pressure / K),
                where + ", theta");
    }
  std::cout << n_states << " states, ";
  error.report("closed-form returns", 1e-10);
}

template <int dim>
void
test_all()
{
  RegionCounts counts;
  for (const Parameters &x : {Parameters{0.3, 30, 30, 1e4},
                              Parameters{0.3, 30, 0, 1e4},
                              Parameters{0.2, 40, 10, 1e4},
                              Parameters{0.45, 10, 5, 0},
                              Parameters{0.499, 20, 20, 1e4}})
    {
      test_coincidence<dim>(x, counts);
      test_surface<dim>(x);
    }
  test::report(
    "all regions, dim " + std::to_string(dim),
    std::min({counts.elastic, counts.plane, counts.edge, counts.apex}) > 200,
    std::to_string(counts.elastic) + ' ' + std::to_string(counts.plane) + ' ' +
      std::to_string(counts.edge) + ' ' + std::to_string(counts.apex));
  test_surface<dim>({0.5, 20, 20, 1e4});
  test_surface<dim>({0.5, 35, 0, 1e3});
}

int
main()
{
  test_closed_forms();
  test_all<2>();
  test_all<3>();
  return 0;
}
