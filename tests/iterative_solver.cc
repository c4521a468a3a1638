/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Steps that are solved by the iterative solver, less accurately far from the
// solution, end where those solved by the direct one do; where the iterative
// solver fails, the direct one takes over; `auto` chooses by size.

#include <isochor/linear_solver/multigrid.h>

#include <limits>
#include <map>

#include "scene.h"

using namespace isochor;

namespace
{
  /** A cube between plates. */
  const std::string cube =
    "Grid/Subdivisions = 5, 5, 5\nMaterial/Young modulus = 1000\n"
    "Material/Poisson ratio = 0.499\nTime/Step size = 0.5\n"
    "Postprocess/Point probes = A: 0.9, 0.5, 0.9\n"
    "Postprocess/Reactions = bottom\n"
    "Boundary conditions/Displacement = bottom: x=0, y=0, z=0; "
    "top: x=0, y=-0.04*t, z=0\n";

  struct Result
  {
    std::vector<double> values; ///< displacements, then the reaction
    double              linear_iterations = 0;
    bool                fell_back         = false;
    /** The column of the statistics in the last step; not a number: none. */
    double in_statistics = std::numeric_limits<double>::quiet_NaN();
  };

  template <int dim>
  Result
  run(const std::string &settings)
  {
    const auto  problem    = test::run_scene<dim>(settings);
    const auto &statistics = problem->last_statistics();
    Result      result;
    for (const char axis : {'x', 'y'})
      result.values.push_back(
        statistics.get("Displacement " + std::string(1, axis) + " of A (m)"));
    result.values.push_back(
      statistics.get(settings.find("n >=") == std::string::npos ?
                       "Reaction y on bottom (N)" :
                       "Force y on body by boundary bottom (N)"));
    for (const NewtonReport &newton : test::recorded().newton)
      result.linear_iterations += newton.n_linear_iterations();
    try
      {
        result.in_statistics = statistics.get("Linear iterations");
      }
    catch (const ExceptionBase &)
      {}
    for (const auto &warning : problem->all_warnings().all())
      result.fell_back =
        result.fell_back ||
        warning.subject == "the iterative linear solver failed";
    return result;
  }

  /** The largest difference, of displacements relative to the largest one. */
  double
  difference(const Result &a, const Result &b)
  {
    const double u     = std::max(std::abs(a.values[0]), std::abs(a.values[1]));
    double       worst = 0;
    for (unsigned int i = 0; i < 3; ++i)
      test::add_error(worst,
                      std::abs(a.values[i] - b.values[i]) /
                        (i < 2 ? u : std::abs(a.values[2])));
    return worst;
  }

  const std::string iteratively = "Linear solver/Solver = Block FGMRES\n";

  /** The same result, without help. */
  template <int dim>
  void
  compare(const std::string &what, const std::string &settings)
  {
    const Result direct = run<dim>(settings + "Linear solver/Solver = MUMPS\n");
    const Result iterative = run<dim>(settings + iteratively);
    test::check_error(what, difference(iterative, direct), 1e-8);
    test::check(what + ", iterations",
                !iterative.fell_back && iterative.linear_iterations > 0 &&
                  direct.linear_iterations == 0,
                std::to_string(iterative.linear_iterations));
  }

  void
  test_robustness()
  {
    for (const std::string ratio : {"0.3", "0.499", "0.5"})
      compare<3>("Poisson ratio " + ratio,
                 cube + "Material/Poisson ratio = " + ratio + "\n");
    compare<3>("without pressures",
               cube + "Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n");
    compare<3>("other units", cube + "Material/Young modulus = 3e-6\n");
    compare<3>("stiff inclusion",
               cube + "Material points/Materials in zones = 2: x<0.5 && y<0.5\n"
                      "Material 2/Young modulus = 1e7\n"
                      "Material 2/Poisson ratio = 0.499\n");
    compare<3>("plasticity",
               cube + "Material/Model = J2\nMaterial/J2/Yield stress = 25\n");
    compare<3>("friction, unsymmetric",
               cube + "Material/Model = Mohr-Coulomb\n"
                      "Material/Poisson ratio = 0.3\n"
                      "Material/Mohr-Coulomb/Cohesion = 10\n"
                      "Material/Mohr-Coulomb/Friction angle = 30\n");
    compare<3>("cut cells",
               cube + "Grid/Lower corner = -0.01, 0, -0.01\n"
                      "Grid/Upper corner = 1.237, 1, 1.237\n"
                      "Material points/Region = x>=0 && x<=1 && z>=0 && z<=1\n"
                      "Material points/Points per cell = 8\n"
                      "Quadrature/Type = CPDI\n");
    compare<3>("smooth wall that lets go",
               cube + "Quadrature/Type = CPDI\n"
                      "Boundary conditions/Walls = bottom: n >= 0\n"
                      "Boundary conditions/Displacement = "
                      "top: x=0, y=-0.04*t + 0.06*t*x*t, z=0\n");
    compare<3>("dynamics",
               cube + "Material/Density = 1\nDynamics/Inertia = true\n"
                      "Boundary conditions/Gravity = 0, -100, 0\n"
                      "Boundary conditions/Displacement = bottom: x=0, y=0, "
                      "z=0\nTime/Step size = 0.005\nTime/End time = 0.01\n");
    compare<2>("2D",
               "Grid/Subdivisions = 12, 12\nMaterial/Young modulus = 1000\n"
               "Material/Poisson ratio = 0.499\nTime/Step size = 1\n"
               "Postprocess/Point probes = A: 0.9, 0.5\n"
               "Postprocess/Reactions = bottom\n"
               "Boundary conditions/Displacement = bottom: x=0, y=0; "
               "top: x=0, y=-0.04*t\n");
  }

