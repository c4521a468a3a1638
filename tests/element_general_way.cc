/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The general way to evaluate an element, point by point, against the fast one,
// and in bodies of revolution against finite differences.

#include "random_element.h"

/** MixedKernel::evaluate_points() is the same as evaluate() where both can be
 * used. */
template <int dim, int n_components>
void
test_general_way()
{
  test::Random     random;
  test::WorstError error;
  MixedKernel<dim> kernel;
  for (const char *const name : {"Neo-Hookean", "J2", "Mohr-Coulomb"})
    kernel.materials.push_back(test::make_material<dim>(name));
  for (unsigned int n = 0; n < 20; ++n)
    {
      RandomElement<dim, n_components> e(kernel, 1 + n % 4, 0.1, random);
      e.evaluate(true);
      const ScaledMatrix<dim, n_components> matrix(e);
      const auto                            residual = e.element.residual;
      e.general_way                                  = true;
      e.evaluate(true);
      const ScaledMatrix<dim, n_components> other(e);
      for (unsigned int i = 0; i < e.n_dofs; ++i)
        {
          error.add(std::abs(e.scaled(residual[i] - e.element.residual[i], i)),
                    "residual");
          for (unsigned int j = 0; j < e.n_dofs; ++j)
            error.add(matrix.relative(matrix.entry[i][j] - other.entry[i][j],
                                      i,
                                      j),
                      "matrix");
        }
    }
  error.report("general way and fast way, dim " + std::to_string(dim) +
                 (n_components == dim ? ", u" : ", u-p"),
               1e-13);
}

/** Laws in a body of revolution, and the residual of one of them as the
 * gradient of its energy in the ring,
 *   Π = Σ V 2πR [ G/2 (tr b̄ - 3) + p (J - 1) - p²/(2K) ]. */
void
test_axisymmetry()
{
  const auto make = [](const std::string &name, const std::string &settings) {
    return std::make_unique<AxisymmetricMaterial>(
      test::make_material<3>(name, settings));
  };
  unsigned int       n_tested = 0, n_names = 0;
  std::istringstream names(PluginRegistry<MaterialModel<3>>::names());
  for (std::string name; std::getline(names, name, '|'); ++n_names)
    for (const char *const settings : {"", "set Poisson ratio = 0.5"})
      {
        MixedKernel<2> kernel;
        kernel.axisymmetric = true;
        kernel.materials.push_back(make(name, settings));
        const std::string label =
          "axisymmetric " + name + " [" + settings + "]";
        if (kernel.materials[0]->inverse_bulk_modulus() > 0)
          test_matrix<2, 2>(label, kernel, n_tested);
        test_matrix<2, 3>(label, kernel, n_tested);
      }
  test::report("axisymmetric, all registered materials",
               all_passed && n_names >= 3 && n_tested >= 3 * n_names,
               "see above");

  test::Random     random;
  test::WorstError error;
  MixedKernel<2>   kernel;
  kernel.axisymmetric = true;
  kernel.materials.push_back(make("Neo-Hookean", ""));
  const double G  = kernel.materials[0]->shear_modulus();
  const double iK = kernel.materials[0]->inverse_bulk_modulus();
  for (unsigned int n = 0; n < 20; ++n)
    {
      RandomElement<2, 3> e(kernel, 1 + n % 4, 0.2, random);
      const auto          potential = [&]() {
        Tensor<2, 2> F_increment(unit_symmetric_tensor<2>());
        double       energy = 0;
        for (unsigned int I = 0; I < 3; ++I)
          F_increment +=
            outer_product(e.element.increment[I], e.element.gradient[I]);
        for (unsigned int q = 0; q < e.points.weight.size(); ++q)
          {
            const Tensor<2, 2> F = F_increment * e.points.F[q];
            const double       old_hoop =
              e.points.history[q * std::size_t(e.points.n_history)];
            double r = e.points.radius[q], p = 0;
            for (unsigned int I = 0; I < 3; ++I)
              {
                r += e.points.shape[q][I] * e.element.increment[I][0];
                p += e.points.shape[q][I] * e.element.pressure[I];
              }
            const double R    = e.points.radius[q] / old_hoop;
            const double hoop = r / R, J = determinant(F) * hoop;
            energy +=
              2 * numbers::PI * R * e.points.weight[q] *
              (G / 2 *
                 (std::pow(J, -2. / 3.) * (F.norm_square() + hoop * hoop) - 3) +
               p * (J - 1) - p * p * iK / 2);
          }
        return energy;
      };
      add_potential_error(e, potential, "element " + std::to_string(n), error);
    }
  error.report("axisymmetric residual as gradient of the potential", 1e-8);
}

int
main()
{
  test_general_way<2, 2>();
  test_general_way<2, 3>();
  test_general_way<3, 3>();
  test_general_way<3, 4>();
  test_axisymmetry();
}
