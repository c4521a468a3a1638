/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// For every registered material model, and so for a new one without being
// asked: the tangents against finite differences along random strain paths
// and at special states, the symmetry that is claimed, and objectivity.

#include <isochor/material_model/tensor_tools.h>

#include <algorithm>

#include "material_test_tools.h"

using namespace isochor;

/** The spatial modulus and ∂θ^e/∂d by central differences of step h, applied
 * to one velocity gradient l. */
template <int dim>
struct Difference
{
  Tensor<2, dim> stress;
  double         theta;

  Difference(test::Point<dim>     &point,
             const Tensor<2, dim> &F_increment,
             const Tensor<2, dim> &l,
             const double          h)
  {
    const Tensor<2, dim> one(unit_symmetric_tensor<dim>());

    const StressResponse<dim> plus =
      point.evaluate((one + h * l) * F_increment);
    const StressResponse<dim> minus =
      point.evaluate((one - h * l) * F_increment);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        stress[i][j] =
          (plus.deviatoric_stress[i][j] - minus.deviatoric_stress[i][j]) /
          (2 * h);
    theta = (plus.volumetric_strain - minus.volumetric_strain) / (2 * h);
  }
};

/** Only failures are printed one by one: the expected output shall not change
 * when a material is added. */
bool all_passed = true;

void
expect(const std::string &what, const bool ok, const std::string &details)
{
  all_passed = all_passed && ok;
  if (!ok)
    test::report(what, false, details);
}

void
expect(const std::string      &what,
       const test::WorstError &error,
       const double            tolerance)
{
  expect(what,
         error.value <= tolerance,
         "error " + std::to_string(error.value) + " at " + error.where);
}

struct TangentErrors
{
  double error   = 0;     ///< relative to the tangent's norm, or to 2 G
  bool   at_kink = false; ///< the stress is not differentiable nearby

  void
  add(const double e)
  {
    if (!(e <= error))
      error = (e == e ? e : 1e300);
  }
};

/** The derivatives with respect to the given pressure, made dimensionless by
 * G. */
template <int dim>
void
check_pressure_tangents(test::Point<dim>          &point,
                        const Tensor<2, dim>      &F_increment,
                        const StressResponse<dim> &response,
                        TangentErrors             &result)
{
  const double G = point.material.shear_modulus(), p = *point.pressure;
  SymmetricTensor<2, dim> stress[2];
  double                  theta[2];
  for (const unsigned int i : {0, 1})
    {
      const double h = (i + 1) * 2e-6 * G;
      for (const int sign : {-1, 1})
        {
          point.pressure               = p + sign * h;
          const StressResponse<dim> &r = point.evaluate(F_increment);
          stress[i] += sign / (2 * h) * in_plane<dim>(r.deviatoric_stress);
          theta[i] = (sign < 0 ? 0. : theta[i]) +
                     sign * r.volumetric_strain / (2 * h) * G;
        }
    }
  point.pressure = p;
  if ((stress[0] - stress[1]).norm() > 1e-7 ||
      std::abs(theta[0] - theta[1]) > 1e-7)
    result.at_kink = true;
  result.add((stress[0] - response.deviatoric_pressure_tangent).norm());
  result.add(std::abs(theta[0] - response.volumetric_pressure_tangent * G));
}

template <int dim>
TangentErrors
check_tangents(test::Point<dim> &point, const Tensor<2, dim> &F_increment)
{
  const StressResponse<dim> response = point.evaluate(F_increment);
  const double              scale =
    std::max(response.tangent.norm(), 2 * point.material.shear_modulus());

  TangentErrors result;
  if (point.status != StressStatus::success)
    result.error = 1e300;
  for (unsigned int k = 0; k < dim * dim; ++k)
    {
      Tensor<2, dim> l;
      l[k / dim][k % dim] = 1;

      const double          h = 2e-6;
      const Difference<dim> fine(point, F_increment, l, h);
      const Difference<dim> coarse(point, F_increment, l, 2 * h);
      if ((fine.stress - coarse.stress).norm() > 1e-7 * scale ||
          std::abs(fine.theta - coarse.theta) > 1e-7)
        result.at_kink = true;

      const SymmetricTensor<2, dim> modulus = response.tangent * symmetrize(l);
      Tensor<2, dim>                expected;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            expected[i][j] = modulus[i][j];
            for (unsigned int m = 0; m < dim; ++m)
              expected[i][j] += l[i][m] * response.deviatoric_stress[m][j] +
                                response.deviatoric_stress[i][m] * l[j][m];
          }
      const double theta_error =
        fine.theta - response.volumetric_tangent * symmetrize(l);
      result.add((fine.stress - expected).norm() / scale);
      result.add(std::abs(theta_error));
    }
  if (point.pressure)
    check_pressure_tangents(point, F_increment, response, result);
  return result;
}