  /** The body is in a corner of the grid, where one rank has all of it. */
  void
  test_ranks_without_rows()
  {
    for (const std::string form : {"u-p", "u"})
      compare<3>(
        "ranks without equations, " + form,
        "Grid/Upper corner = 8, 1, 1\nGrid/Subdivisions = 40, 5, 5\n"
        "Material points/Region = x < 0.6\n"
        "Grid reset/Tolerated imbalance = 100\nQuadrature/Type = CPDI\n"
        "Formulation/Type = " +
          form +
          "\nMaterial/Model = J2\nMaterial/J2/Yield stress = 1\n"
          "Material/Young modulus = 100\n"
          "Material/Poisson ratio = 0.3\nMaterial/Density = 1\n"
          "Boundary conditions/Displacement = left: x=0; front: z=0; "
          "back: z=0; bottom: x=0, y=0, z=0\n"
          "Boundary conditions/Gravity = 0, -1.5*t, 0\n"
          "Time/Step size = 0.5\n"
          "Postprocess/Point probes = A: 0.5, 0.5, 0.5\n"
          "Postprocess/Reactions = bottom\n");
  }

  /** Whatever approximates the inverse of the stiffness, also where the
   * hierarchy is that of another matrix. */
  void
  test_multigrid()
  {
    const std::string names = PluginRegistry<Multigrid>::names();
    const std::string flow =
      cube + "Material/Model = J2\nMaterial/J2/Yield stress = 25\n";
    const std::string method = "Linear solver/Block FGMRES/Multigrid = ";
    const std::vector<std::string> scenes = {
      flow,
      flow + "Linear solver/Block FGMRES/Slowdown = 100\n",
      cube + "Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n"};
    double                        worst = 0, n_fell_back = 0;
    std::map<std::string, double> iterations;
    for (const std::string &scene : scenes)
      {
        const Result direct = run<3>(scene + "Linear solver/Solver = MUMPS\n");
        for (const std::string &name : Utilities::split_string_list(names, '|'))
          {
            const Result result =
              run<3>(scene + iteratively + method + name + "\n");
            test::add_error(worst, difference(result, direct));
            n_fell_back += result.fell_back;
            iterations.emplace(name, result.linear_iterations);
          }
      }
    test::check_error("with each multigrid method", worst, 1e-8);
    test::check("none of them needs help",
                n_fell_back == 0.,
                std::to_string(n_fell_back));

    const bool   has_hypre = names.find("BoomerAMG") != std::string::npos;
    const double automatic = run<3>(flow + iteratively).linear_iterations;
    test::check("auto takes BoomerAMG where materials may yield",
                automatic == iterations[has_hypre ? "BoomerAMG" : "ML"],
                std::to_string(automatic));
    test::check("where it needs less",
                !has_hypre || automatic < 0.95 * iterations["ML"],
                std::to_string(iterations["ML"]));
  }

  void
  test_choice()
  {
    const Result direct = run<3>(cube);
    test::check("auto takes the direct solver for small systems",
                direct.linear_iterations == 0,
                std::to_string(direct.linear_iterations));
    const Result iterative =
      run<3>(cube + "Linear solver/Largest direct system = 100\n");
    test::check("auto takes the iterative solver beyond the bound",
                iterative.linear_iterations > 0,
                std::to_string(iterative.linear_iterations));

    const Result exact =
      run<3>(cube + iteratively + "Newton/Inexact = false\n");
    test::check_error("solved exactly", difference(exact, direct), 1e-8);
    test::check("inexact iterations save work",
                iterative.linear_iterations < 0.7 * exact.linear_iterations,
                std::to_string(iterative.linear_iterations) + " of " +
                  std::to_string(exact.linear_iterations));

    const Result helped =
      run<3>(cube + iteratively +
             "Linear solver/Block FGMRES/Maximum iterations = 2\n");
    test::check_error("the direct solver takes over",
                      difference(helped, direct),
                      1e-8);
    test::check("and a warning says so", helped.fell_back, "no warning");
    test::check("the statistics count no iterations of its own",
                helped.in_statistics >= 0 && std::isnan(direct.in_statistics),
                std::to_string(helped.in_statistics));
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_robustness();
  test_ranks_without_rows();
  test_multigrid();
  test_choice();
  return 0;
}
