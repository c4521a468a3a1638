/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Shape functions: what all of them must fulfil in each cell, on a grid of
// distorted cells; tangents; and what can't be had.

#include <algorithm>
#include <functional>

#include "bulged_grid.h"
#include "material_test_tools.h"
#include "scene.h"

namespace
{
  template <int dim>
  std::unique_ptr<BackgroundGrid<dim>>
  make_grid(const std::string &settings)
  {
    ParameterHandler prm;
    BackgroundGrid<dim>::declare_parameters(prm);
    test::set_parameters(prm, settings);
    auto grid = std::make_unique<BackgroundGrid<dim>>(MPI_COMM_WORLD);
    grid->parse_parameters(prm);
    grid->create();
    return grid;
  }

  /** The value of the function of @p vertex, 0 for others. */
  template <typename Values>
  double
  value_at(const Values &at, const unsigned int vertex)
  {
    for (unsigned int I = 0; I < at.n_nodes; ++I)
      if (at.vertex[I] == vertex)
        return at.shape[I];
    return 0;
  }

  /** Completeness, values at vertices, gradients against differences, and, in
   * 2D, continuity through the faces of cells; in 3D bulged faces are not those
   * of the tetrahedra. */
  template <int dim>
  void
  test_functions(const std::string &name, const std::string &diagonals)
  {
    const auto  grid      = make_grid<dim>("Grid/Type = bulged\n"
                                           "Grid/Shape functions = " +
                                     name + "\nGrid/Diagonals = " + diagonals +
                                     '\n' + subdivisions<dim>(3));
    const auto &functions = grid->shape_functions();
    const auto &geometry  = grid->geometry();
    typename ShapeFunctions<dim>::Values at, other;
    test::Random                         random;
    double completeness = 0, vertices = 0, gradients = 0, continuity = 0;
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        typename ShapeFunctions<dim>::Barycentric lambda;
        double                                    sum = 0;
        for (double &value : lambda)
          sum += value = 0.1 + std::abs(random());
        for (double &value : lambda)
          value /= sum;
        Point<dim> x;
        for (unsigned int v = 0; v <= dim; ++v)
          x +=
            lambda[v] * geometry.vertices()[geometry.vertex_indices(cell)[v]];
        functions.evaluate(cell, lambda, at);
        Tensor<1, dim> place = -Tensor<1, dim>(x);
        Tensor<2, dim> map   = -unit_symmetric_tensor<dim>();
        double         one   = -1;
        for (unsigned int I = 0; I < at.n_nodes; ++I)
          {
            const Tensor<1, dim> corner = geometry.vertices()[at.vertex[I]];
            one += at.shape[I];
            place += at.shape[I] * corner;
            map += outer_product(corner, at.gradient[I]);
            for (unsigned int d = 0; d < dim; ++d)
              {
                constexpr double h          = 1e-5;
                double           difference = 0;
                for (const int sign : {-1, 1})
                  {
                    Point<dim> y = x;
                    y[d] += sign * h;
                    functions.evaluate(cell,
                                       geometry.barycentric(cell, y),
                                       other);
                    difference += sign * other.shape[I] / (2 * h);
                  }
                test::add_error(gradients,
                                std::abs(difference - at.gradient[I][d]));
              }
          }
        test::add_error(completeness,
                        std::abs(one) + place.norm() + map.norm());
        for (unsigned int v = 0; v <= dim; ++v)
          {
            std::array<double, dim + 1> corner{};
            corner[v] = 1;
            functions.evaluate(cell, corner, at);
            for (unsigned int I = 0; I < at.n_nodes; ++I)
              test::add_error(vertices,
                              std::abs(at.shape[I] -
                                       (at.vertex[I] ==
                                        geometry.vertex_indices(cell)[v])));
            const unsigned int neighbour = geometry.neighbours(cell)[v];
            if (dim == 3 || neighbour == SimplexGeometry<dim>::no_cell)
              continue;
            auto on_face = lambda;
            on_face[v]   = 0;
            Point<dim> y;
            for (unsigned int w = 0; w <= dim; ++w)
              {
                on_face[w] /= 1 - lambda[v];
                y += on_face[w] *
                     geometry.vertices()[geometry.vertex_indices(cell)[w]];
              }
            functions.evaluate(cell, on_face, at);
            functions.evaluate(neighbour,
                               geometry.barycentric(neighbour, y),
                               other);
            for (unsigned int I = 0; I < at.n_nodes; ++I)
              test::add_error(continuity,
                              std::abs(at.shape[I] -
                                       value_at(other, at.vertex[I])));
          }
      }
    const std::string label =
      name + ", dim " + std::to_string(dim) + ", " + diagonals + ": ";
    test::check_error(label + "linear fields", completeness, 1e-12);
    test::check_error(label + "values at vertices", vertices, 1e-12);
    test::check_error(label + "gradients", gradients, 1e-8);
    test::check_error(label + "continuity", continuity, 1e-12);
  }

  /** The matrix of all points of one element of Q1 against differences of their
   * residual. */
  template <int dim, int n_components>
  void
  test_tangent()
  {
    constexpr unsigned int n_nodes = 1u << dim;
    const auto             grid    = make_grid<dim>("Grid/Type = bulged\n"
                                                    "Grid/Shape functions = Q1\n" +
                                     subdivisions<dim>(2));
    MixedKernel<dim>       kernel;
    kernel.materials.push_back(test::make_material<dim>("Neo-Hookean"));
    const double     G = kernel.materials[0]->shear_modulus();
    test::Random     random;
    PointArrays<dim> points;
    points.clear_stencils();
    for (const unsigned int cell : grid->shape_functions().element(0))
      {
        typename ShapeFunctions<dim>::Barycentric lambda;
        lambda.fill(1. / (dim + 1));
        typename ShapeFunctions<dim>::Values at;
        grid->shape_functions().evaluate(cell, lambda, at);
        for (unsigned int I = 0; I < n_nodes; ++I)
          {
            points.stencil_vertex.push_back(at.vertex[I]);
            points.stencil_shape.push_back(at.shape[I]);
            points.stencil_gradient.push_back(at.gradient[I]);
          }
        points.stencil_start.push_back(points.stencil_vertex.size());
        points.weight.push_back(1 + 0.5 * random());
        points.material.push_back(0);
        points.F.push_back(unit_symmetric_tensor<dim>() +
                           random.template gradient<dim>(0.1));
      }
    Element<dim, n_components, n_nodes> element, sum;
    for (unsigned int I = 0; I < n_nodes; ++I)
      {
        for (unsigned int a = 0; a < dim; ++a)
          element.increment[I][a] = 0.02 * random();
        element.pressure[I] = 0.3 * G * random();
      }
    const auto evaluate = [&](const bool with_matrix) {
      sum.residual.fill(0.);
      sum.matrix.fill(0.);
      for (unsigned int q = 0; q < points.weight.size(); ++q)
        {
          const auto stencil = points.stencil(grid->geometry(), 0, q);
          std::copy_n(stencil.gradient, n_nodes, element.gradient.begin());
          kernel.evaluate(
            element,
            points,
            q,
            q + 1,
            [&](const unsigned int, const unsigned int I) {
              return stencil.shape[I];
            },
            with_matrix);
          for (unsigned int i = 0; i < element.n_dofs(); ++i)
            sum.residual[i] += element.residual[i];
          if (with_matrix)
            for (unsigned int i = 0; i < sum.matrix.size(); ++i)
              sum.matrix[i] += element.matrix[i];
        }
    };
    evaluate(true);
    const auto   matrix  = sum.matrix;
    const double largest = *std::max_element(matrix.begin(), matrix.end());
    double       error   = 0;
    for (unsigned int j = 0; j < element.n_dofs(); ++j)
      {
        const unsigned int a = j % n_components;
        double      &value   = a == dim ? element.pressure[j / n_components] :
                                          element.increment[j / n_components][a];
        const double h = (a == dim ? G : 1.) * 1e-6, middle = value;
        value = middle + h;
        evaluate(false);
        const auto plus = sum.residual;
        value           = middle - h;
        evaluate(false);
        value = middle;
        for (unsigned int i = 0; i < element.n_dofs(); ++i)
          test::add_error(error,
                          std::abs((plus[i] - sum.residual[i]) / (2 * h) -
                                   matrix[i * element.n_dofs() + j]) /
                            largest);
      }
    test::check_error("tangent of Q1, dim " + std::to_string(dim) +
                        (n_components == dim ? ", u" : ", u-p"),
                      error,
                      1e-8);
  }

  void
  test_error(const std::string           &what,
             const std::string           &expected,
             const std::function<void()> &run)
  {
    std::string message = "none";
    try
      {
        run();
      }
    catch (const std::exception &error)
      {
        message = test::one_line(error.what());
      }
    test::check("error, " + what,
                message.find(expected) != std::string::npos,
                message);
  }

  void
  test_limits()
  {
    const std::string q1 = "Grid/Shape functions = Q1\n";
    test_error("triangles that form no quadrilaterals",
               "needs a grid whose triangles form quadrilaterals",
               [&]() {
                 make_grid<2>(q1 + "Grid/Type = gmsh\nGrid/File = " SOURCE_DIR
                                   "/square.msh\n");
               });
    test_error("adaptive grid", "needs a grid whose", [&]() {
      make_grid<2>(q1 + "Grid/Type = adaptive\n");
    });
    test_error("not convex", "is not convex", [&]() {
      make_grid<2>(q1 +
                   "Grid/Type = trapezoid\n"
                   "Grid/Corners = 0, 0; 1, 0; 1, 1; 0.6, 0.2\n"
                   "Grid/Diagonals = backslash\n" +
                   subdivisions<2>(1));
    });
    for (const std::string quadrature : {"CPDI"})
      for (const std::string functions : {"P1", "Q1"})
        {
          const auto problem = test::run_scene<2>(
            "Quadrature/Type = " + quadrature +
            "\nGrid/Shape functions = " + functions +
            "\nMaterial points/Region = x<0.5 && y<0.5\nTime/Step size = 0.1\n"
            "Time/End time = 0.4\nDynamics/Inertia = true\n"
            "Grid reset/Steps between resets = 1\n"
            "Material/Density = 1\nDynamics/Initial velocity = 1, 0.5\n");
          test::check_error("free flight, " + quadrature + ", " + functions,
                            std::abs(problem->last_statistics().get(
                                       "Kinetic energy (J)") /
                                       0.15625 -
                                     1),
                            1e-8);
        }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  std::istringstream names(PluginRegistry<ShapeFunctions<2>>::names());
  for (std::string name; std::getline(names, name, '|');)
    for (const char *diagonals : {"/", "backslash", "alternating"})
      {
        test_functions<2>(name, diagonals);
        test_functions<3>(name, diagonals);
      }
  test_tangent<2, 2>();
  test_tangent<2, 3>();
  test_tangent<3, 3>();
  test_tangent<3, 4>();
  test_limits();
  return 0;
}
