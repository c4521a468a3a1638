/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Sides that move as rigid bodies: against the same motion prescribed node by
// node, equilibrium of forces and moments, torsion and bending in closed form,
// and loads instead of motions.

#include <isochor/base/finite_rotation.h>

#include <fstream>

#include "scene.h"

using namespace isochor;
using test::relative;

namespace
{
  template <int dim>
  std::string
  block()
  {
    return std::string(dim == 2 ? "Grid/Subdivisions = 4, 4\n" :
                                  "Grid/Subdivisions = 3, 3, 3\n") +
           "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0.3\n"
           "Formulation/Type = u\nNewton/Tolerance = 1e-11\n"
           "Newton/Reuse factorisation = 0\nPostprocess/Reactions = bottom\n";
  }

  /** "Force x of rigid side top (N)" and the like; in 2D, or about z, without
   * an axis. */
  template <int dim>
  double
  of_side(const MaterialPointMethod<dim> &problem,
          const std::string              &quantity,
          const std::string              &unit,
          const std::string              &side = "top")
  {
    return problem.last_statistics().get(quantity + " of rigid side " + side +
                                         " (" + unit + ")");
  }

  /** Whether residuals of the last step fell quadratically at its end. */
  bool
  quadratic()
  {
    const auto         &rows = test::recorded().newton.back().iterations;
    std::vector<double> r;
    for (const auto &row : rows)
      if (row.displacement > 1e-13)
        r.push_back(row.displacement);
    for (unsigned int k = 2; k < r.size(); ++k)
      if (r[k - 1] < 1e-3 && r[k] > 1e-11 && r[k] > 100 * r[k - 1] * r[k - 1])
        return false;
    return rows.size() < 12;
  }
} // namespace

void
test_rotation()
{
  using Vector3    = FiniteRotation::Vector3;
  double     first = 0, second = 0, spin = 0, pull = 0, length = 0, back = 0;
  const auto e = [](const unsigned int i) {
    Vector3 v;
    v[i] = 1;
    return v;
  };
  for (const Vector3 &theta : {Vector3{{0, 0, 0}},
                               Vector3{{1e-5, 2e-5, 0}},
                               Vector3{{0.3, -0.8, 0.5}},
                               Vector3{{2, 1, -1.5}},
                               Vector3{{-4, 3, 5}}})
    {
      const double         h = 1e-5;
      const FiniteRotation R(theta);
      const Vector3        x{{0.4, -1.1, 0.7}}, m{{1, 2, -0.5}};
      length = std::max(length, std::abs(R.rotate(x).norm() - x.norm()));
      const Tensor<2, 3> same =
        FiniteRotation(FiniteRotation::vector_of(R.matrix())).matrix();
      back = std::max(back, (same - R.matrix()).norm());
      for (unsigned int j = 0; j < 3; ++j)
        {
          const FiniteRotation plus(theta + h * e(j)), minus(theta - h * e(j));
          first = std::max(first,
                           (R.derivative(j, x) -
                            (plus.rotate(x) - minus.rotate(x)) / (2 * h))
                             .norm());
          for (unsigned int i = 0; i < 3; ++i)
            second =
              std::max(second,
                       (R.second_derivative(i, j, x) -
                        (plus.derivative(i, x) - minus.derivative(i, x)) /
                          (2 * h))
                         .norm());
          // m · spin = (Tᵀ m)_j, the spin from ∂R/∂θ_j Rᵀ
          Vector3 w;
          for (unsigned int a = 0; a < 3; ++a)
            {
              const Vector3 column = transpose(R.matrix()) * e((a + 1) % 3);
              w[a]                 = R.derivative(j, column)[(a + 2) % 3];
            }
          spin = std::max(spin, std::abs(R.pull_back(m)[j] - m * w));
          pull = std::max(pull,
                          (R.pull_back_derivative(j, m) -
                           (plus.pull_back(m) - minus.pull_back(m)) / (2 * h))
                            .norm());
        }
    }
  test::check_error("rotations keep lengths", length, 1e-12);
  test::check_error("first derivative", first, 1e-8);
  test::check_error("second derivative", second, 1e-8);
  test::check_error("spin", spin, 1e-12);
  test::check_error("derivative of moments", pull, 1e-8);
  test::check_error("vectors of rotations", back, 1e-12);
}