/** Whether u and u-p get symmetric matrices from @p response. */
template <int dim>
double
asymmetry(const MaterialModel<dim>  &material,
          const StressResponse<dim> &response,
          const double               J)
{
  const double s =
    (material.volumetric_measure() == VolumetricMeasure::jacobian ? J : 1.);
  double worst =
    (response.volumetric_tangent - s * unit_symmetric_tensor<dim>()).norm();
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int l = 0; l < dim; ++l)
          worst = std::max(worst,
                           std::abs(response.tangent[i][j][k][l] -
                                    response.tangent[k][l][i][j]) /
                             response.tangent.norm());
  return worst;
}

template <int dim>
void
test_tangents(const std::string        &label,
              const MaterialModel<dim> &material,
              const bool                at_pressure)
{
  const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
  test::Random         random;
  test::WorstError     tangent, unsymmetric;
  unsigned int         n_kinks = 0;
  const unsigned int   n_paths = 1000, n_steps = 4;
  for (unsigned int path = 0; path < n_paths; ++path)
    {
      test::Point<dim> point(material);
      const double     amplitude = 0.15 * std::abs(random());
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          const Tensor<2, dim> F_increment =
            one + random.template gradient<dim>(amplitude);
          const std::string where =
            "path " + std::to_string(path) + ", step " + std::to_string(step);
          if (at_pressure)
            point.pressure =
              2 * amplitude * material.shear_modulus() * random();

          const TangentErrors errors = check_tangents(point, F_increment);
          if (errors.at_kink)
            ++n_kinks;
          else
            tangent.add(errors.error, where);

          point.evaluate(F_increment);
          if (material.has_symmetric_tangent())
            unsymmetric.add(asymmetry(material,
                                      point.response,
                                      determinant(F_increment * point.F)),
                            where);
          point.commit(F_increment);
        }
    }
  expect(label + ", tangents, random paths", tangent, 1e-6);
  expect(label + ", few states at kinks",
         n_kinks < 0.02 * n_paths * n_steps,
         std::to_string(n_kinks) + " states");
  expect(label + ", symmetry as claimed", unsymmetric, 1e-12);
}

/** Equal and nearly equal principal values, no strain, pure dilation (the
 * apex, where there is one) and compression. */
template <int dim>
void
test_special_states(const std::string        &label,
                    const MaterialModel<dim> &material,
                    const bool                at_pressure)
{
  test::WorstError tangent, continuity;
  const auto       check = [&](const double x, const double y, const double z) {
    test::Point<dim> point(material);
    // below the apex: beyond it θ^e has a kink where the deviator vanishes
    if (at_pressure)
      point.pressure = -0.01 * material.shear_modulus();
    Tensor<2, dim> F;
    F[0][0]             = x;
    F[1][1]             = y;
    F[dim - 1][dim - 1] = (dim == 3 ? z : y);

    const TangentErrors errors = check_tangents(point, F);
    tangent.add(errors.at_kink ? 1e300 : errors.error,
                std::to_string(x) + " " + std::to_string(y) + " " +
                  std::to_string(z));

    const SymmetricTensor<4, dim> at_equality = point.evaluate(F).tangent;
    const double scale = std::max(at_equality.norm(), material.shear_modulus());
    for (double gap = 1e-6; gap > 1e-17; gap /= 10)
      {
        Tensor<2, dim> F_near = F;
        F_near[1][1] += gap;
        F_near[0][1] += gap;
        continuity.add((point.evaluate(F_near).tangent - at_equality).norm() /
                         scale,
                       "gap " + std::to_string(gap));
      }
  };
  check(1, 1, 1);
  check(1.2, 1.2, 1.2);
  check(0.8, 0.8, 0.8);
  check(1.2, 1.2, 0.9);
  check(0.8, 0.8, 1.15);
  check(1.3, 0.8, 0.8);
  check(0.8, 1.3, 0.8);
  expect(label + ", tangents, special states", tangent, 1e-6);
  expect(label + ", continuous at equal principal values", continuity, 1e-3);
}

