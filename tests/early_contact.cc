/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A one-sided wall that acts on nodes of the grid that the body's surface has
// not reached: a warning says so, by how much, and not where nothing is wrong.

#include <iomanip>

#include "seal.h"

using namespace isochor;

const std::string subject = "a wall that acts before the body reaches it";

/** The text of the warning, or nothing. */
template <int dim>
std::string
warning(const MaterialPointMethod<dim> &problem)
{
  for (const auto &warning : test::all_warnings(problem).all())
    if (warning.subject == subject)
      return test::one_line(warning.text);
  return {};
}

/** The largest share of all steps. */
template <int dim>
double
largest_share(const std::string &settings, std::string &text)
{
  const auto problem = test::run_scene<dim>(settings);
  text               = warning(*problem);
  const double mine =
    test::this_rank() == 0 ?
      test::largest_in_statistics("Share of gaps in contact") :
      0.;
  return test::max_over_ranks(mine);
}

void
test_seal()
{
  test::write_disc(40);
  // how much too large the force is said to be, and how much it is
  for (const double squeeze : {0.03, 0.12})
    {
      const std::string what =
        "seal, squeezed by " + test::in_short(50 * squeeze) + " %";
      const auto problem =
        test::run_scene<2>(test::seal(20, squeeze, "Time/Step size = 0.1\n"));
      const double excess = 2 *
                              test::get(*problem, "Reaction y on bottom (N)") /
                              test::line_contact(squeeze, 0.49) -
                            1;
      const double       s = test::get(*problem, "Share of gaps in contact");
      std::ostringstream numbers;
      numbers << "excess " << excess << ", estimate " << s;
      // the body's mesh is a polygon, and strains are small
      test::check(what + ": the estimate of the error",
                  excess > 0.1 && 0.9 * s < excess && excess < 2.2 * s,
                  numbers.str());
      if (test::this_rank() == 0)
        std::cout << what << ": share of gaps " << std::setprecision(3) << s
                  << std::endl; // on any number of ranks
      const std::string text = warning(*problem);
      test::check(what + ": the warning",
                  text.find("<bottom> (<Boundary conditions/Displacement>)") !=
                      std::string::npos ||
                    text.find("<top> (<Boundary conditions/Displacement>)") !=
                      std::string::npos,
                  text);
    }
  for (const std::string quadrature : {"points", "cell-filled"})
    {
      std::string  text;
      const double share = largest_share<2>(
        test::seal(10, 0.06, "Quadrature/Type = " + quadrature + '\n'), text);
      test::check("seal, " + quadrature,
                  share > 0.1 && !text.empty(),
                  std::to_string(share) + text);
    }
}

/** A block between smooth walls below and to its left, pressed from above or by
 * its weight. */
template <int dim>
std::string
block(const std::string &region, const std::string &settings)
{
  const bool solid = (dim == 3);
  return std::string("Grid/Upper corner = 2, 2") + (solid ? ", 2" : "") +
         "\nGrid/Subdivisions = 8, 8" + (solid ? ", 8" : "") +
         "\nMaterial points/Region = " + region +
         "\nMaterial points/Points per cell = " + (solid ? "8" : "4") +
         "\nMaterial/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n"
         "Material/Density = 1\n"
         "Formulation/Type = u\nTime/Step size = 0.25\n" +
         settings;
}

template <int dim>
void
test_flat_sides(const std::string &quadrature)
{
  const std::string type = "Quadrature/Type = " + quadrature + '\n',
                    what = ", " + quadrature + ", dim " + std::to_string(dim),
                    g    = (dim == 3 ? ", 0" : ""),
                    fits = (dim == 3 ? " && z < 1.25" : "");
  const std::string weight =
    type + "Boundary conditions/Gravity = 0, -0.05*t" + g + '\n';
  std::string text;
  double      share;
  const auto  is_silent = [&](const std::string &scene) {
    test::check(scene + what + ": no warning",
                share < 1e-10 && text.empty(),
                std::to_string(share) + text);
  };
  // its free side in the middle of cells
  share = largest_share<dim>(
    block<dim>("x < 1.125 && y < 1" + fits,
               weight + "Boundary conditions/Displacement = left: x=0; " +
                 (dim == 3 ? "front: z>=0; " : "") + "bottom: y>=0\n"),
    text);
  is_silent("on its wall");
  share = largest_share<dim>(
    block<dim>("x < 1.125 && y < 1" + fits,
               weight + "Boundary conditions/Displacement = left: x=0\n" +
                 "Boundary conditions/Walls = bottom: n >= 0" +
                 (dim == 3 ? "; front: n >= 0\n" : "\n")),
    text);
  is_silent("on its smooth wall");
  // its lower side in the middle of cells
  share = largest_share<dim>(
    block<dim>("x < 1.125 && y > 0.125 && y < 1.25" + fits,
               weight + "Boundary conditions/Displacement = left: x=0; " +
                 (dim == 3 ? "front: z=0; " : "") + "bottom: y>=0\n"),
    text);
  // where its surface is known it comes down to it
  if (quadrature == "CPDI" || quadrature == "cell-filled + boundary")
    {
      test::check("half a cell above its wall" + what + ": no warning",
                  share < 0.02 && text.empty(),
                  std::to_string(share) + text);
      return;
    }
  const std::string at = "% of the force of the one-sided wall <bottom>";
  test::check("half a cell above its wall" + what + ": the warning",
              text.find(at) != std::string::npos,
              std::to_string(share) + text);
}

