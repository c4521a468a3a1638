/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The discrete equations of random elements, for every registered material
// after random loading: the matrix against finite differences of the residual,
// its symmetry where that is claimed, and the residual of the Neo-Hookean law
// against finite differences of its potential.

#include "random_element.h"

template <int dim>
void
test_materials(const std::vector<std::pair<std::string, std::string>> &laws,
               unsigned int                                           &n_tested)
{
  MixedKernel<dim> kernel;
  std::string      label;
  bool             incompressible = false;
  for (const auto &law : laws)
    {
      kernel.materials.push_back(
        test::make_material<dim>(law.first, law.second));
      label +=
        (label.empty() ? "" : " and ") + law.first + " [" + law.second + "]";
      incompressible =
        incompressible || kernel.materials.back()->inverse_bulk_modulus() == 0;
    }
  std::replace(label.begin(), label.end(), '\n', ';');
  if (!incompressible)
    test_matrix<dim, dim>(label, kernel, n_tested);
  for (const double alpha : {0., 1.7})
    {
      kernel.stabilisation.coefficient = alpha;
      set_weight(kernel);
      test_matrix<dim, dim + 1>(label + (alpha > 0 ? ", PPP" : ""),
                                kernel,
                                n_tested);
    }
  test_matrix<dim, dim + 1>(label + ", mean pressure", kernel, n_tested, 0.4);
}

/** R = ∂Π/∂(u, p) with Π = Σ V [ G/2 (tr b̄ - 3) + p (J - 1) - p²/(2K)
 * + κ (J - 1 - p/K)²/2 ] minus half the energy of the pressure projection,
 * α/(2G) ∫ (p - p̃)² dv. */
template <int dim>
void
test_potential()
{
  constexpr int    n_components = dim + 1;
  test::Random     random;
  test::WorstError error;
  MixedKernel<dim> kernel;
  kernel.stabilisation.coefficient = 1.3;
  kernel.materials.push_back(test::make_material<dim>("Neo-Hookean"));
  const double G = kernel.materials[0]->shear_modulus();
  set_weight(kernel);
  const double iK = kernel.materials[0]->inverse_bulk_modulus();
  for (unsigned int n = 0; n < 20; ++n)
    {
      RandomElement<dim, n_components> e(kernel, 1 + n % 4, 0.2, random);
      const auto                       potential = [&]() {
        Tensor<2, dim> F_increment(unit_symmetric_tensor<dim>());
        double         V = 0, energy = 0;
        for (unsigned int I = 0; I <= dim; ++I)
          F_increment +=
            outer_product(e.element.increment[I], e.element.gradient[I]);
        for (unsigned int q = 0; q < e.points.weight.size(); ++q)
          {
            const Tensor<2, dim> F = F_increment * e.points.F[q];
            const double J = determinant(F), trace = F.norm_square() + 3 - dim;
            double       p = 0;
            for (unsigned int I = 0; I <= dim; ++I)
              p += e.points.shape[q][I] * e.element.pressure[I];
            const double theta = J - 1, excess = theta - p * iK;
            V += e.points.weight[q];
            energy +=
              e.points.weight[q] *
              (G / 2 * (std::pow(J, -2. / 3.) * trace - 3) + p * theta -
               p * p * iK / 2 +
               kernel.unseen_stiffness(e.points, q) * excess * excess / 2);
          }
        // variance of linear functions on a simplex with nodal values d_I:
        // (Σ d_I² - (d+1) d̃²) / ((d+1)(d+2)), of p and the body's weight
        double mean = 0, squares = 0;
        for (unsigned int I = 0; I <= dim; ++I)
          {
            const double d =
              e.element.pressure[I] +
              kernel.materials[0]->density() *
                kernel.stabilisation.hydrostatic_acceleration *
                Tensor<1, dim>(e.corners[I] + e.element.increment[I]);
            mean += d / (dim + 1);
            squares += d * d;
          }
        return energy - kernel.stabilisation.coefficient * V / (2 * G) *
                          (squares - (dim + 1) * mean * mean) /
                          ((dim + 1) * (dim + 2));
      };
      add_potential_error(e, potential, "element " + std::to_string(n), error);
    }
  error.report("residual as gradient of the potential, dim " +
                 std::to_string(dim),
               1e-8);
}

