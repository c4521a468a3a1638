/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The general way to evaluate an element, point by point, against the fast one,
// and in bodies of revolution against finite differences.

#include "random_element.h"

struct Law
{
  const char *name, *settings;
};

/** How many points of laws with a plastic strain flow, and how many don't, in
 * elements where there are both. */
struct Flow
{
  unsigned int plastic = 0, elastic = 0;
};

template <int dim, int n_components>
void
count_flow(const RandomElement<dim, n_components> &e, Flow &flow)
{
  Tensor<2, dim> F_increment(unit_symmetric_tensor<dim>());
  for (unsigned int I = 0; I <= dim; ++I)
    F_increment += outer_product(e.element.increment[I], e.element.gradient[I]);
  Flow of_element;
  for (unsigned int q = 0; q < e.points.weight.size(); ++q)
    {
      test::Point<dim> point(*e.kernel.materials[e.points.material[q]]);
      const double    *history =
        &e.points.history[q * std::size_t(e.points.n_history)];
      const auto names = point.material.history_names();
      if (names.empty() || names.back() != "equivalent_plastic_strain")
        continue;
      std::copy_n(history, names.size(), point.history_n.begin());
      point.F = e.points.F[q];
      point.evaluate(F_increment);
      const bool flows =
        point.history[names.size() - 1] > history[names.size() - 1];
      (flows ? of_element.plastic : of_element.elastic) += 1;
    }
  if (of_element.plastic > 0 && of_element.elastic > 0)
    {
      flow.plastic += of_element.plastic;
      flow.elastic += of_element.elastic;
    }
}

/** MixedKernel::evaluate_points() is the same as evaluate() where both can be
 * used; evaluate() asks laws that allow it for several points at once. */
template <int dim, int n_components>
Flow
compare_ways(const std::vector<Law> &laws,
             const double            amplitude,
             test::WorstError       &error)
{
  test::Random     random;
  Flow             flow;
  MixedKernel<dim> kernel;
  for (const Law &law : laws)
    kernel.materials.push_back(
      test::make_material<dim>(law.name, law.settings));
  for (unsigned int n = 0; n < 36; ++n)
    {
      RandomElement<dim, n_components> e(kernel, 1 + n % 9, amplitude, random);
      count_flow(e, flow);
      e.evaluate(false);
      const auto residual_alone = e.element.residual;
      e.evaluate(true);
      const ScaledMatrix<dim, n_components> matrix(e);
      const auto                            residual = e.element.residual;
      e.general_way                                  = true;
      e.evaluate(true);
      const ScaledMatrix<dim, n_components> other(e);
      for (unsigned int i = 0; i < e.n_dofs; ++i)
        error.add(std::abs(e.scaled(residual[i] - residual_alone[i], i)),
                  "residual without matrix");
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
  return flow;
}

template <int dim, int n_components>
void
test_general_way()
{
  const std::string label = std::string("dim ") + std::to_string(dim) +
                            (n_components == dim ? ", u" : ", u-p");
  test::WorstError error;
  for (const std::vector<Law> &laws :
       {std::vector<Law>{{"Neo-Hookean", ""}, {"J2", ""}, {"Mohr-Coulomb", ""}},
        {{"Neo-Hookean", ""}},
        {{"Mohr-Coulomb", ""}}})
    compare_ways<dim, n_components>(laws, 0.1, error);
  error.report("general way and fast way, " + label, 1e-13);

  // some strains are below that at yield, 3.5 %, and some above
  const std::string soft =
    "set Young modulus = 1e6\nsubsection J2\nset Yield stress = 4e4\n";
  test::WorstError of_j2;
  Flow             flow;
  for (const char *const more : {"set Hardening modulus = 0",
                                 "set Hardening modulus = 3e5",
                                 "set Saturation stress = 6e4\n"
                                 "set Saturation exponent = 20"})
    {
      const std::string settings = soft + more + "\nend\n";
      const Flow        more_flow =
        compare_ways<dim, n_components>({{"J2", settings.c_str()}},
                                        0.02,
                                        of_j2);
      flow.plastic += more_flow.plastic;
      flow.elastic += more_flow.elastic;
    }
  of_j2.report("general way and fast way, J2, " + label, 1e-13);
  std::ostringstream counts;
  counts << flow.plastic << " plastic, " << flow.elastic << " elastic points";
  test::report("... with elastic beside plastic points",
               flow.plastic > 50 && flow.elastic > 50,
               counts.str());
}

/** Laws in a body of revolution, and the residual of one of them as the
 * gradient of its energy in the ring,
 *   Π = Σ V 2πR [ G/2 (tr b̄ - 3) + p (J - 1 - b) - p²/(2K) ]. */
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
               p * (J - 1) - p * p * iK / 2 +
               kernel.unseen_stiffness(e.points, q) *
                 std::pow(J - 1 - p * iK, 2) / 2);
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
  return 0;
}
