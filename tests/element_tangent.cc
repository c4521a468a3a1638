/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The discrete equations of random elements, for every registered material
// after random loading: the matrix against finite differences of the residual,
// its symmetry where that is claimed, and the residual of the Neo-Hookean law
// against finite differences of its potential.

#include <isochor/equations/mixed_kernel.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "material_test_tools.h"

using namespace isochor;

bool all_passed = true;

/** Only failures are printed one by one: the expected output shall not change
 * when a material is added. */
void
expect(const std::string      &what,
       const test::WorstError &error,
       const double            tolerance)
{
  if (error.value <= tolerance)
    return;
  all_passed = false;
  error.report(what, tolerance);
}

/** A simplex with points of random history. */
template <int dim, int n_components>
struct RandomElement
{
  static constexpr bool mixed = (n_components == dim + 1);
  using ElementType           = Element<dim, n_components, dim + 1>;
  static constexpr int n_dofs = ElementType::n_max;

  const MixedKernel<dim> &kernel;
  PointArrays<dim>        points;
  ElementType             element;
  double                  G, volume, volume_over_G = 0;
  /** By MixedKernel::evaluate_points() in any case. */
  bool general_way = false;

  RandomElement(const MixedKernel<dim> &kernel,
                const unsigned int      n_points,
                const double            amplitude,
                test::Random           &random)
    : kernel(kernel)
    , G(kernel.materials[0]->shear_modulus())
  {
    // edges around those of the unit simplex; ∇N_I are the rows of the inverse
    const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
    const Tensor<2, dim> inverse =
      invert(one + random.template gradient<dim>(0.25));
    element.gradient[0] = 0;
    for (unsigned int I = 1; I <= dim; ++I)
      {
        element.gradient[I] = inverse[I - 1];
        element.gradient[0] -= inverse[I - 1];
      }
    for (unsigned int I = 0; I <= dim; ++I)
      {
        for (unsigned int a = 0; a < dim; ++a)
          element.increment[I][a] = amplitude * random();
        element.pressure[I] = 0.3 * G * random();
      }
    volume = 1. / (dim == 2 ? 2 : 6) / determinant(inverse);
    for (const auto &material : kernel.materials)
      points.n_history =
        std::max<unsigned int>(points.n_history,
                               material->history_names().size());
    for (unsigned int q = 0; q < n_points; ++q)
      add_point(n_points, amplitude, random);
  }

  void
  add_point(const unsigned int n_points,
            const double       amplitude,
            test::Random      &random)
  {
    const Tensor<2, dim>        one(unit_symmetric_tensor<dim>());
    std::array<double, dim + 1> shape;
    double                      sum = 0;
    for (double &N : shape)
      sum += N = 0.01 + std::abs(random());
    for (double &N : shape)
      N /= sum;
    points.shape.push_back(shape);
    points.weight.push_back(volume * (1 + 0.5 * random()) / n_points);

    const unsigned int m =
      std::min<unsigned int>(std::abs(random()) * kernel.materials.size(),
                             kernel.materials.size() - 1);
    points.material.push_back(m);
    volume_over_G +=
      points.weight.back() / kernel.materials[m]->shear_modulus();
    test::Point<dim> point(*kernel.materials[m]);
    if (mixed && point.material.depends_on_pressure())
      point.pressure = 0.1 * G * random();
    if (kernel.axisymmetric)
      {
        points.radius.push_back(0.5 + std::abs(random()));
        point.hoop_increment = 1 + amplitude * random();
      }
    for (unsigned int step = 0; step < 3; ++step)
      {
        const Tensor<2, dim> F_increment =
          one + random.template gradient<dim>(amplitude);
        point.evaluate(F_increment);
        point.commit(F_increment);
      }
    points.F.push_back(point.F);
    point.history_n.resize(points.n_history);
    points.history.insert(points.history.end(),
                          point.history_n.begin(),
                          point.history_n.end());
  }

  double &
  unknown(const unsigned int i)
  {
    const unsigned int I = i / n_components, a = i % n_components;
    return a == dim ? element.pressure[I] : element.increment[I][a];
  }

  /** The unit of an unknown; that of its residual is G V or V. */
  double
  unit(const unsigned int i) const
  {
    return i % n_components == dim ? G : 1.;
  }

