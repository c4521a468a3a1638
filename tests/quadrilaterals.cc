/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Quadrilaterals and hexahedra (Q1): states that they have to reproduce
// exactly, convergence beside P1, Cook's membrane, dynamics on a grid that is
// kept.

#include <isochor/base/expression.h>
#include <isochor/base/mpi_sums.h>

#include <algorithm>
#include <iomanip>

#include "bulged_grid.h"
#include "scene.h"

namespace
{
  /** Tension by a grid that follows, of a body that ends inside of cells, with
   * the exact stress of tests/quadrature.cc. */
  template <int dim>
  void
  test_tension(const std::string &quadrature, const double tolerance)
  {
    const std::string  z = dim == 3 ? "; back: z=0; front: z=0\n" : "\n";
    std::ostringstream scene;
    scene << "Grid/Type = trapezoid\nGrid/Shape functions = Q1\n"
          << "Grid/Corners = 0, 0; 1, 0; 0.8, 1; 0, 1\n"
          << subdivisions<dim>(dim == 2 ? 16 : 4)
          << "Grid/Stretch = y: 0 -> 0, 1 -> 0.5*t\n"
          << "Quadrature/Type = " << quadrature << "\nMaterial points/"
          << (dim == 2 ? "Lattice spacing = 0.025\n" :
                         "Lattice spacing = 0.1\n")
          << "Material points/Region = if(x<0.7, 1, 0)\n"
          << "Formulation/PPP coefficient = 0.1\n"
          << "Newton/Tolerance = 1e-12\n"
             "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.499\n"
          << "Boundary conditions/Displacement = left: x=0; bottom: y=0; "
             "top: y=0.5*t"
          << z << "Time/Step size = " << (dim == 2 ? 0.1 : 0.25)
          << "\nPostprocess/Exact stress = yy: 42.0152039363\n";
    const auto problem = test::run_scene<dim>(scene.str());
    test::check_error("homogeneous tension of Q1, dim " + std::to_string(dim) +
                        ", " + quadrature,
                      problem->last_statistics().get("L2 error of stress yy"),
                      tolerance);
  }

  /** Formulas of the components of a displacement. */
  using Field = std::vector<std::string>;

  /** ∇φ with Δφ = 0: in the linear theory in equilibrium without body forces,
   * for any ν. */
  template <int dim>
  Field
  harmonic()
  {
    return dim == 2 ?
             Field{"1e-6*exp(2*x)*cos(2*y)", "-1e-6*exp(2*x)*sin(2*y)"} :
             Field{"1e-6*sqrt(2)*exp(sqrt(2)*x)*cos(y)*cos(z)",
                   "-1e-6*exp(sqrt(2)*x)*sin(y)*cos(z)",
                   "-1e-6*exp(sqrt(2)*x)*cos(y)*sin(z)"};
  }

