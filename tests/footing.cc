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

/** One point per cell becomes dim + 2; volume, mass, momentum, centre and
 * second moment stay. The parts of a point with the volume V are at the
 * distance r from it, 2π r² = V in 2D, so that the sum over m x·x gains
 * 3/4 m r²; likewise in 3D. */
template <int dim>
void
test_splitting()
{
  const auto sums = [&](const std::string &split) {
    const auto problem = test::run_scene<dim>(
      std::string("Grid/Subdivisions = ") + (dim == 2 ? "4, 4" : "3, 3, 3") +
      "\nMaterial points/Points per cell = 1\n"
      "Material/Density = 3\nDynamics/Inertia = true\n"
      "Dynamics/Initial velocity = x, y*0" +
      (dim == 3 ? ", 0" : "") +
      "\nTime/End time = 1e-9\nTime/Step size = 1e-9\n"
      "Material points/Split at share of cell = " +
      split + '\n');
    const PointLayout    &l = problem->material_points().layout();
    std::array<double, 6> sum{};
    for (const auto &point : problem->material_points().handler())
      {
        const auto       values = point.get_properties();
        const double     m      = values[l.mass];
        const Point<dim> x      = point.get_location();
        sum[0] += 1;
        sum[1] += values[l.volume];
        sum[2] += m;
        sum[3] += m * values[l.velocity];
        sum[4] += m * x[0];
        sum[5] += m * x.square();
      }
    sum_over_ranks(sum, MPI_COMM_WORLD);
    return sum;
  };
  const auto        whole = sums("0"), parts = sums("0.5");
  const std::string d = std::to_string(dim) + "D";
  test::check("number of parts, " + d,
              parts[0] == (dim + 2) * whole[0],
              std::to_string(parts[0] / whole[0]));
  for (const unsigned int i : {1, 2, 3, 4})
    test::check_error("conserved quantity " + std::to_string(i) + ", " + d,
                      std::abs(parts[i] / whole[i] - 1),
                      i == 3 ? 1e-6 : 1e-12);
  const double V = 1. / whole[0], // of each point
    gain         = dim == 2 ? 3. / 4 * V / (2 * numbers::PI) :
                              3. / 5 * (1 - std::pow(5., -2. / 3)) *
                        std::pow(V * 3 / (4 * numbers::PI), 2. / 3);
  test::check_error("second moment, " + d,
                    std::abs((parts[5] - whole[5]) / (3 * gain) - 1),
                    1e-6);
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
  test_splitting<2>();
  test_splitting<3>();
  test_scene();
  return 0;
}
