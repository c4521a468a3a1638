/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Diagnoses read only: results are bitwise the same whichever of them look.
// Their explanations are short enough to be read, and none is missing.

#include <isochor/base/explanation.h>

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::vector<std::string> columns = {"Displacement y of tip (m)",
                                            "Displacement x of tip (m)",
                                            "Newton iterations",
                                            "Factorisations",
                                            "Material volume (m^2)"};

  /** All values of the run, and how many warnings there were. */
  std::pair<std::map<std::string, std::vector<double>>, std::size_t>
  run(const std::string &scene, const std::string &level)
  {
    test::record_columns(columns);
    const auto problem =
      test::run_scene<2>(scene + "Diagnosis/Level = " + level + '\n');
    return {test::recorded().columns,
            test::all_warnings(*problem).all().size()};
  }

  void
  test_scene(const std::string &what, const std::string &scene)
  {
    const auto all = run(scene, "all"), essential = run(scene, "essential"),
               none = run(scene, "none");
    test::check(what + ", the same results",
                all.first == none.first && all.first == essential.first &&
                  all.first.size() == columns.size(),
                "");
    test::check(what + ", warnings",
                all.second > 0 && essential.second <= all.second &&
                  none.second == 0,
                std::to_string(all.second) + ", " +
                  std::to_string(essential.second) + ", " +
                  std::to_string(none.second));
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession  mpi(argc, argv);
  const std::string beam =
    "Grid/Lower corner = 0, -1\nGrid/Upper corner = 1.25, 0.5\n"
    "Grid/Subdivisions = 10, 12\nQuadrature/Type = CPDI\n"
    "Material points/Region = x < 1 && y > 0 && y < 0.125\n"
    "Material points/Points per cell = 1\nMaterial/Density = 1000\n"
    "Material/Young modulus = 1e7\nMaterial/Poisson ratio = 0.499\n"
    "Boundary conditions/Displacement = left: x=0, y=0\n"
    "Postprocess/Point probes = tip: 1, 0.0625\n";
  test_scene("a beam of one cell",
             beam + "Boundary conditions/Gravity = 0, -10*t\n"
                    "Time/Step size = 0.1\n");
  test_scene("the beam in motion",
             beam + "Boundary conditions/Gravity = 0, -10\n"
                    "Material/Young modulus = 1e8\nDynamics/Inertia = true\n"
                    "Time/Step size = 0.01\nTime/End time = 0.15\n");
  for (const std::string level : {"all", "none"})
    {
      std::string message;
      try
        {
          run("Grid/Upper corner = 4, 1.5\nGrid/Subdivisions = 16, 6\n"
              "Material points/Region = y < 1.03\n"
              "Material points/Lattice spacing = 0.6\n"
              "Boundary conditions/Displacement = left: x=0, y=0\n",
              level);
        }
      catch (const std::exception &exc)
        {
          message = test::one_line(exc.what());
        }
      test::check("a body that falls apart is an error, " + level,
                  message.find("falls apart") != std::string::npos,
                  message);
    }
  std::string missing;
  for (const Explanation &one : all_explanations())
    if (one.when.empty() || one.remedy.empty() ||
        find_explanation(one.name)->name != one.name)
      missing += one.name + "; ";
  test::check("explanations, 45 at most",
              missing.empty() && all_explanations().size() <= 45 &&
                all_explanations().size() > 20,
              std::to_string(all_explanations().size()) + " " + missing);
  return 0;
}
