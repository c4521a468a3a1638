/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Nodes that hardly any material touches follow others by default. That carries
// no load: the footing, the column and the plate need the same without.

#include "scene.h"

using namespace isochor;

/** The last value of @p column of the scene @p name of prm/ with @p settings.
 */
double
result(const std::string &name,
       const std::string &settings,
       const std::string &column)
{
  ParameterHandler prm;
  MaterialPointMethod<2>::declare_parameters(prm);
  prm.declare_entry("Dimension", "2");
  prm.parse_input(SOURCE_DIR "/../prm/" + name + ".prm");
  test::set_parameters(prm,
                       "Output/Terminal = quiet\nOutput/Directory = .\n"
                       "Postprocess/Write grid = false\n"
                       "Postprocess/Write material points = false\n" +
                         settings);
  MaterialPointMethod<2> problem(MPI_COMM_WORLD);
  problem.parse_parameters(prm);
  problem.run();
  return problem.last_statistics().get(column);
}

void
compare(const std::string &name,
        const std::string &settings,
        const std::string &column)
{
  const double by_default = result(name, settings, column),
               without    = result(name,
                                settings + "Cut cells/Extension = never\n",
                                column);
  test::check_error(name, test::relative(by_default, without), 0.01);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  compare("strip_footing/strip_footing",
          "Grid/File = " SOURCE_DIR "/footing.msh\nTime/End time = 0.2\n"
          "Time/Step size = 0.025\n",
          "Reaction y on footing (N)");
  compare("column/column", "", "Displacement y of P (m)");
  compare("tension_plate/tension_plate",
          "Grid/Type = box\nGrid/Upper corner = 0.0615, 0.1\n"
          "Grid/Subdivisions = 16, 20\nMaterial points/Region = x > 0.004 && "
          "x < 0.055 && (x-0.03)^2 + (y-0.05)^2 > 1e-4\n"
          "Time/Step size = 0.05\n",
          "Reaction y on top (N)");
  return 0;
}