/** The pressures of a step that takes their mean do the work Σ V p̄ ΔJ, whatever
 * they are at its ends, exactly where J is quadratic in the displacement. */
void
test_work_of_mean_pressure()
{
  constexpr int    dim = 2;
  test::Random     random;
  test::WorstError error;
  MixedKernel<dim> kernel;
  kernel.materials.push_back(test::make_material<dim>("Neo-Hookean"));
  for (unsigned int n = 0; n < 20; ++n)
    {
      RandomElement<dim, dim + 1> e(kernel, 1 + n % 4, 0.3, random);
      e.general_way          = n % 2;
      e.element.start_weight = 0.5;
      e.points.shear_stress.clear(); // of pressures only
      // the work of the force at the end, of deviatoric stresses or all
      const auto work = [&]() {
        double sum = 0;
        e.evaluate(false);
        for (unsigned int I = 0; I <= dim; ++I)
          for (unsigned int a = 0; a < dim; ++a)
            sum +=
              e.element.residual[I * (dim + 1) + a] * e.element.increment[I][a];
        return sum;
      };
      Tensor<2, dim> gradient;
      for (unsigned int I = 0; I <= dim; ++I)
        gradient +=
          outer_product(e.element.increment[I], e.element.gradient[I]);
      const double dJ =
        determinant(Tensor<2, dim>(unit_symmetric_tensor<dim>()) + gradient) -
        1;
      double at_both = work(), expected = 0;
      for (unsigned int q = 0; q < e.points.weight.size(); ++q)
        {
          const double V_J = e.points.weight[q] * determinant(e.points.F[q]);
          double       p = 0, p_n = 0;
          for (unsigned int I = 0; I <= dim; ++I)
            {
              p += e.points.shape[q][I] * e.element.pressure[I];
              p_n += e.points.shape[q][I] * e.element.pressure_at_start[I];
            }
          at_both += V_J * p_n * trace(gradient);
          expected += V_J * (p + p_n) * dJ;
        }
      e.element.pressure.fill(0.);
      e.element.pressure_at_start.fill(0.);
      at_both -= work();
      error.add((at_both - expected) / (e.G * e.volume),
                "element " + std::to_string(n));
    }
  error.report("work of the mean pressure", 1e-13);
}

template <int dim>
void
test_all()
{
  using Laws = std::vector<std::pair<std::string, std::string>>;
  unsigned int       n_tested = 0, n_names = 0;
  std::istringstream names(PluginRegistry<MaterialModel<dim>>::names());
  for (std::string name; std::getline(names, name, '|'); ++n_names)
    test_materials<dim>(Laws{{name, ""}}, n_tested);
  test::report("all registered materials, defaults, dim " + std::to_string(dim),
               all_passed && n_names >= 3 && n_tested >= 2 * n_names,
               "see above");

  const std::string half = "set Poisson ratio = 0.5";
  const std::string soft = "subsection J2\nset Yield stress = 5e4\nend";
  const std::string angles =
    "subsection Mohr-Coulomb\nset Friction angle = 30\nset Dilation angle = 10"
    "\nset Cohesion = 2e4\nend";
  n_tested = 0;
  for (const Laws &laws :
       {Laws{{"Neo-Hookean", half}},
        Laws{{"Neo-Hookean", "set Poisson ratio = 0.499"}},
        Laws{{"J2", half + "\n" + soft}},
        Laws{{"J2", soft}},
        Laws{{"Mohr-Coulomb", half}},
        Laws{{"Mohr-Coulomb", angles}},
        Laws{{"Mohr-Coulomb", half + "\n" + angles}},
        Laws{{"Neo-Hookean", ""}, {"Mohr-Coulomb", angles}, {"J2", soft}}})
    test_materials<dim>(laws, n_tested);
  test::report("further parameters and mixtures, dim " + std::to_string(dim),
               all_passed && n_tested == 28,
               std::to_string(n_tested) + " cases, see above");
  test_potential<dim>();
}

int
main()
{
  test_all<2>();
  test_all<3>();
  test_work_of_mean_pressure();
  return 0;
}