/** With domains the gap is known exactly. In dynamics nodes are held as soon as
 * there is material. */
void
test_gap()
{
  std::string text;
  largest_share<2>(
    block<2>("x < 1.125 && y > 0.125 && y < 1.25",
             "Quadrature/Type = CPDI\nDynamics/Inertia = true\n"
             "Boundary conditions/Gravity = 0, -1e-4*t\n"
             "Boundary conditions/Displacement = left: x=0; bottom: y>=0\n"),
    text);
  for (const std::string words : {"100 % of the force",
                                  "the body is 0.125 m away",
                                  ", 0.5 cells,",
                                  "by an estimated half or more"})
    test::check("half a cell: " + words,
                text.find(words) != std::string::npos,
                text);
}

/** A block that is pressed to 60 % of its height bulges, and its sides roll on
 * to the plates between which it sticks above and slides below. */
void
test_bulging()
{
  for (const std::string quadrature : {"CPDI", "cell-filled + boundary"})
    {
      std::string  text;
      const double share = largest_share<2>(
        block<2>("x < 1.125",
                 "Grid/Stretch = y: 0 -> 0, 2 -> -0.8*t\n"
                 "Material/Poisson ratio = 0.49\nFormulation/Type = u-p\n"
                 "Time/Step size = 0.05\nQuadrature/Type = " +
                   quadrature +
                   "\nBoundary conditions/Displacement = left: x=0; bottom: "
                   "y>=0; top: x=0, y=-0.8*t\n"),
        text);
      test::check("bulging, " + quadrature + ": no warning",
                  share < 0.02 && text.empty(),
                  std::to_string(share) + text);
    }
}

/** On grids that are kept nodes are at the body's surface, and remember how far
 * they are from the wall. */
void
test_kept_grid()
{
  for (const std::string walls :
       {"Walls = bottom: n >= -0.02*(x-1)^2\n",
        "Displacement = bottom: y >= -0.02*(x-1)^2\n"})
    {
      std::string  text;
      const double share = largest_share<2>(
        block<2>("1",
                 test::keep_grid +
                   "Quadrature/Type = CPDI\n"
                   "Boundary conditions/Surfaces of body = up: y > 1.999\n"
                   "Interaction: up - place/Displacement = x=0, y=-0.04*t\n"
                   "Boundary conditions/" +
                   walls),
        text);
      test::check("kept grid, " + walls.substr(0, walls.find(' ')) +
                    ": no warning",
                  share < 1e-6 && text.empty(),
                  std::to_string(share) + text);
    }
}

/** A ball as a body of revolution, and on a grid that adapts. */
void
test_other_grids()
{
  std::string text;
  double      share = largest_share<2>(
    test::seal(10, 0.1, "Formulation/Geometry = axisymmetric\n"), text);
  test::check("ball", share > 0.05 && !text.empty(), std::to_string(share));
  share = largest_share<2>(
    block<2>("(x-1)^2 + (y-0.5)^2 < 0.25",
             "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
             "Grid/Subdivisions = 4, 4\nAdaptive grid/Cell size = 0.1\n"
             "Boundary conditions/Gravity = 0, -0.05*t\n"
             "Boundary conditions/Displacement = bottom: y>=0, x=0\n"),
    text);
  test::check("adaptive", share > 0.05 && !text.empty(), std::to_string(share));
  share = largest_share<2>(
    block<2>("x < 1.125 && y < 1",
             "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
             "Grid/Subdivisions = 4, 4\nAdaptive grid/Cell size = 0.1\n"
             "Boundary conditions/Gravity = 0, -0.05*t\n"
             "Boundary conditions/Displacement = bottom: y>=0; left: x=0\n"),
    text);
  test::check("adaptive, on its wall: no warning",
              share < 1e-10 && text.empty(),
              std::to_string(share) + text);
}

