/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Newton's method: corrections come from the residual and, where the matrix is
// factorised, from the matrix of the present iterate, whatever the line search
// tried in between; and it is quadratic in the plastic range.

#include <algorithm>
#include <array>
#include <functional>
#include <tuple>

#include "scene.h"

using namespace isochor;

/** An equation r(x) = 0 of one unknown, of which only |r| is used: each
 * correction is 1. It remembers where it was assembled. */
class MadeUpProblem
{
public:
  MadeUpProblem(const double                                start,
                const std::function<double(const double x)> residual)
    : x(start)
    , residual(residual)
  {
    problem.assemble = [this](const bool with_matrix) {
      residual_at = x;
      if (with_matrix)
        matrix_at = x;
      ResidualNorms norms;
      norms.displacement = this->residual(x);
      norms.force_scale  = 1;
      return norms;
    };
    problem.solve = [this](const bool factorise, const SolutionAccuracy &) {
      consistent =
        consistent && residual_at == x && (!factorise || matrix_at == x);
      n_factorisations += factorise;
      base = x;
      return 0u;
    };
    problem.has_factorisation = [this]() { return n_factorisations > 0; };
    problem.advance           = [this](const double s) { x = base + s; };
  }

  NewtonSolver::Problem problem;
  double                x;
  bool                  consistent       = true;
  unsigned int          n_factorisations = 0;

private:
  std::function<double(const double)> residual;
  double                              residual_at = 0, matrix_at = 0, base = 0;
};

NewtonReport
solve(MadeUpProblem &made_up, const std::string &settings)
{
  ParameterHandler prm;
  NewtonSolver::declare_parameters(prm);
  test::set_parameters(prm, settings);
  NewtonSolver solver;
  solver.parse_parameters(prm);
  return solver.solve(made_up.problem, nullptr);
}

void
check_consistency(const std::string   &what,
                  const MadeUpProblem &made_up,
                  const NewtonReport  &report,
                  const double         solution)
{
  test::check(what,
              report.converged && made_up.consistent && made_up.x == solution,
              std::string(made_up.consistent ? "" : "stale residual, ") +
                "at x = " + std::to_string(made_up.x));
}

void
test_consistency()
{
  // the full step from 0 to 1 grows, but all shorter ones grow more
  MadeUpProblem hump(-1, [](const double x) {
    return x >= 2 ? 0. : x == 1 ? 0.6 : x > 0 ? 0.9 : x == 0 ? 0.5 : 1.;
  });
  check_consistency("the full step was the best",
                    hump,
                    solve(hump, "Newton/Reuse factorisation = 0\n"),
                    2);

  // half of the step from 0 to 1 is best, and the next one is good
  MadeUpProblem half(-1, [](const double x) {
    return x >= 1.5 ? 0. : x == 1 ? 0.6 : x == 0.5 ? 0.1 : x == 0 ? 0.5 : 1.;
  });
  check_consistency("half of the step was the best",
                    half,
                    solve(half, "Newton/Reuse factorisation = 0\n"),
                    1.5);

  // promises to end in one iteration more than once, and doesn't
  const auto slow = [](const double x) {
    const std::array<double, 8> r = {{1, 1e-1, 1e-3, 1e-6, 4e-7, 1e-7, 1e-8}};
    return r[static_cast<unsigned int>(x)];
  };
  MadeUpProblem disappointing(0, slow);
  check_consistency("the end came later than foreseen",
                    disappointing,
                    solve(disappointing, "Newton/Reuse factorisation = 0\n"),
                    6);
  MadeUpProblem with_reuse(0, slow);
  check_consistency("the same with old matrices",
                    with_reuse,
                    solve(with_reuse, "Newton/Reuse factorisation = 0.2\n"),
                    6);
  test::check("old matrices were used",
              with_reuse.n_factorisations < 6,
              std::to_string(with_reuse.n_factorisations));

  // an old matrix that is content with little, and never ends
  MadeUpProblem      endless(0, [&](const double x) {
    return endless.n_factorisations > 1 ? 0. : std::pow(0.85, x);
  });
  const NewtonReport report =
    solve(endless,
          "Newton/Reuse factorisation = 0.9\nNewton/Maximum iterations = 15\n");
  test::check("no more old matrices than iterations allowed",
              report.converged && report.n_iterations() == 17 &&
                endless.n_factorisations == 2,
              std::to_string(report.n_iterations()) + ' ' + report.failure);
}