/** A prescribed rigid motion, and the same by formulas for the nodes. */
void
test_prescribed(const std::string &name, const std::string &settings)
{
  const std::string bottom =
    "Boundary conditions/Displacement = bottom: x = 0, y = 0";
  const auto by_side = test::run_scene<2>(
    block<2>() + settings + bottom +
    "\nBoundary conditions/Rigid sides = top: x = 0.1*t, y = 0.05*t, rotation "
    "= 0.4*t, centre = (0.3, 0.8)\n");
  const bool was_quadratic = quadratic();
  const auto by_nodes      = test::run_scene<2>(
    block<2>() + settings + bottom +
    "; top: x = 0.1*t + (cos(0.4*t)-1)*(x-0.3) - sin(0.4*t)*(y-0.8), y = "
         "0.05*t + sin(0.4*t)*(x-0.3) + (cos(0.4*t)-1)*(y-0.8)\n");
  for (const std::string a : {"x", "y"})
    test::check_error("prescribed by side and nodes, " + name + ", " + a,
                      relative(by_side->last_statistics().get("Reaction " + a +
                                                              " on bottom (N)"),
                               by_nodes->last_statistics().get(
                                 "Reaction " + a + " on bottom (N)")),
                      1e-7);
  test::check_error("force of the side, " + name,
                    relative(-of_side(*by_side, "Force x", "N"),
                             by_nodes->last_statistics().get(
                               "Reaction x on bottom (N)")),
                    1e-7);
  test::check("quadratic convergence, " + name, was_quadratic, "");
}

/** Equilibrium of both ends of a block; then the loads that have been found are
 * applied, and the motion must come back. */
template <int dim>
void
test_loads(const std::string &name,
           const std::string &settings,
           const std::string &motion)
{
  const auto moved =
    test::run_scene<dim>(block<dim>() + settings +
                         "Boundary conditions/Rigid sides = " + motion + '\n');
  const std::string   held = motion.substr(0, motion.find(';') + 1);
  std::ostringstream  loads;
  std::vector<double> expected;
  loads.precision(17);
  Tensor<1, 3> force, moment, lower_force, lower_moment, arm;
  for (unsigned int a = 0; a < dim; ++a)
    {
      const std::string axis = std::string(" ") + "xyz"[a];
      force[a]               = of_side(*moved, "Force" + axis, "N");
      lower_force[a]         = of_side(*moved, "Force" + axis, "N", "bottom");
      const double u         = of_side(*moved, "Translation" + axis, "m");
      arm[a]                 = (a == 1 ? 1 : 0) + u;
      expected.push_back(u);
      loads << (a > 0 ? ", " : "") << "force" << axis << " = " << force[a]
            << "*t";
    }
  for (unsigned int a = (dim == 2 ? 2 : 0); a < 3; ++a)
    {
      const std::string axis = dim == 2 ? "" : std::string(" ") + "xyz"[a];
      moment[a]              = of_side(*moved, "Moment" + axis, "N m");
      lower_moment[a] = of_side(*moved, "Moment" + axis, "N m", "bottom");
      expected.push_back(of_side(*moved, "Rotation" + axis, "rad"));
      loads << ", moment" << axis << " = " << moment[a] << "*t";
    }
  test::check_error("forces in equilibrium, " + name,
                    (force + lower_force).norm() / force.norm(),
                    1e-8);
  test::check_error(
    "moments in equilibrium, " + name,
    (moment + lower_moment + cross_product_3d(arm, force)).norm() /
      moment.norm(),
    1e-8);

  const auto loaded = test::run_scene<dim>(
    block<dim>() + settings + "Boundary conditions/Rigid sides = " + held +
    " top: " + loads.str() + '\n');
  double       worst = 0;
  unsigned int k     = 0;
  for (unsigned int a = 0; a < dim; ++a, ++k)
    worst =
      std::max(worst,
               std::abs(
                 of_side(*loaded, std::string("Translation ") + "xyz"[a], "m") -
                 expected[k]));
  for (unsigned int a = (dim == 2 ? 2 : 0); a < 3; ++a, ++k)
    worst =
      std::max(worst,
               std::abs(of_side(*loaded,
                                "Rotation" +
                                  (dim == 2 ? "" : std::string(" ") + "xyz"[a]),
                                "rad") -
                        expected[k]));
  test::check_error("loads instead of motions, " + name, worst, 1e-7);
  test::check("quadratic convergence with loads, " + name, quadratic(), "");
}

/** A beam bent to a part of a circle by its ends: M = E I κ for ν = 0. */
void
test_bending()
{
  const auto run = [](const std::string &angle) {
    return test::run_scene<2>(
      "Grid/Upper corner = 8, 1\nGrid/Subdivisions = 96, 16\nGrid/Diagonals = "
      "alternating\nMaterial/Young modulus = 1e4\nMaterial/Poisson ratio = "
      "0\nFormulation/Type = u\nNewton/Tolerance = 1e-9\n"
      "Boundary conditions/Rigid sides = left: x = 0, y = 0, rotation = 0; "
      "right: rotation = " +
      angle + '\n');
  };
  const auto   bent   = run("0.01*t");
  const double moment = of_side(*bent, "Moment", "N m", "right");
  test::check_error("bending moment",
                    relative(moment, 1e4 / 12. * 0.01 / 8),
                    0.02);
  test::check_error("no force",
                    std::abs(of_side(*bent, "Force y", "N", "right")) / moment,
                    1e-6);
  // the end of an arc of length 8 and angle 0.01
  test::check_error("deflection",
                    relative(of_side(*bent, "Translation y", "m", "right"),
                             8 / 0.01 * (1 - std::cos(0.01))),
                    0.01);
}