  EvaluationStatus
  evaluate(const bool with_matrix)
  {
    const auto shape = [this](const unsigned int q, const unsigned int I) {
      return points.shape[q][I];
    };
    const EvaluationStatus status =
      general_way || kernel.axisymmetric ?
        kernel.evaluate_points(
          element,
          points,
          0,
          points.weight.size(),
          [this](const unsigned int q) {
            return typename PointArrays<dim>::Stencil{dim + 1,
                                                      nullptr,
                                                      points.shape[q].data(),
                                                      element.gradient.data()};
          },
          with_matrix) :
        kernel.evaluate(
          element, points, 0, points.weight.size(), shape, with_matrix);
    if constexpr (mixed)
      kernel.add_pressure_projection(element, volume_over_G, with_matrix);
    return status;
  }

  /** Central difference of the residual, scaled, with respect to unknown j. */
  std::array<double, n_dofs>
  difference(const unsigned int j, const double h)
  {
    std::array<double, n_dofs> result;
    const double               value = unknown(j);
    for (const int sign : {-1, 1})
      {
        unknown(j) = value + sign * h * unit(j);
        if (evaluate(false) != EvaluationStatus::success)
          result.fill(1e300);
        for (unsigned int i = 0; i < n_dofs; ++i)
          {
            const double part = sign * scaled(element.residual[i], i) / (2 * h);
            result[i]         = (sign < 0 ? part : result[i] + part);
          }
      }
    unknown(j) = value;
    return result;
  }

  double
  scaled(const double residual, const unsigned int i) const
  {
    return residual / (volume * (i % n_components == dim ? 1. : G));
  }
};

/** Errors relative to the largest entry of a block of matrix: the blocks are
 * (displacement, pressure) x (displacement, pressure). */
template <int dim, int n_components>
struct ScaledMatrix
{
  using Random                = RandomElement<dim, n_components>;
  static constexpr int n_dofs = Random::n_dofs;
  double               entry[n_dofs][n_dofs];
  double               norm[2][2] = {{1e-3, 1e-3}, {1e-3, 1e-3}};

  explicit ScaledMatrix(const Random &e)
  {
    for (unsigned int i = 0; i < n_dofs; ++i)
      for (unsigned int j = 0; j < n_dofs; ++j)
        {
          entry[i][j] =
            e.scaled(e.element.matrix[i * n_dofs + j], i) * e.unit(j);
          double &n = norm[field(i)][field(j)];
          n         = std::max(n, std::abs(entry[i][j]));
        }
  }
  static bool
  field(const unsigned int i)
  {
    return i % n_components == dim;
  }
  double
  relative(const double error, const unsigned int i, const unsigned int j) const
  {
    return std::abs(error) / norm[field(i)][field(j)];
  }
};

template <int dim, int n_components>
void
test_matrix(const std::string      &label,
            const MixedKernel<dim> &kernel,
            unsigned int           &n_tested)
{
  constexpr int    n_dofs = RandomElement<dim, n_components>::n_dofs;
  test::Random     random;
  test::WorstError tangent, unsymmetric;
  unsigned int     n_kinks = 0;
  const bool       symmetric =
    std::all_of(kernel.materials.begin(),
                kernel.materials.end(),
                [](const auto &m) { return m->has_symmetric_tangent(); });
  const unsigned int n_elements = 60;
  for (unsigned int n = 0; n < n_elements; ++n)
    {
      RandomElement<dim, n_components> e(kernel,
                                         1 + n % 5,
                                         0.15 * std::abs(random()),
                                         random);
      const std::string                where = "element " + std::to_string(n);
      if (e.evaluate(true) != EvaluationStatus::success)
        {
          tangent.add(1e300, where + ", evaluation");
          continue;
        }
      const ScaledMatrix<dim, n_components> matrix(e);
      test::WorstError                      error;
      bool                                  at_kink = false;
      for (unsigned int j = 0; j < n_dofs; ++j)
        {
          const double h  = 2e-6;
          const auto fine = e.difference(j, h), coarse = e.difference(j, 2 * h);
          for (unsigned int i = 0; i < n_dofs; ++i)
            {
              if (matrix.relative(fine[i] - coarse[i], i, j) > 1e-7)
                at_kink = true;
              error.add(matrix.relative(fine[i] - matrix.entry[i][j], i, j),
                        where + ", entry " + std::to_string(i) + " " +
                          std::to_string(j));
              if (symmetric)
                unsymmetric.add(matrix.relative(matrix.entry[i][j] -
                                                  matrix.entry[j][i],
                                                i,
                                                j),
                                where);
            }
        }
      if (at_kink)
        ++n_kinks;
      else
        tangent.add(error.value, error.where);
    }
  const std::string what = label + (n_components == dim ? ", u" : ", u-p") +
                           ", dim " + std::to_string(dim);
  expect(what + ", matrix", tangent, 1e-6);
  expect(what + ", symmetry", unsymmetric, 1e-12);
  test::WorstError kinks;
  kinks.add(n_kinks, "states at kinks");
  expect(what, kinks, 0.1 * n_elements);
  ++n_tested;
}

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
      kernel.ppp_coefficient = alpha;
      test_matrix<dim, dim + 1>(label + (alpha > 0 ? ", PPP" : ""),
                                kernel,
                                n_tested);
    }
}

