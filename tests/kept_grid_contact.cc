/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A grid that moves with the bodies is put back where they come near to each
// other, to themselves or to a boundary: before, they went through it.

#include "run_scene.h"

using namespace isochor;

const std::string kept = "Grid reset/Steps between resets = 0\n";

/** Whether a warning says that the grid is put back from now on. */
template <int dim>
bool
warns(const MaterialPointMethod<dim> &problem)
{
  for (const auto &warning : test::all_warnings(problem).all())
    if (warning.subject == "contact on a grid that is kept")
      return true;
  return false;
}

/** Two discs (in space balls) that collide have, until they part, the energy
 * that they have on a grid which is put back in each step. */
template <int dim>
void
test_collision(const std::string &discs, const std::string &grid)
{
  const std::string scene =
    grid +
    "Formulation/Type = u\nDynamics/Inertia = true\n"
    "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.3\n"
    "Material/Density = 1\nMaterial points/Points per cell = 4\n"
    "Material points/Region = " +
    discs;
  const std::string column = "Kinetic energy (J)";
  const auto        reference =
    test::run_scene<dim>(scene + "Grid reset/Steps between resets = 1\n");
  const double      energy  = test::get(*reference, column);
  const auto        problem = test::run_scene<dim>(scene + kept);
  const std::string name    = std::to_string(dim) + "D, two bodies: ";
  test::check_error(name + "energy",
                    test::relative(test::get(*problem, column), energy),
                    1e-6);
  test::check(name + "warning",
              warns(*problem) && !warns(*reference),
              test::all_warnings(*problem).summary());
  test::check(name + "most steps before keep their grid",
              test::work(*problem).row("searches for all points").skipped > 4,
              "");
  // they meet when the grid is put back
  const auto often =
    test::run_scene<dim>(scene + "Grid reset/Steps between resets = 5\n");
  test::check_error(name + "energy, resets now and then",
                    test::relative(test::get(*often, column), energy),
                    dim == 2 ? 0.02 : 0.05);
  test::check(name + "warning",
              warns(*often),
              test::all_warnings(*often).summary());
}

/** A block falls from a @p height (m) above the ground, which holds it, and the
 * grid is put back a few times. */
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
    "Time/Step size = 0.01\nPostprocess/Reactions = bottom\n" +
    settings;
  const auto problem = test::run_scene<dim>(scene + kept);
  test::check(name + ": the ground holds it",
              test::get(*problem, "Displacement y of foot (m)") > -height,
              std::to_string(
                test::get(*problem, "Displacement y of foot (m)")));
  test::check(name + ": it has reached the ground",
              test::largest_in_statistics("Reaction y on bottom (N)") > 1 ||
                test::this_rank() > 0,
              "");
  const auto row = test::work(*problem).row("searches for all points");
  test::check(name + ": the grid is put back a few times only",
              row.done > 1 && row.done < 8,
              std::to_string(row.done));
  test::check(name + ": no warning of bodies", !warns(*problem), "");
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

/** The arms of a fork come together. */
void
test_fork()
{
  const auto problem = test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 1\n"
    "Grid/Subdivisions = 32, 16\nMaterial points/Region = "
    "x > 0.2 && x < 1.6 && y > 0.25 && y < 0.8125 && "
    "(x < 0.5 || y < 0.4375 || y > 0.625)\n"
    "Material/Young modulus = 1000\nMaterial/Density = 1\n"
    "Dynamics/Inertia = true\nDynamics/Initial velocity = "
    "0, if(x > 0.5, (x - 0.5)*if(y < 0.5, 3, -3), 0)\n"
    "Postprocess/Point probes = low: 1.55, 0.4; high: 1.55, 0.66\n"
    "Time/Step size = 0.002\nTime/End time = 0.06\n" +
    kept);
  const double gap = 0.26 + test::get(*problem, "Displacement y of high (m)") -
                     test::get(*problem, "Displacement y of low (m)");
  test::check("fork: its arms don't go through each other",
              gap > 0.05,
              std::to_string(gap));
  test::check("fork: warning",
              warns(*problem),
              test::all_warnings(*problem).summary());
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
    "Postprocess/Reactions = right\n"
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
                       "Postprocess/Reactions = bottom\n"
                       "Time/Step size = 0.01\nTime/End time = 0.006\n" +
                       kept);
  const double force = test::get(*problem, "Reaction y on bottom (N)");
  test::check("a body that would shoot through the ground meets it",
              force > 1e6,
              std::to_string(force));
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
    "Postprocess/Reactions = bottom\n"
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
        "Postprocess/Reactions = bottom\n"
        "Postprocess/Point probes = foot: 1, 0.3\n"
        "Time/Step size = 0.01\nTime/End time = 0.2\n" +
        kept);
      test::check("corner: the ground holds it",
                  test::get(*problem, "Displacement y of foot (m)") > -0.3,
                  speed);
    }
}

/** Blocks that are pressed to 0.6 of their height, one on a grid that it fills,
 * have nothing to come near to. */
void
test_no_contact()
{
  // the second one bulges along the ground, beyond the grid
  for (const std::string region : {"y < 0.5", "x < 0.8 && y < 0.5", "y < 1"})
    {
      const auto problem = test::run_scene<2>(
        "Grid/Subdivisions = 8, 8\nMaterial points/Region = " + region +
        "\nMaterial/Young modulus = 1000\n"
        "Boundary conditions/Displacement = bottom: y=0; left: x=0\n"
        "Boundary conditions/Surfaces of body = top: y > " +
        (region == "y < 1" ? "0.999" : "0.499") +
        "\nQuadrature/Type = CPDI\nInteraction: top - place/Displacement = y=-0.4*t" +
        (region == "y < 1" ? "" : "/2") + "\nTime/Step size = 0.1\n" + kept);
      const auto row = test::work(*problem).row("searches for all points");
      test::check(region + " pressed: the grid stays",
                  row.done == 1 && !warns(*problem),
                  std::to_string(row.done));
    }
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_collision<2>("((x+0.1)^2+(y-0.5)^2 < 0.09) || "
                    "((x-0.9)^2+(y-0.5)^2 < 0.09)\n",
                    "Grid/Lower corner = -1, 0\nGrid/Upper corner = 2, 1\n"
                    "Grid/Subdivisions = 24, 8\n"
                    "Dynamics/Initial velocity = 1 - 2*(x > 0.4), 0\n"
                    "Time/Step size = 0.005\nTime/End time = 0.3\n");
  test_collision<3>("((x+0.3)^2+(y-0.5)^2+(z-0.5)^2 < 0.16) || "
                    "((x-1.1)^2+(y-0.5)^2+(z-0.5)^2 < 0.16)\n",
                    "Grid/Lower corner = -1, 0, 0\n"
                    "Grid/Upper corner = 2, 1, 1\n"
                    "Grid/Subdivisions = 12, 4, 4\n"
                    "Dynamics/Initial velocity = 1 - 2*(x > 0.4), 0, 0\n"
                    "Time/Step size = 0.02\nTime/End time = 0.4\n");
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
               "Dynamics/Initial velocity = 0, -2, 0\nTime/End time = 0.2\n");
  test_fall_between_resets();
  test_fork();
  test_thin_slab();
  test_second_body();
  test_chance();
  test_corner();
  test_no_contact();
}
