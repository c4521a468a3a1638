/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Walls hold what comes to them, also on a grid that moves with the body and is
// never put back, and however far a step goes.

#include "run_scene.h"

using namespace isochor;

const std::string kept  = "Grid reset/Steps between resets = 0\n"
                          "Grid reset/Smallest element quality = 0\n";
const std::string force = "Force y on body by boundary bottom (N)";

/** A block falls from a @p height (m) above the ground, which holds it. */
template <int dim>
void
test_fall(const std::string &name,
          const double       height,
          const std::string &grid,
          const std::string &settings)
{
  const std::string scene =
    grid +
    "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
    "Dynamics/Inertia = true\nBoundary conditions/Walls = bottom: n >= 0\n"
    "Quadrature/Type = CPDI\nTime/Step size = 0.01\n" +
    settings;
  const auto problem = test::run_scene<dim>(scene + kept);
  test::check(
    name + ": the ground holds it",
    test::get(*problem, "Displacement y of foot (m)") > -height - 0.01,
    std::to_string(test::get(*problem, "Displacement y of foot (m)")));
  test::check(name + ": it has reached the ground",
              test::largest_in_statistics(force) > 1 || test::this_rank() > 0,
              "");
  const auto row = test::work(*problem).row("searches for all points");
  test::check(name + ": the grid is never put back",
              row.done == 1,
              std::to_string(row.done));
}

/** With resets now and then, on a grid of cells of several sizes: a block falls
 * freely until it is there, on any number of ranks. */
void
test_fall_between_resets()
{
  const auto problem = test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Type = adaptive\n"
    "Grid/Upper corner = 2, 2\nGrid/Subdivisions = 4, 4\n"
    "Adaptive grid/Maximum level = 2\nAdaptive grid/Cell size = 0.125\n"
    "Material points/Region = x > 0.5 && x < 1.5 && y > 0.25 && y < 1\n"
    "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
    "Dynamics/Inertia = true\nBoundary conditions/Walls = bottom: n >= 0\n"
    "Boundary conditions/Gravity = 0, -10\n"
    "Postprocess/Point probes = foot: 1, 0.26\n"
    "Time/Step size = 0.01\nTime/End time = 0.2\n"
    "Grid reset/Steps between resets = 5\n");
  test::check_error("a block 5 cm above the ground has only fallen",
                    std::abs(test::get(*problem, "Displacement y of foot (m)") +
                             0.2),
                    1e-10);
}

/** A slab of one layer of cells slides along the ground into a wall. */
void
test_thin_slab()
{
  const auto problem = test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 1\n"
    "Grid/Subdivisions = 16, 8\n"
    "Material points/Region = x > 0.5 && x < 1 && y < 0.125\n"
    "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
    "Dynamics/Inertia = true\nDynamics/Initial velocity = 2, 0\n"
    "Boundary conditions/Displacement = bottom: y=0\n"
    "Boundary conditions/Walls = right: n >= 0\n"
    "Postprocess/Point probes = nose: 0.95, 0.05\n"
    "Time/Step size = 0.01\nTime/End time = 0.7\n" +
    kept);
  const double nose = test::get(*problem, "Displacement x of nose (m)");
  test::check("slab: the wall throws it back",
              nose < 1.05 && nose > 0.3,
              std::to_string(nose));
}

/** One block rests, another falls where the first one does not lie, by more
 * than its height in a step: it is not forgotten for the one that rests. */
void
test_second_body()
{
  const auto problem =
    test::run_scene<2>("Quadrature/Type = CPDI\nGrid/Upper corner = 3, 2\n"
                       "Grid/Subdivisions = 24, 16\n"
                       "Material points/Region = (x < 1 && y < 0.5) || "
                       "(x > 2 && x < 2.5 && y > 0.5 && y < 1)\n"
                       "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
                       "Dynamics/Inertia = true\n"
                       "Dynamics/Initial velocity = 0, if(x > 1.5, -120, 0)\n"
                       "Boundary conditions/Walls = bottom: n >= 0\n"
                       "Time/Step size = 0.01\nTime/End time = 0.006\n" +
                       kept);
  const double on_second =
    test::get(*problem, "Force y on body 2 by boundary bottom (N)");
  test::check("a body that would shoot through the ground meets it",
              on_second > 1e5,
              std::to_string(on_second));
}