/** A round bar of radius 1/2 and length 1 along y, n x n cells over the
 * section, which the square is mapped to. */
std::string
round_bar(const unsigned int n)
{
  const std::string name = "bar_" + std::to_string(n) + ".msh";
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      std::ofstream out(name);
      out.precision(17);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n"
             "2 1 \"bottom\"\n2 2 \"top\"\n3 3 \"bar\"\n$EndPhysicalNames\n"
             "$Nodes\n"
          << (n + 1) * (n + 1) * (n + 1) << '\n';
      const auto number =
        [n](const unsigned int i, const unsigned int j, const unsigned int k) {
          return 1 + i + (n + 1) * (j + (n + 1) * k);
        };
      for (unsigned int k = 0; k <= n; ++k)
        for (unsigned int j = 0; j <= n; ++j)
          for (unsigned int i = 0; i <= n; ++i)
            {
              const double x = 2. * i / n - 1, z = 2. * k / n - 1;
              const double r = std::max(std::abs(x), std::abs(z));
              const double stretch =
                r > 0 ? (1 - r) + r * r / std::hypot(x, z) : 1;
              out << number(i, j, k) << ' ' << x * stretch / 2 << ' '
                  << double(j) / n << ' ' << z * stretch / 2 << '\n';
            }
      out << "$EndNodes\n$Elements\n" << 6 * n * n * n + 4 * n * n << '\n';
      unsigned int element = 0;
      const auto   write   = [&](const unsigned int type,
                             const unsigned int group) {
        out << ++element << ' ' << type << " 2 " << group << ' ' << group;
      };
      // Kuhn's six tetrahedra of each cell
      const unsigned int order[6][3] = {
        {0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
      for (unsigned int c = 0; c < n * n * n; ++c)
        for (const auto &axes : order)
          {
            unsigned int at[3] = {c % n, c / n % n, c / (n * n)};
            write(4, 3);
            out << ' ' << number(at[0], at[1], at[2]);
            for (const unsigned int a : axes)
              {
                ++at[a];
                out << ' ' << number(at[0], at[1], at[2]);
              }
            out << '\n';
          }
      for (const unsigned int j : {0u, n})
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int i = 0; i < n; ++i)
            for (const unsigned int other : {0, 1})
              {
                write(2, j == 0 ? 1 : 2);
                out << ' ' << number(i, j, k) << ' '
                    << number(i + 1 - other, j, k + other) << ' '
                    << number(i + 1, j, k + 1) << '\n';
              }
      out << "$EndElements\n";
    }
  MPI_Barrier(MPI_COMM_WORLD);
  return "Grid/Type = gmsh\nGrid/File = " + name + '\n';
}

/** Torsion of an incompressible Neo-Hookean bar of radius a, at any twist κ per
 * length: M = π G κ a⁴/2, axial force -π G κ² a⁴/4 (Rivlin). Two meshes,
 * extrapolated by their error of second order. */
void
test_torsion()
{
  const double G = 1e4 / 3, a = 0.5;
  const auto   run =
    [](const unsigned int n, const std::string &angle, const double step) {
      return test::run_scene<3>(
        round_bar(n) + test::keep_grid +
        "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0.5\n"
        "Formulation/Type = u-p\nFormulation/Stabilisation = PPP\n"
        "Formulation/PPP coefficient = 1\nNewton/Tolerance = 1e-8\n"
        "Newton/Reuse factorisation = 0\nTime/Step size = " +
        std::to_string(step) +
        "\nBoundary conditions/Rigid sides = bottom: x = 0, y = 0, z = 0, "
        "rotation x = 0, rotation y = 0, rotation z = 0; top: x = 0, y = 0, z "
        "= 0, rotation x = 0, rotation z = 0, rotation y = " +
        angle + '\n');
    };
  const double M            = numbers::PI * G * std::pow(a, 4) / 2;
  const auto   extrapolated = [](const double coarse, const double fine) {
    return (4 * fine - coarse) / 3;
  };
  const auto moment = [](const auto &problem) {
    return of_side(*problem, "Moment y", "N m");
  };
  test::check_error("torsion, small",
                    relative(extrapolated(moment(run(4, "0.01*t", 1)),
                                          moment(run(8, "0.01*t", 1))),
                             0.01 * M),
                    0.02);
  const auto   coarse = run(4, "pi/2*t", 0.25);
  const auto   fine   = run(8, "pi/2*t", 0.25);
  const double kappa  = numbers::PI / 2;
  test::check_error("torsion by 90 degrees",
                    relative(extrapolated(moment(coarse), moment(fine)),
                             kappa * M),
                    0.03);
  test::check_error("axial force",
                    relative(extrapolated(of_side(*coarse, "Force y", "N"),
                                          of_side(*fine, "Force y", "N")),
                             -kappa * kappa / 2 * M),
                    0.05);
  test::check_error("rotation in the statistics",
                    std::abs(of_side(*fine, "Rotation y", "rad") - kappa),
                    1e-10);
  test::check("quadratic convergence of torsion", quadratic(), "");
}

