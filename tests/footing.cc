/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What the strip footing needs besides the method: conditions that let go,
// points that are split. And the scene prm/strip_footing/strip_footing.prm
// itself on a coarse mesh,
//   gmsh -2 footing.geo -setnumber h 0.4 -setnumber h_far 2.5
//     -setnumber h_edge 0.125 -o footing.msh

#include <isochor/base/mpi_sums.h>

#include <set>

#include "scene.h"

using namespace isochor;

namespace
{
  const std::string u_p = "Formulation/Type = u-p\n"
                          "Formulation/Stabilisation = PPP\n";
} // namespace

/** The horizontal stretch of a Neo-Hookean block whose vertical one is
 * @p stretch, in plane strain without horizontal stress:
 * K (J - 1) + G J^(-5/3) (l² - (l² + stretch² + 1) / 3) = 0. */
double
free_stretch(const double stretch, const double K, const double G)
{
  double low = 0.5, high = 2;
  while (high - low > 1e-13)
    {
      const double l = 0.5 * (low + high), J = l * stretch;
      const double stress =
        K * (J - 1) + G * std::pow(J, -5. / 3) *
                        (l * l - (l * l + stretch * stretch + 1) / 3);
      (stress > 0 ? high : low) = l;
    }
  return low;
}

/** A block beside a wall that it can leave: pressed, it can't widen; pulled, it
 * gets as narrow as it would without the wall. */
void
test_wall_that_lets_go()
{
  const double E = 100, nu = 0.3;
  for (const std::string &formulation :
       {std::string("Formulation/Type = u\n"), u_p})
    for (const double stretch : {0.9, 1.1})
      {
        const auto problem = test::run_scene<2>(
          formulation +
          "Grid/Subdivisions = 4, 4\nMaterial points/Points per cell = 4\n"
          "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.3\n"
          "Quadrature/Type = CPDI\nTime/Step size = 0.1\n"
          "Boundary conditions/Walls = right: n >= 0\n"
          "Grid/Stretch = y: 0 -> 0, 1 -> t*(" +
          std::to_string(stretch - 1) +
          ")\nBoundary conditions/Displacement = left: x=0; bottom: y=0; "
          "top: y = t*(" +
          std::to_string(stretch - 1) + ")\n");
        const double expected =
          stretch < 1 ?
            1. :
            free_stretch(stretch, E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu)));
        const PointLayout &l     = problem->material_points().layout();
        double             error = 0;
        for (const auto &point : problem->material_points().handler())
          test::add_error(error,
                          std::abs(point.get_properties()[l.F] - expected));
        const std::string what =
          (formulation == u_p ? ", u-p" : ", u") +
          std::string(stretch < 1 ? ", pressed" : ", pulled");
        test::check_error("beside a wall" + what,
                          Utilities::MPI::max(error, MPI_COMM_WORLD),
                          1e-6);
        const double reaction = problem->last_statistics().get(
          "Force x on body by boundary right (N)");
        test::check("force of the wall" + what,
                    stretch < 1 ? reaction < -1 : std::abs(reaction) < 1e-6,
                    std::to_string(reaction));
      }
}

/** The scene of the footing to w = B/2 in 20 steps: load, volume, points. */
void
test_scene()
{
  ParameterHandler prm;
  MaterialPointMethod<2>::declare_parameters(prm);
  prm.declare_entry("Dimension", "2");
  prm.parse_input(SOURCE_DIR "/../prm/strip_footing/strip_footing.prm");
  test::set_parameters(prm,
                       "Grid/File = " SOURCE_DIR "/footing.msh\n"
                       "Time/End time = 0.5\nTime/Step size = 0.025\n"
                       "Output/Terminal = quiet\nOutput/Directory = .\n"
                       "Postprocess/Write grid = false\n"
                       "Postprocess/Write material points = false\n");
  test::recorded() = {};
  MaterialPointMethod<2> problem(MPI_COMM_WORLD);
  problem.parse_parameters(prm);
  problem.run();
  const auto  &statistics = problem.last_statistics();
  const double q = -statistics.get("Reaction y on footing (N)") / 0.5 / 1e3;
  // reference at w/B = 0.5 within 0.1, of two independent methods
  test::check_error("footing", std::abs(q - 5.95), 0.4);
  test::check_error("volume of the soil",
                    std::abs(statistics.get("Material volume (m^2)") - 120),
                    0.36);
  test::check_error("volume in the grid",
                    std::abs(statistics.get("Volume in the grid (m^2)") - 120),
                    1.2);
  // 9 without a start for nodes that the soil reaches, and with contact that
  // changes only when Newton's method has converged
  unsigned int most = 0;
  for (const NewtonReport &newton : test::recorded().newton)
    most = std::max(most, newton.n_factorisations);
  test::check("iterations of a step",
              most > 0 && most <= 7,
              std::to_string(most));
  std::set<types::particle_index> ids;
  for (const auto &point : problem.material_points().handler())
    ids.insert(point.get_id());
  test::check("numbers of the points",
              Utilities::MPI::sum(ids.size(), MPI_COMM_WORLD) ==
                statistics.get("Number of material points"),
              "not unique");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_wall_that_lets_go();
  test_scene();
  return 0;
}
