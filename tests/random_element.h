/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_random_element_h
#define isochor_tests_random_element_h

// Elements with points of random state, and their matrix against finite
// differences of their residual.

#include <isochor/equations/mixed_kernel.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "material_test_tools.h"

using namespace isochor;

inline bool all_passed = true;

/** Only failures are printed one by one: the expected output shall not change
 * when a material is added. */
inline void
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

  const MixedKernel<dim>         &kernel;
  PointArrays<dim>                points;
  ElementType                     element;
  double                          G, volume;
  CellCompliance                  compliance;
  std::array<Point<dim>, dim + 1> corners;
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
    const Tensor<2, dim> edges   = one + random.template gradient<dim>(0.25);
    const Tensor<2, dim> inverse = invert(edges);
    for (unsigned int I = 1; I <= dim; ++I)
      for (unsigned int a = 0; a < dim; ++a)
        corners[I][a] = edges[a][I - 1];
    const bool depends_on_pressure =
      std::any_of(kernel.materials.begin(),
                  kernel.materials.end(),
                  [](const auto &material) {
                    return material->depends_on_pressure();
                  });
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
        element.pressure[I]          = 0.3 * G * random();
        element.pressure_at_start[I] = 0.3 * G * random();
        // Where tension comes to the apex of a cone, edges lie too close
        // together for finite differences.
        if (depends_on_pressure)
          element.pressure[I] = -std::abs(element.pressure[I]);
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
    kernel.add_compliance(points,
                          points.weight.size() - 1,
                          points.weight.back(),
                          compliance);
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
    points.shear_stress.push_back(G * std::abs(random()));
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
      kernel.stabilisation.add_projection(
        element, compliance, corners, with_matrix, kernel.upper_blocks_only);
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

/** What the residual of @p e differs by from the central differences of its
 * @p potential(). */
template <int dim, int n_components, typename Potential>
void
add_potential_error(RandomElement<dim, n_components> &e,
                    const Potential                  &potential,
                    const std::string                &where,
                    test::WorstError                 &error)
{
  e.evaluate(false);
  const auto residual = e.element.residual;
  for (unsigned int i = 0; i < e.n_dofs; ++i)
    {
      const double value      = e.unknown(i);
      const auto   difference = [&](const double h) {
        e.unknown(i)       = value + h * e.unit(i);
        const double plus  = potential();
        e.unknown(i)       = value - h * e.unit(i);
        const double minus = potential();
        e.unknown(i)       = value;
        return (plus - minus) / (2 * h);
      };
      // of fourth order
      const double h     = 1e-4,
                   slope = (4 * difference(h) - difference(2 * h)) / 3;
      error.add(std::abs(slope - residual[i] * e.unit(i)) / (e.volume * e.G),
                where + ", entry " + std::to_string(i));
    }
}

/** A weight that changes the pressure by some G over an element, as far as the
 * laws have a density. */
template <int dim>
void
set_weight(MixedKernel<dim> &kernel)
{
  const MaterialModel<dim> &material = *kernel.materials[0];
  for (unsigned int a = 0; a < dim; ++a)
    kernel.stabilisation.hydrostatic_acceleration[a] =
      (0.4 - 0.3 * a) * material.shear_modulus() / material.density();
}

template <int dim, int n_components>
void
test_matrix(const std::string      &label,
            const MixedKernel<dim> &kernel,
            unsigned int           &n_tested,
            const double            start_weight = 0)
{
  constexpr int    n_dofs = RandomElement<dim, n_components>::n_dofs;
  test::Random     random;
  test::WorstError tangent, unsymmetric;
  unsigned int     n_kinks = 0;
  const bool       symmetric =
    start_weight == 0 &&
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
      e.element.start_weight                 = start_weight;
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

#endif