/** Boundaries that hold the body do the same. */
void
test_held()
{
  const std::string cpdi = "Quadrature/Type = CPDI\n";
  for (const std::string conditions :
       {"Displacement = left: x=0; bottom: y=0; top: y=-0.06*t\n",
        "Displacement = left: x=0\n"
        "Boundary conditions/Walls = bottom: n = 0; top: n = 0.06*t\n"})
    {
      const auto problem = test::run_scene<2>(
        test::seal(10, 0.06, cpdi + "Boundary conditions/" + conditions));
      const std::string text = warning(*problem);
      test::check(conditions.find("Walls") == std::string::npos ?
                    "seal, held" :
                    "seal, held by walls",
                  text.find("% of the force of the held boundary <") !=
                    std::string::npos,
                  text);
    }
  // pressed and pulled, by boundaries that the grid follows or not: what pulls
  // it out of a grid that stays loses it
  for (const std::string motion : {"-0.1*t", "0.1*t"})
    for (const std::string &grid : {"y: 0 -> 0, 2 -> " + motion, std::string()})
      {
        if (grid.empty() && motion[0] != '-')
          continue;
        const auto problem = test::run_scene<2>(
          block<2>("x < 1.125",
                   cpdi + "Grid/Stretch = " + grid +
                     "\nBoundary conditions/Displacement = left: x=0; bottom: "
                     "y=0; top: x=0, y=" +
                     motion + '\n'));
        const std::string text = warning(*problem);
        test::check("held at once, moved by " + motion +
                      (grid.empty() ? "" : ", grid, too") + ": no warning",
                    text.empty(),
                    text);
      }
}

/** On a grid that is kept a node without points in its cells, which those of
 * other cells act on with Q1, doesn't know where it is. */
void
test_unknown_places()
{
  const auto problem = test::run_scene<2>(
    "Grid/Upper corner = 2.4, 2.2\nGrid/Subdivisions = 4, 5\n"
    "Grid/Diagonals = alternating\nGrid/Offset = 0.547, 0.684\n"
    "Grid/Shape functions = Q1\nMaterial points/Region = y < 0.3\n"
    "Material points/Points per cell = 1\nMaterial points/Domains = always\n"
    "Material points/Least points per cell = 4\n"
    "Material points/Split at share of cell = 0.5\n"
    "Quadrature/Type = cell-filled\nFormulation/Type = u\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y>=0\n"
    "Boundary conditions/Gravity = 0, -1e-3*t\n"
    "Time/End time = 0.2\nTime/Step size = 0.1\n"
    "Grid reset/Steps between resets = 3\n");
  const double share = test::get(*problem, "Share of gaps in contact");
  test::check("kept grid, a node without a place: a share that is one",
              share >= 0 && share < 1,
              std::to_string(share));
}

/** Planes of symmetry in tension press at single nodes of the body's rim, with
 * some millionths of their force: no wall that acts early. */
void
test_planes_of_symmetry()
{
  const std::string mesh = SOURCE_DIR "/quarter_ring.msh";
  const auto        problem =
    test::run_scene<2>("Grid/Upper corner = 2.25, 2.25\n"
                       "Grid/Subdivisions = 27, 27\n"
                       "Material points/Body mesh = " +
                       mesh +
                       "\nMaterial points/Points per cell = 16\n"
                       "Quadrature/Type = CPDI\nFormulation/Type = u-p\n"
                       "Material/Young modulus = 1000\n"
                       "Material/Poisson ratio = 0.3\nMaterial/Density = 0\n"
                       "Boundary conditions/Displacement = left: x=0; bottom: "
                       "y=0\n"
                       "Boundary conditions/Mesh of body surfaces = " +
                       mesh +
                       "\nBoundary conditions/Surfaces of body = i: "
                       "x^2+y^2<1.001\n"
                       "Boundary conditions/Pressure on body = i: 1e-3*t\n"
                       "Postprocess/Reactions = left\n"
                       "Time/End time = 1\nTime/Step size = 0.5\n");
  test::check_error(
    "ring under pressure, force at a plane of symmetry",
    test::relative(std::abs(test::get(*problem, "Reaction x on left (N)")),
                   1e-3),
    1e-3);
  test::check("no warning there", warning(*problem).empty(), warning(*problem));
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_seal();
  for (const std::string quadrature :
       {"points", "cell-filled", "cell-filled + boundary", "CPDI"})
    test_flat_sides<2>(quadrature);
  test_flat_sides<3>("CPDI");
  test_flat_sides<3>("points");
  test_gap();
  test_bulging();
  test_kept_grid();
  test_other_grids();
  test_held();
  test_planes_of_symmetry();
  test_unknown_places();
}