/** R = ∂Π/∂(u, p) with Π = Σ V [ G/2 (tr b̄ - 3) + p (J - 1) - p²/(2K) ] minus
 * half the energy of the pressure projection, α/(2G) ∫ (p - p̃)² dv. */
template <int dim>
void
test_potential()
{
  constexpr int    n_components = dim + 1;
  test::Random     random;
  test::WorstError error;
  MixedKernel<dim> kernel;
  kernel.ppp_coefficient = 1.3;
  kernel.materials.push_back(test::make_material<dim>("Neo-Hookean"));
  const double G  = kernel.materials[0]->shear_modulus();
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
            V += e.points.weight[q];
            energy += e.points.weight[q] *
                      (G / 2 * (std::pow(J, -2. / 3.) * trace - 3) +
                       p * (J - 1) - p * p * iK / 2);
          }
        // variance of linear functions on a simplex with nodal values p_I:
        // (Σ p_I² - (d+1) p̃²) / ((d+1)(d+2))
        double mean = 0, squares = 0;
        for (const double p : e.element.pressure)
          {
            mean += p / (dim + 1);
            squares += p * p;
          }
        return energy - kernel.ppp_coefficient * V / (2 * G) *
                          (squares - (dim + 1) * mean * mean) /
                          ((dim + 1) * (dim + 2));
      };
      e.evaluate(false);
      const auto residual = e.element.residual;
      for (unsigned int i = 0; i < e.n_dofs; ++i)
        {
          const double h = 1e-5, value = e.unknown(i);
          e.unknown(i)       = value + h * e.unit(i);
          const double plus  = potential();
          e.unknown(i)       = value - h * e.unit(i);
          const double minus = potential();
          e.unknown(i)       = value;
          error.add(
            std::abs((plus - minus) / (2 * h) - residual[i] * e.unit(i)) /
              (e.volume * G),
            "element " + std::to_string(n) + ", entry " + std::to_string(i));
        }
    }
  error.report("residual as gradient of the potential, dim " +
                 std::to_string(dim),
               1e-8);
}

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
      e.evaluate(false);
      const auto residual = e.element.residual;
      for (unsigned int i = 0; i < e.n_dofs; ++i)
        {
          const double h = 1e-5, value = e.unknown(i);
          e.unknown(i)       = value + h * e.unit(i);
          const double plus  = potential();
          e.unknown(i)       = value - h * e.unit(i);
          const double minus = potential();
          e.unknown(i)       = value;
          error.add(
            std::abs((plus - minus) / (2 * h) - residual[i] * e.unit(i)) /
              (e.volume * G),
            "element " + std::to_string(n) + ", entry " + std::to_string(i));
        }
    }
  error.report("axisymmetric residual as gradient of the potential", 1e-8);
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
               all_passed && n_tested == 20,
               std::to_string(n_tested) + " cases, see above");
  test_potential<dim>();
}

int
main()
{
  test_all<2>();
  test_all<3>();
  test_general_way<2, 2>();
  test_general_way<2, 3>();
  test_general_way<3, 3>();
  test_general_way<3, 4>();
  test_axisymmetry();
}