/** A block falls on the ground in steps of up to 0.7 of a cell. Where it is
 * when the grid is put back is chance: with a corner of its domains in the last
 * row of cells, which holds little, or with points in cells that touch the
 * ground with a vertex only. The ground holds it all the same. */
void
test_chance()
{
  const std::string scene =
    "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 2\n"
    "Material points/Region = x > 0.5 && x < 1.5 && y > 0.25 && y < 1\n"
    "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
    "Dynamics/Inertia = true\nBoundary conditions/Gravity = 0, -10\n"
    "Boundary conditions/Walls = bottom: n >= 0\n"
    "Postprocess/Point probes = foot: 1, 0.26\nTime/End time = 0.3\n";
  for (const std::string grid : {"box\nGrid/Subdivisions = 16, 16\n",
                                 "adaptive\nGrid/Subdivisions = 4, 4\n"
                                 "Adaptive grid/Maximum level = 2\n"
                                 "Adaptive grid/Cell size = 0.125\n"})
    for (const std::string size : {"0.017", "0.03", "0.04"})
      {
        const std::string sized =
          scene + "Grid/Type = " + grid + "Time/Step size = " + size + "\n";
        const auto foot = [&](const std::string &interval) {
          return test::get(*test::run_scene<2>(
                             sized + "Grid reset/Steps between resets = " +
                             interval + "\n"),
                           "Displacement y of foot (m)");
        };
        const double reference = foot("1");
        for (const std::string interval : {"0", "2", "5"})
          test::check_error("steps of " + size + " s on a grid of type " +
                              grid.substr(0, grid.find('\n')) + ", kept for " +
                              interval,
                            std::abs(foot(interval) - reference) / 0.25,
                            0.06);
      }
}

/** A square falls on its corner, several cells deep in a step. That corner is
 * in cells without a face at the ground when they last saw it. */
void
test_corner()
{
  for (const std::string speed : {"2.5", "3"})
    {
      const auto problem = test::run_scene<2>(
        "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 2\n"
        "Grid/Subdivisions = 32, 32\n"
        "Material points/Region = abs(x - 1) + abs(y - 0.75) < 0.5\n"
        "Material/Young modulus = 1e5\nMaterial/Density = 1000\n"
        "Dynamics/Inertia = true\n"
        "Dynamics/Initial velocity = 0, -" +
        speed +
        "\nBoundary conditions/Walls = bottom: n >= 0\n"
        "Postprocess/Point probes = foot: 1, 0.3\n"
        "Time/Step size = 0.01\nTime/End time = 0.2\n" +
        kept);
      test::check("corner: the ground holds it",
                  test::get(*problem, "Displacement y of foot (m)") > -0.3,
                  speed);
    }
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_fall<2>("block",
               0.25,
               "Grid/Upper corner = 2, 2\nGrid/Subdivisions = 16, 16\n"
               "Material points/Region = "
               "x > 0.5 && x < 1.5 && y > 0.25 && y < 1\n"
               "Postprocess/Point probes = foot: 1, 0.26\n",
               "Boundary conditions/Gravity = 0, -10\nTime/End time = 0.5\n");
  test_fall<2>("fast block",
               0.25,
               "Grid/Upper corner = 2, 2\nGrid/Subdivisions = 16, 16\n"
               "Material points/Region = "
               "x > 0.5 && x < 1.5 && y > 0.25 && y < 1\n"
               "Postprocess/Point probes = foot: 1, 0.26\n",
               "Dynamics/Initial velocity = 0, -5\nTime/End time = 0.1\n");
  test_fall<3>("block in space",
               0.5,
               "Grid/Upper corner = 1, 2, 1\nGrid/Subdivisions = 4, 8, 4\n"
               "Material points/Region = "
               "x < 0.5 && y > 0.5 && y < 1 && z < 0.5\n"
               "Postprocess/Point probes = foot: 0.2, 0.51, 0.2\n"
               "Boundary conditions/Displacement = left: x=0; back: z=0\n",
               "Dynamics/Initial velocity = 0, -2, 0\nTime/End time = 0.3\n");
  test_fall_between_resets();
  test_thin_slab();
  test_second_body();
  test_chance();
  test_corner();
  return 0;
}