template <int dim>
void
test_objectivity(const std::string &label, const MaterialModel<dim> &material)
{
  const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
  test::Random         random;
  test::WorstError     rotated, history;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const Tensor<2, dim> first  = one + random.template gradient<dim>(0.1);
      const Tensor<2, dim> second = one + random.template gradient<dim>(0.1);
      const Tensor<2, dim> Q      = random.template rotation<dim>();
      const Tensor<2, 3>   Q_3    = test::in_space(Q);

      // Q F gives Q τ Q^T ...
      test::Point<dim> still(material), turned(material);
      if (material.depends_on_pressure())
        still.pressure = turned.pressure =
          0.1 * material.shear_modulus() * random();
      const SymmetricTensor<2, 3> stress =
        still.evaluate(first).deviatoric_stress;
      const SymmetricTensor<2, 3> turned_stress =
        turned.evaluate(Q * first).deviatoric_stress;
      const double scale = std::max(stress.norm(), material.shear_modulus());
      const Tensor<2, 3> difference =
        Tensor<2, 3>(turned_stress) -
        Q_3 * Tensor<2, 3>(stress) * transpose(Q_3);
      rotated.add(difference.norm() / scale, std::to_string(i));

      // ... and a history that remembers it: turned back, nothing happened.
      still.commit(first);
      turned.commit(Q * first);
      history.add((still.evaluate(second).deviatoric_stress -
                   turned.evaluate(second * transpose(Q)).deviatoric_stress)
                      .norm() /
                    scale,
                  std::to_string(i));
    }
  expect(label + ", objectivity", rotated, 1e-12);
  expect(label + ", objectivity of the history", history, 1e-12);
}

template <int dim>
void
test_material(const std::string &name, const std::string &settings = "")
{
  const auto        material = test::make_material<dim>(name, settings);
  const std::string label    = name +
                            (settings.empty() ? "" : " [" + settings + "]") +
                            ", dim " + std::to_string(dim);
  // One line per label.
  std::string one_line = label;
  std::replace(one_line.begin(), one_line.end(), '\n', ';');

  if (material->inverse_bulk_modulus() > 0 || !material->depends_on_pressure())
    {
      test_tangents(one_line, *material, false);
      test_special_states(one_line, *material, false);
    }
  if (material->depends_on_pressure())
    {
      test_tangents(one_line + ", at given p", *material, true);
      test_special_states(one_line + ", at given p", *material, true);
    }
  test_objectivity(one_line, *material);
}

template <int dim>
void
test_all()
{
  // With the defaults of each: what a new law gets.
  std::istringstream names(PluginRegistry<MaterialModel<dim>>::names());
  for (std::string name; std::getline(names, name, '|');)
    test_material<dim>(name);
  test::report("all registered models, defaults, dim " + std::to_string(dim),
               all_passed,
               "see above");

  // More corners of those we know.
  test_material<dim>("Neo-Hookean", "set Poisson ratio = 0.5");
  test_material<dim>("J2",
                     "set Poisson ratio = 0.5\n"
                     "subsection J2\n"
                     "set Yield stress = 1e5\n"
                     "set Hardening modulus = 2e5\n"
                     "end");
  test_material<dim>("J2",
                     "subsection J2\n"
                     "set Yield stress = 5e4\n"
                     "set Saturation stress = 1e5\n"
                     "set Saturation exponent = 20\n"
                     "end");
  test_material<dim>("Mohr-Coulomb", "set Poisson ratio = 0.5");
  for (const std::string angles : {"30 30", "30 0", "35 10", "10 10"})
    test_material<dim>("Mohr-Coulomb",
                       "subsection Mohr-Coulomb\n"
                       "set Friction angle = " +
                         angles.substr(0, 2) + "\nset Dilation angle = " +
                         angles.substr(3) + "\nend");
  test_material<dim>("Mohr-Coulomb",
                     "set Poisson ratio = 0.5\n"
                     "subsection Mohr-Coulomb\n"
                     "set Friction angle = 20\n"
                     "set Dilation angle = 20\n"
                     "end");
  test::report("further parameters, dim " + std::to_string(dim),
               all_passed,
               "see above");
}

int
main()
{
  test_all<2>();
  test_all<3>();
  return 0;
}
