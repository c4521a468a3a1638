/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The scenes of prm/ on adaptive grids, coarser: as good as on uniform grids
// with the same smallest cells, with a fraction of the equations.

#include <isochor/step/material_point_method.h>

#include <fstream>

#include "scene.h"

using namespace isochor;

namespace
{
  /** What a scene of prm/ says itself; files it includes come before it. */
  void
  parse_scene(ParameterHandler &prm, const std::string &name)
  {
    std::ifstream     in(SOURCE_DIR "/../prm/" + name);
    std::stringstream text;
    for (std::string line; std::getline(in, line);)
      if (line.compare(0, 8, "include ") != 0)
        text << line << '\n';
    prm.parse_input(text, name);
  }

  /** A scene that has run, and the error it ended with, if any. */
  template <int dim>
  struct Run
  {
    std::unique_ptr<MaterialPointMethod<dim>> problem;
    std::string                               error;
  };

  template <int dim>
  Run<dim>
  run(const std::string &directory,
      const std::string &base,
      const std::string &settings)
  {
    ParameterHandler prm;
    MaterialPointMethod<dim>::declare_parameters(prm);
    prm.declare_entry("Dimension", std::to_string(dim));
    for (const std::string &name : {base, std::string("adaptive")})
      parse_scene(prm, directory + '/' + name + ".prm");
    test::set_parameters(prm,
                         "Output/Terminal = quiet\nOutput/Directory = .\n"
                         "Postprocess/Write grid = false\n"
                         "Postprocess/Write material points = false\n" +
                           settings);
    test::recorded() = {};
    Run<dim> result;
    result.problem = std::make_unique<MaterialPointMethod<dim>>(MPI_COMM_WORLD);
    result.problem->parse_parameters(prm);
    try
      {
        result.problem->run();
      }
    catch (const std::exception &error)
      {
        result.error = test::one_line(error.what());
      }
    return result;
  }

  void
  check_range(const std::string &what,
              const double       value,
              const double       lower,
              const double       upper)
  {
    std::ostringstream details;
    details << value << " is not between " << lower << " and " << upper;
    test::check(what, lower <= value && value <= upper, details.str());
  }
} // namespace

/** The load at which the cut falls: exact 5.4 to 5.5; on the uniform grid with
 * the same smallest cells, 32 over the height, 5.67 with 11030 equations. */
void
test_vertical_cut()
{
  const auto cut = run<2>("vertical_cut",
                          "vertical_cut",
                          "Adaptive grid/Maximum level = 3\n"
                          "Adaptive grid/Cell size in plastic zones = 0.125\n"
                          "Time/Step size = 0.01\n");
  test::check("vertical cut: a limit load",
              cut.error.find("No equilibrium found: limit load") !=
                std::string::npos,
              cut.error);
  check_range("vertical cut: gamma H/c of the uniform grid within 1 %",
              8 * test::recorded().times.back(),
              0.99 * 5.67,
              1.01 * 5.67);
  const Statistics &statistics = cut.problem->last_statistics();
  check_range("vertical cut: equations",
              statistics.get("Equations"),
              500,
              11030 / 3.5);
  check_range("vertical cut: finest level",
              statistics.get("Finest level of grid"),
              3,
              3);
}

/** On the uniform grid with the same smallest cells N_c is 6.078 at a
 * settlement of 0.15 % of the width, with 28880 equations. */
void
test_square_footing()
{
  const auto        footing    = run<3>("square_footing",
                              "square_footing",
                              "Grid/File = " SOURCE_DIR "/square_footing.msh\n"
                                        "Time/End time = 0.25\n");
  const Statistics &statistics = footing.problem->last_statistics();
  test::check("square footing: to the end",
              footing.error.empty(),
              footing.error);
  check_range("square footing: N_c of the uniform grid within 1 %",
              -4e-3 * statistics.get("Reaction y on footing (N)"),
              0.99 * 6.078,
              1.01 * 6.078);
  check_range("square footing: equations",
              statistics.get("Equations"),
              2000,
              28880 / 5.);
}

/** Stress and settlement against the closed form; 28.418 m is what
 * prm/column/study.py finds. */
void
test_column()
{
  const auto        column     = run<2>("column", "column", "");
  const Statistics &statistics = column.problem->last_statistics();
  test::check("column: to the end", column.error.empty(), column.error);
  check_range("column: error of the stress",
              statistics.get("L2 error of stress yy"),
              0,
              0.01);
  test::check_error(
    "column: settlement",
    std::abs(statistics.get("Displacement y of P (m)") / -28.417981 - 1),
    1e-4);
}

/** Grids that are to follow the body, and can't. */
void
test_never_changes()
{
  const auto is_told = [](const std::string &settings,
                          const std::string &subject) {
    const auto problem = test::run_scene<2>(
      "Grid/Type = adaptive\nTime/Step size = 0.1\n"
      "Boundary conditions/Displacement = bottom: x=0, y=0; top: x=0.001*t\n"
      "Grid/Upper corner = 1.25, 1\nGrid/Subdivisions = 5, 4\n"
      "Material points/Region = x < 1\n"
      "Output/Terminal = quiet\n" +
      settings);
    for (const auto &warning : problem->all_warnings().all())
      if (warning.subject == subject)
        return true;
    return false;
  };
  const std::string target = "Adaptive grid/Target of relative error",
                    zones  = "Adaptive grid/Cell size in plastic zones";
  test::check("a grid that never changes",
              is_told(target + " = 0.1\n"
                               "Adaptive grid/Resets between changes = 0\n",
                      "no effect of <" + target + ">"),
              "no warning");
  test::check("plastic zones of what never yields",
              is_told(zones + " = 1\n", "no effect of <" + zones + ">"),
              "no warning");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_column();
  test_never_changes();
  test_square_footing();
  test_vertical_cut();
  return 0;
}