/** What can only be come closer to: each correction is shorter than the last
 * one. It is given up at the third of them if there is another start. */
void
test_other_start()
{
  for (const bool has_other_start : {true, false})
    {
      MadeUpProblem limit(-1, [](const double x) {
        return x >= 1 ? 2. : 0.5 / (2 + x);
      });
      limit.problem.has_other_start = has_other_start;
      const NewtonReport report =
        solve(limit, "Newton/Maximum iterations = 9\n");
      test::check(has_other_start ? "given up for another start" :
                                    "the only start is not given up",
                  !report.converged && limit.consistent &&
                    report.n_iterations() == (has_other_start ? 4 : 9),
                  std::to_string(report.n_iterations()) + ": " +
                    report.failure);
    }
}

/** Forces and volumes fall by turns, and half of a correction would solve it.
 */
void
test_cycle()
{
  const auto    is_between = [](const double x) { return x != std::floor(x); };
  const auto    is_even = [](const double x) { return std::fmod(x, 2) == 0; };
  MadeUpProblem cycle(0, [&](const double x) {
    return x == 0 ? 1. : is_between(x) ? 0. : is_even(x) ? 5.2e-4 : 5.4e-4;
  });
  cycle.problem.assemble = [&, forces = cycle.problem.assemble](const bool m) {
    ResidualNorms norms    = forces(m);
    norms.pressure         = cycle.x == 0        ? 1. :
                             is_between(cycle.x) ? 0. :
                             is_even(cycle.x)    ? 4.4e-3 :
                                                   4.3e-3;
    norms.volume_per_force = 1e3;
    return norms;
  };
  const NewtonReport report = solve(cycle, "Newton/Reuse factorisation = 0\n");
  test::check("forces and volumes don't fall by turns without end",
              report.converged && report.n_iterations() < 8,
              std::to_string(report.n_iterations()) + ' ' + report.failure);
}

/** A block between clamps is drawn into flow. From where the residual is small
 * enough for the zones to be known, r_{k+1} <= 100 r_k^2 down to rounding. */
void
test_plastic(const std::string &form)
{
  test::run_scene<2>(
    "Grid/Subdivisions = 8, 8\nGrid/Diagonals = alternating\n"
    "Grid/Stretch = y: 0 -> 0, 1 -> 0.02*t\n"
    "Material/Model = J2\nMaterial/J2/Yield stress = 1.5\n"
    "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.4\n"
    "Formulation/Type = " +
    form +
    "\nNewton/Reuse factorisation = 0\nNewton/Tolerance = 1e-11\nTime/Step size = 0.1\n"
    "Boundary conditions/Displacement = bottom: x=0, y=0; top: x=0, "
    "y=0.02*t\n");
  const double       tolerance = 1e-11;
  bool               quadratic = true;
  unsigned int       n_checked = 0, n_iterations = 0;
  std::ostringstream details;
  for (const NewtonReport &newton : test::recorded().newton)
    {
      n_iterations += newton.n_iterations();
      for (unsigned int k = 1; k + 1 < newton.iterations.size(); ++k)
        {
          const double r    = newton.iterations[k].displacement,
                       next = newton.iterations[k + 1].displacement;
          if (r > 1e-3 || r <= tolerance)
            continue;
          ++n_checked;
          details << r << "->" << next << ' ';
          quadratic = quadratic && next <= std::max(100 * r * r, tolerance);
        }
    }
  test::check("quadratic in the plastic range, " + form,
              quadratic && n_checked >= 5,
              details.str());
  const double mean =
    static_cast<double>(n_iterations) / test::recorded().newton.size();
  test::check("at most six iterations a step in the mean, " + form,
              mean <= 6,
              std::to_string(mean));
}