  /** Relative error in the L2 norm of the displacements @p field, which are
   * prescribed on all sides of a grid with @p n cells in each direction. */
  template <int dim>
  double
  displacement_error(const Field       &field,
                     const std::string &settings,
                     const unsigned int n)
  {
    std::vector<std::string> sides = {"left", "right", "bottom", "top"};
    if (dim == 3)
      sides.insert(sides.end(), {"front", "back"});
    std::string                  displacement;
    std::vector<Expression<dim>> exact;
    for (unsigned int d = 0; d < dim; ++d)
      exact.emplace_back(field[d], "u", FormulaVariables::space);
    for (const std::string &side : sides)
      for (unsigned int d = 0; d < dim; ++d)
        displacement += (displacement.empty() ? "" : "; ") + side + ": " +
                        "xyz"[d] + " = " + field[d];
    const auto problem = test::run_scene<dim>(
      "Material/Young modulus = 1\nNewton/Tolerance = 1e-12\n"
      "Boundary conditions/Displacement = " +
      displacement + '\n' + subdivisions<dim>(n) + settings);
    const PointLayout    &l     = problem->material_points().layout();
    std::array<double, 2> norms = {{0, 0}};
    for (const auto &point : problem->material_points().handler())
      {
        const auto properties = point.get_properties();
        Point<dim> X          = point.get_location();
        for (unsigned int d = 0; d < dim; ++d)
          X[d] -= properties[l.displacement + d];
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double u = exact[d](X, 0.);
            norms[0] += properties[l.volume] *
                        std::pow(properties[l.displacement + d] - u, 2);
            norms[1] += properties[l.volume] * u * u;
          }
      }
    sum_over_ranks(norms, MPI_COMM_WORLD);
    return std::sqrt(norms[0] / norms[1]);
  }

  /** Linear displacements, of order one, with several points in each cell. */
  template <int dim>
  void
  test_patch(const std::string &what,
             const std::string &settings,
             const double       tolerance)
  {
    const Field field =
      dim == 2 ?
        Field{"0.3*x+0.2*y", "-0.1*x+0.4*y"} :
        Field{"0.3*x+0.2*y-0.1*z", "-0.1*x+0.4*y+0.2*z", "0.1*x+0.1*y-0.2*z"};
    for (const char *formulation : {"u", "u-p"})
      test::check_error(
        "linear displacement of Q1, dim " + std::to_string(dim) + ", " +
          formulation + ", " + what,
        displacement_error<dim>(field,
                                "Grid/Shape functions = Q1\n"
                                "Formulation/PPP coefficient = 8\n"
                                "Formulation/Type = " +
                                  std::string(formulation) + '\n' + settings,
                                dim == 2 ? 5 : 3),
        tolerance);
  }

  /** Both are of order two; Q1 is better by @p least_ratio at least. */
  template <int dim>
  void
  test_convergence(const std::string &settings,
                   const unsigned int n,
                   const double       least_order,
                   const double       least_ratio)
  {
    std::vector<double> errors;
    for (const char *name : {"P1", "Q1"})
      for (const unsigned int factor : {1, 2})
        errors.push_back(displacement_error<dim>(
          harmonic<dim>(),
          settings + "Grid/Type = bulged\nGrid/Shape functions = " + name +
            '\n',
          factor * n));
    const double order = std::log2(errors[2] / errors[3]);
    const double ratio = errors[1] / errors[3];
    std::string  label = settings;
    std::replace(label.begin(), label.end(), '\n', ' ');
    std::ostringstream details;
    details << "errors of P1 " << errors[0] << ' ' << errors[1] << ", of Q1 "
            << errors[2] << ' ' << errors[3] << ", order " << order
            << ", P1 by Q1 " << ratio;
    test::check("convergence, dim " + std::to_string(dim) + ", " + label,
                order > least_order && ratio > least_ratio,
                details.str());
  }

  /** Cook's membrane: the error of u_y of A by that of P1, the reference being
   * prm/cooks_membrane/reference.json; and that Newton's method is quadratic.
   */
  void
  test_membrane(const std::string &formulation,
                const double       poisson_ratio,
                const double       reference,
                const double       largest_ratio)
  {
    std::array<double, 2> u;
    for (const bool is_q1 : {false, true})
      {
        std::ostringstream scene;
        scene << "Grid/Type = trapezoid\n"
              << "Grid/Corners = 0, 0; 48, 44; 48, 60; 0, 44\n"
              << subdivisions<2>(16)
              << "Grid/Shape functions = " << (is_q1 ? "Q1" : "P1")
              << "\nFormulation/Type = " << formulation
              << "\nMaterial/Young modulus = 70\nMaterial/Poisson ratio = "
              << poisson_ratio
              << "\nBoundary conditions/Displacement = left: x = 0, y = 0\n"
              << "Boundary conditions/Traction = right: 0, 1/16\n"
              << "Postprocess/Point probes = A: 48, 60\n"
              << "Newton/Tolerance = 1e-10\nNewton/Reuse factorisation = 0\n";
        u[is_q1] = test::run_scene<2>(scene.str())
                     ->last_statistics()
                     .get("Displacement y of A (m)");
      }
    std::ostringstream details;
    details << "P1 " << u[0] << ", Q1 " << u[1];
    const double ratio = (reference - u[1]) / (reference - u[0]);
    test::check("Cook's membrane, " + formulation +
                  ", nu = " + std::to_string(poisson_ratio).substr(0, 5),
                ratio > 0 && ratio < largest_ratio,
                details.str());
    bool                quadratic = true;
    std::vector<double> r;
    for (const auto &iteration : test::recorded().newton.at(0).iterations)
      r.push_back(std::max(iteration.displacement, iteration.pressure));
    for (unsigned int k = 1; k + 1 < r.size(); ++k)
      quadratic = quadratic && r[k + 1] <= std::max(10 * r[k] * r[k], 1e-10);
    test::check("Newton's method with Q1", quadratic && r.size() > 3, "slow");
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "u_y(A) = " << std::setprecision(9) << u[1] << std::endl;
  }

  /** The same under a small load on 4 x 4 cells, against another program:
   * small strains, Q1 by Newton's method on the corners, integrated at the
   * centroids of the parts of the triangles. */
  void
  test_small_strains(const unsigned int points_per_cell, const double reference)
  {
    const auto problem = test::run_scene<2>(
      "Grid/Type = trapezoid\nGrid/Corners = 0, 0; 48, 44; 48, 60; 0, 44\n"
      "Grid/Shape functions = Q1\nFormulation/Type = u\n"
      "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.33\n"
      "Boundary conditions/Displacement = left: x = 0, y = 0\n"
      "Boundary conditions/Traction = right: 0, 1e-6/16\n"
      "Postprocess/Point probes = A: 48, 60\n"
      "Material points/Points per cell = " +
      std::to_string(points_per_cell) + '\n' + subdivisions<2>(4));
    test::check_error("small strains, " + std::to_string(points_per_cell) +
                        " points per triangle",
                      std::abs(problem->last_statistics().get(
                                 "Displacement y of A (m)") /
                                 (1e-6 * reference) -
                               1),
                      1e-7);
  }

  /** A bar that swings on a grid that is kept: its energy, and the same on any
   * number of ranks. */
  void
  test_dynamics()
  {
    const auto problem = test::run_scene<2>(
      "Grid/Type = trapezoid\nGrid/Corners = 0, 0; 1, -0.1; 1.05, 0.2; 0, 0.25\n"
      "Grid/Subdivisions = 8, 2\nGrid/Shape functions = Q1\n"
      "Grid reset/Steps between resets = 0\n"
      "Grid reset/Smallest element quality = 0.05\n"
      "Formulation/Type = u\nMaterial/Young modulus = 1e5\n"
      "Material/Poisson ratio = 0.3\nMaterial/Density = 1000\n"
      "Boundary conditions/Displacement = left: x=0, y=0\n"
      "Dynamics/Inertia = true\nDynamics/Spectral radius = 1\n"
      "Dynamics/Initial velocity = 0, x^2\nTime/Step size = 0.02\n"
      "Newton/Tolerance = 1e-10\nPostprocess/Point probes = A: 1.05, 0.2\n");
    const auto  &statistics = problem->last_statistics();
    const double kinetic    = statistics.get("Kinetic energy (J)"),
                 strain     = statistics.get("Strain energy (J)"),
                 lost       = statistics.get("Energy lost by the scheme (J)");
    test::check_error("energy of a bar, grid kept",
                      std::abs(lost) / (kinetic + strain),
                      3e-4);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "u_y(A) = " << std::setprecision(9)
                << statistics.get("Displacement y of A (m)") << std::endl;
  }

} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const std::string parallelograms =
    "Grid/Type = trapezoid\nGrid/Corners = 0, 0; 1, 0.2; 1.3, 1.1; 0.3, 0.9\n";
  const std::string trapezoids =
    "Grid/Type = trapezoid\nGrid/Corners = 0, 0; 1, 0.2; 0.9, 1.5; -0.2, 0.7\n"
    "Quadrature/Type = CPDI\n";
  test_patch<2>("parallelograms", parallelograms, 1e-10);
  test_patch<3>("parallelograms", parallelograms, 1e-10);
  test_patch<2>("CPDI", trapezoids, 1e-10);
  test_patch<3>("CPDI", trapezoids, 1e-10);
  // points have no rule that is exact in other quadrilaterals
  test_patch<2>("bulged", "Grid/Type = bulged\n", 1e-3);
  test_tension<2>("CPDI", 1e-10);
  test_tension<3>("CPDI", 1e-10);
  test_convergence<2>("Formulation/Type = u\n", 8, 1.9, 1.5);
  test_convergence<2>("Material/Poisson ratio = 0.499\n", 8, 1.9, 1.05);
  test_convergence<2>("Quadrature/Type = CPDI\nMaterial points/Points per cell "
                      "= 16\n",
                      8,
                      1.9,
                      1.1);
  test_convergence<3>("Formulation/Type = u\n", 3, 1.9, 1.9);
  test_small_strains(4, 0.23891105833);
  test_small_strains(9, 0.23550891695);
  test_membrane("u", 0.33, 0.321595, 0.35);
  test_membrane("u-p", 0.499, 0.276467, 0.45);
  test_dynamics();
  return 0;
}