/** A body that turns freely with one rigid side turns as it does without. */
void
test_spin()
{
  for (const std::string quadrature : {"points", "CPDI"})
    {
      const std::string turning =
        block<2>() + test::keep_grid +
        "Dynamics/Inertia = true\nDynamics/Spectral radius = 1\n"
        "Material/Density = 1000\nMaterial/Young modulus = 1e7\n"
        "Time/End time = 1\nTime/Step size = 0.02\nNewton/Tolerance = 1e-8\n"
        "Dynamics/Initial velocity = -(y-0.5), x-0.5\nQuadrature/Type = " +
        quadrature + '\n';
      const std::string column = "Angular momentum z (kg m^2/s)";
      const double      free =
        test::run_scene<2>(turning)->last_statistics().get(column);
      const auto problem = test::run_scene<2>(
        turning + "Boundary conditions/Rigid sides = top: force x = 0\n");
      test::check_error("angle of a spinning body, " + quadrature,
                        std::abs(of_side(*problem, "Rotation", "rad") - 1),
                        1e-3);
      test::check_error("angular momentum, " + quadrature,
                        relative(problem->last_statistics().get(column), free),
                        1e-4);
      test::check_error("energy, " + quadrature,
                        std::abs(problem->last_statistics().get(
                          "Energy lost by the scheme (J)")) /
                          (1000. / 12),
                        1e-4);
    }
}

void
test_errors()
{
  const auto message = [](const std::string &sides) {
    std::string text;
    try
      {
        test::run_scene<2>(block<2>() +
                           "Boundary conditions/Rigid sides = " + sides + '\n');
      }
    catch (const ExceptionBase &exc)
      {
        std::ostringstream out;
        exc.print_info(out);
        text = test::one_line(out.str());
      }
    return text;
  };
  test::check("motion and force is an error",
              message("top: x = 0, force x = 1")
                  .find("both the displacement x") != std::string::npos,
              "");
  test::check("an unknown item is an error",
              message("top: turn = 1").find("must have the form") !=
                std::string::npos,
              "");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string up = "Formulation/Type = u-p\nFormulation/Stabilisation = "
                         "PPP\nMaterial/Poisson ratio = 0.5\n";
  test_rotation();
  test_prescribed("u", "");
  test_prescribed("u, kept grid", test::keep_grid + "Time/Step size = 0.25\n");
  test_prescribed("u-p, CPDI", up + "Quadrature/Type = CPDI\n");
  const std::string lower = "bottom: x = 0, y = 0, rotation = 0;";
  const std::string upper = " top: x = 0.2*t, y = -0.05*t, rotation = -0.3*t";
  test_loads<2>("2D, u", "", lower + upper);
  test_loads<2>("2D, u-p, CPDI",
                up + "Quadrature/Type = CPDI\n",
                lower + upper);
  test_loads<2>("2D, u, Block FGMRES",
                "Linear solver/Solver = Block FGMRES\n",
                lower + upper);
  const std::string lower_3d = "bottom: x = 0, y = 0, z = 0, rotation x = 0, "
                               "rotation y = 0, rotation z = 0;",
                    upper_3d = " top: x = 0.1*t, y = 0.05*t, z = -0.1*t, "
                               "rotation x = 0.2*t, rotation y = 0.4*t, "
                               "rotation z = -0.1*t";
  test_loads<3>("3D, u", "", lower_3d + upper_3d);
  test_loads<3>("3D, u, kept grid",
                test::keep_grid + "Time/Step size = 0.5\n",
                lower_3d + upper_3d);
  test_loads<3>("3D, u-p, Block FGMRES",
                up + "Linear solver/Solver = Block FGMRES\n",
                lower_3d + upper_3d);
  test_bending();
  test_torsion();
  test_spin();
  test_errors();
}