/** Where nothing changes the volume the pressure equation's residual is of
 * higher order in the strain, and says nothing of a correction. Two bars in a
 * row without lateral strain: Newton's method has nothing to shorten. */
void
test_no_change_of_volume()
{
  for (const std::string stretch : {"-0.002", "-0.1"})
    for (const std::string ratio : {"0", "1e-8"})
      {
        const auto problem = test::run_scene<2>(
          "Grid/Upper corner = 2, 1.25\nGrid/Subdivisions = 16, 10\n"
          "Formulation/Type = u-p\nQuadrature/Type = points\n"
          "Material points/Region = y < 1\n"
          "Material points/Materials in zones = 2: x > 1\n"
          "Material/Young modulus = 1e6\nMaterial 2/Young modulus = 3e6\n"
          "Material/Poisson ratio = " +
          ratio + "\nMaterial 2/Poisson ratio = " + ratio +
          "\nPostprocess/Reactions = right\n"
          "Boundary conditions/Displacement = left: x = 0; bottom: y = 0; "
          "right: x = " +
          stretch + "*t\n");
        const bool        small  = stretch == "-0.002";
        const std::string what   = stretch + " m, Poisson ratio " + ratio;
        const auto        newton = test::recorded().newton;
        bool              full   = true;
        for (const auto &iteration : newton.front().iterations)
          full = full && (iteration.step_length == 0. ||
                          iteration.step_length >= (small ? 1. : 0.5));
        test::check("corrections, " + what,
                    full && newton.size() == 1 &&
                      newton.front().n_iterations() <= (small ? 3 : 6),
                    std::to_string(newton.front().n_iterations()));
        if (small)
          test::check_error("force of two bars in a row, " + what,
                            test::relative(test::get(*problem,
                                                     "Reaction x on right (N)"),
                                           -0.002 / (1 / 1e6 + 1 / 3e6)),
                            3e-3);
      }
}

/** A linear problem whose iterative solver leaves exactly what it may: the
 * residual falls to 1, 1e-2, 1e-4 and 9e-9, unless that is just above the
 * tolerance. Then more is asked of the last solve, and no matrix is assembled
 * behind it. */
void
test_just_above_tolerance()
{
  for (const auto &[tolerance, n_expected, last] :
       {std::tuple<std::string, unsigned int, double>{"3e-9", 3, 1.5e-9},
        std::tuple<std::string, unsigned int, double>{"5e-10", 4, 5e-11},
        std::tuple<std::string, unsigned int, double>{"2e-8", 3, 9e-9}})
    {
      double                residual = 1, next = 1;
      bool                  was_with_matrix = true;
      NewtonSolver::Problem problem;
      problem.assemble = [&](const bool with_matrix) {
        was_with_matrix = with_matrix;
        ResidualNorms norms;
        norms.displacement = residual;
        norms.force_scale  = 1;
        return norms;
      };
      problem.solve = [&](const bool, const SolutionAccuracy &accuracy) {
        next = std::max(residual * accuracy.relative, accuracy.displacement);
        return 1u;
      };
      problem.is_iterative      = []() { return true; };
      problem.has_factorisation = []() { return true; };
      problem.advance           = [&](const double) { residual = next; };
      ParameterHandler prm;
      NewtonSolver::declare_parameters(prm);
      test::set_parameters(prm, "Newton/Tolerance = " + tolerance + '\n');
      NewtonSolver solver;
      solver.parse_parameters(prm);
      const NewtonReport report = solver.solve(problem, nullptr);
      test::check("iterations of an inexact method to " + tolerance,
                  report.converged && report.n_iterations() == n_expected &&
                    !was_with_matrix,
                  std::to_string(report.n_iterations()));
      test::check_error("and what they leave",
                        test::relative(residual, last),
                        1e-9);
    }
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_consistency();
  test_other_start();
  test_cycle();
  test_plastic("u");
  test_plastic("u-p");
  test_no_change_of_volume();
  test_just_above_tolerance();
  return 0;
}
