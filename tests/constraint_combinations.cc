/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Walls, rigid bodies and periodic sides together, on adaptive grids, and in
// motion: sums of forces are exact, and what is the same body has the same
// answer.

#include <sstream>

#include "../doc/plugins/elastic_bed.cc"
#include "../doc/plugins/lever.cc"
#include "scene.h"

using namespace isochor;
using test::get;
using test::relative;

namespace
{
  /** Coarse cells of a quarter, smaller ones as far as x = 0.25 + t/2. */
  const std::string adaptive =
    "Grid/Type = adaptive\nGrid/Subdivisions = 4, 4\n"
    "Adaptive grid/Maximum level = 1\n"
    "Adaptive grid/Cell size = if(x < 0.3 + 0.5*t, 0.12, 0.3)\n";

  std::string
  message(const std::string &settings)
  {
    try
      {
        test::run_scene<2>(settings);
      }
    catch (const std::exception &exception)
      {
        return test::one_line(exception.what());
      }
    return "no error";
  }
} // namespace

/** A block rests on a smooth plane of 30 degrees, and on a stop, while the grid
 * changes from step to step. */
void
test_walls_on_adaptive_grid(const std::string &settings)
{
  const double       c = std::sqrt(0.75), s = 0.5;
  std::ostringstream corners;
  corners.precision(17);
  corners << "0, 0; " << c << ", " << s << "; " << c - s << ", " << s + c
          << "; " << -s << ", " << c << '\n';
  for (const std::string walls :
       {"left: n = 0; bottom: n = 0", "left: n >= 0; bottom: n >= 0"})
    {
      const auto problem = test::run_scene<2>(
        adaptive + settings +
        "Grid/Coarse cells = trapezoid\nGrid/Corners = " + corners.str() +
        "Material/Young modulus = 1e5\nMaterial/Density = 100\n"
        "Postprocess/Reactions = bottom, left\nNewton/Tolerance = 1e-10\n"
        "Boundary conditions/Gravity = 0, -10*t\nTime/Step size = 0.25\n"
        "Boundary conditions/Walls = " +
        walls +
        (walls.find('>') == std::string::npos ? "\n" :
                                                "\nQuadrature/Type = CPDI\n"));
      const auto along =
        [&](const std::string &name, const double x, const double y) {
          const std::string of   = walls.find('>') == std::string::npos ?
                                     " on " :
                                     " on body by boundary ",
                            what = of == " on " ? "Reaction " : "Force ";
          return x * get(*problem, what + "x" + of + name + " (N)") +
                 y * get(*problem, what + "y" + of + name + " (N)");
        };
      test::check("the grid changes", get(*problem, "Changes of grid") > 1, "");
      test::check_error("weight on a plane, " + walls,
                        relative(along("bottom", -s, c), 1000 * c),
                        1e-8);
      test::check_error("weight at the stop, " + walls,
                        relative(along("left", c, s), 1000 * s),
                        1e-8);
    }
}

/** A rigid lid on top of the unit block, that this is tied to. */
std::string
lid(const std::string &settings)
{
  return "\nQuadrature/Type = CPDI\nRigid body: lid/Shape = half plane\n"
         "Rigid body: lid/Point = 0.5, 1\n" +
         settings +
         "\nBoundary conditions/Surfaces of body = top: y > 0.999\n"
         "Interaction: top - lid/Law = tie\n";
}

/** A lid that moves without a rotation, and the same by formulas for the
 * surface, while the grid changes; both ends are in equilibrium. */
void
test_lid_on_adaptive_grid(const std::string &settings)
{
  const std::string block =
    adaptive + settings +
    "Material/Young modulus = 1e4\nNewton/Tolerance = 1e-10\n"
    "Postprocess/Reactions = bottom\nTime/Step size = 0.25\n"
    "Material points/Region = (x-0.25)*(0.75-x)\n"
    "Boundary conditions/Displacement = bottom: x = 0, y = 0\n";
  const auto by_lid = test::run_scene<2>(
    block + lid("Rigid body: lid/Motion = x=0.05*t, y=-0.04*t"));
  const auto by_formulas = test::run_scene<2>(
    block + "Boundary conditions/Surfaces of body = top: y > 0.999\n"
            "Interaction: top - place/Displacement = x=0.05*t, y=-0.04*t\n");
  for (const std::string a : {"x", "y"})
    {
      const double reaction =
        get(*by_formulas, "Reaction " + a + " on bottom (N)");
      test::check_error(
        "a rigid body on an adaptive grid, " + a,
        relative(get(*by_lid, "Reaction " + a + " on bottom (N)"), reaction),
        1e-7);
      test::check_error(
        "its force, " + a,
        relative(get(*by_lid, "Force " + a + " on top by lid (N)"), -reaction),
        1e-7);
    }
}

/** Conditions that know vertices find them again when the grid changes. A bed
 * of stiff springs holds a block as a fixed side does; the sides of a lever
 * move by 1 to -2. */
void
test_plugins_on_adaptive_grid()
{
  const std::string block =
    adaptive +
    "Adaptive grid/Cell size = if(x < 0.1 + t, 0.12, 0.3)\n"
    "Cut cells/Extension = never\nMaterial/Young modulus = 1e4\nNewton/Tolerance = 1e-10\n"
    "Postprocess/Reactions = top\nTime/Step size = 0.25\n"
    "Postprocess/Point probes = b: 0.5, 0.001; t: 0.5, 0.999\n"
    "Boundary conditions/Displacement = left: x = 0; right: x = 0; ";
  const auto fixed = test::run_scene<2>(block + "bottom: y = 0; top: y = "
                                                "-0.001*t\n");
  const auto bed =
    test::run_scene<2>(block + "top: y = -0.001*t\nBoundary conditions/Elastic "
                               "bed/Boundary = bottom\nBoundary conditions/"
                               "Elastic bed/Stiffness = 1e12\n");
  const std::string reaction = "Reaction y on top (N)";
  test::check("the grid of the bed changes",
              get(*bed, "Changes of grid") > 1,
              "");
  test::check_error("an elastic bed on an adaptive grid",
                    relative(get(*bed, reaction), get(*fixed, reaction)),
                    1e-6);
  const auto lever =
    test::run_scene<2>(block + "\nBoundary conditions/Lever/Boundaries = "
                               "bottom, top\nBoundary conditions/Lever/Ratio "
                               "= 2\nBoundary conditions/Lever/Force = "
                               "100*t\n");
  test::check_error("a lever on an adaptive grid",
                    relative(get(*lever, "Displacement y of t (m)"),
                             -1.997 / 0.997 *
                               get(*lever, "Displacement y of b (m)")),
                    1e-2);
}

/** Simple shear by γ of a periodic cell with three sizes of triangles, σ_xy =
 * G γ; and sides that are not refined alike. */
void
test_periodic_sides_on_adaptive_grid()
{
  const std::string cell =
    "Grid/Type = adaptive\nGrid/Subdivisions = 4, 4\n"
    "Adaptive grid/Maximum level = 2\nMaterial/Young modulus = 3e4\n"
    "Newton/Tolerance = 1e-11\nBoundary conditions/Hold periodic corner = "
    "true\nBoundary conditions/Periodic sides = left: right; bottom: top, x = "
    "0.3*t\n";
  for (const std::string form : {"u", "u-p"})
    {
      const auto problem = test::run_scene<2>(
        cell + "Material/Poisson ratio = 0.45\nFormulation/Type = " + form +
        "\nAdaptive grid/Cell size = if(abs(x-0.5) + abs(y-0.5) < 0.3, 0.07, "
        "0.3)\n");
      test::check_error("periodic shear on an adaptive grid, " + form,
                        relative(get(*problem,
                                     "Force x through bottom and top (N)"),
                                 0.3 * 3e4 / 2.9),
                        1e-8);
    }
  const std::string uneven =
    message(cell + "Adaptive grid/Cell size = if(x < 0.3, 0.12, 0.3)\n");
  test::check("sides that are refined differently",
              uneven.find("the sides <left> and <right> of <Boundary "
                          "conditions/Periodic sides> don't match") !=
                  std::string::npos &&
                uneven.find("<Adaptive grid") != std::string::npos,
              uneven);
}

/** A rigid lid between periodic sides, with the loads that act on it. */
void
test_lid_between_periodic(const std::string &settings)
{
  const auto run = [&](const std::string &pairs) {
    return test::run_scene<2>(
      "Grid/Subdivisions = 4, 5\nMaterial/Young modulus = 1e4\n"
      "Newton/Tolerance = 1e-11\nPostprocess/Reactions = bottom\n"
      "Boundary conditions/Displacement = bottom: x = 0, y = "
      "0.01*t*sin(2*pi*x)\n" +
      settings +
      lid("Rigid body: lid/Free = x, y\n"
          "Rigid body: lid/Force = x=50*t, y=-300*t") +
      "Boundary conditions/Periodic sides = " + pairs + '\n');
  };
  const auto held  = run("left: right");
  const auto jump  = run("left: right, force y = 20*t");
  double     worst = 0, motion = 0;
  for (const auto *problem : {held.get(), jump.get()})
    for (const std::string a : {"x", "y"})
      {
        const double force = a == "x" ? 50 : -300;
        test::add_error(
          worst,
          std::abs(get(*problem, "Force " + a + " on top by lid (N)") - force) +
            std::abs(get(*problem, "Reaction " + a + " on bottom (N)") +
                     force));
        const std::string u = "Translation " + a + " of rigid body lid (m)";
        test::add_error(motion, relative(get(*problem, u), get(*held, u)));
      }
  std::string warnings;
  for (const auto &warning : held->all_warnings().all())
    warnings += test::one_line(warning.text);
  test::check("no contradiction by rounding",
              warnings.find("determine the same") == std::string::npos,
              warnings);
  test::check_error("forces on a lid between periodic sides", worst, 1e-5);
  test::check_error("the same motion, whoever holds the jump", motion, 1e-8);
}

/** One cell of a periodic body in motion, and two of them side by side. */
void
test_periodic_motion(const std::string &settings)
{
  const auto run = [&](const unsigned int n) {
    const std::string width = std::to_string(n);
    return test::run_scene<2>(
      "Grid/Upper corner = " + width +
      ", 1\nGrid/Subdivisions = " + std::to_string(4 * n) +
      ", 4\nMaterial/Young modulus = 10\nMaterial/Density = 0.01\n"
      "Material/Poisson ratio = 0.4\nFormulation/Type = u-p\n"
      "Formulation/Stabilisation = PPP\nNewton/Tolerance = 1e-11\n"
      "Dynamics/Inertia = true\nDynamics/Initial velocity = 2*y + "
      "sin(2*pi*x)*y, cos(2*pi*x)*y\n"
      "Time/End time = 0.02\nTime/Step size = 0.005\n"
      "Postprocess/Point probes = A: 0.4, 0.6\n" +
      test::keep_grid + settings +
      "Boundary conditions/Displacement = bottom: x = 0, y = 0\n"
      "Boundary conditions/Periodic sides = left: right\n"
      "Boundary conditions/Traction = top: 0, -0.02\n");
  };
  const auto one   = run(1);
  const auto two   = run(2);
  double     worst = 0;
  for (const std::string column :
       {"Displacement x of A (m)", "Displacement y of A (m)"})
    test::add_error(worst, relative(get(*two, column), get(*one, column)));
  test::check_error("two cells in motion are as one", worst, 1e-8);
  test::check_error("their energy",
                    relative(get(*two, "Kinetic energy (J)"),
                             2 * get(*one, "Kinetic energy (J)")),
                    1e-8);
}

/** Where the force of a side is that has no reaction. */
void
test_reactions()
{
  const std::string cell =
    "Grid/Subdivisions = 2, 2\nMaterial/Young modulus = 1e4\n"
    "Boundary conditions/Displacement = bottom: x = 0, y = 0.1*t\n"
    "Boundary conditions/Periodic sides = left: right\n";
  const auto problem = test::run_scene<2>(cell + "Postprocess/Reactions = "
                                                 "right\n");
  test::check("reaction of a periodic side",
              problem->all_warnings().all().empty(),
              problem->all_warnings().summary());
  const std::string error = message(cell + "Postprocess/Reactions = roof\n");
  test::check("reaction of a surface of the body",
              error.find("<Force x on roof by place (N)>") != std::string::npos,
              error);
}

/** Corners of a periodic cell that isn't one. */
void
test_warnings()
{
  const std::string corner =
    message("Grid/Subdivisions = 4, 4\nMaterial/Young modulus = 1e4\n"
            "Boundary conditions/Displacement = bottom: x = 0, y = 0\n"
            "Boundary conditions/Hold periodic corner = true\n"
            "Boundary conditions/Periodic sides = left: right\n"
            "Boundary conditions/Gravity = 0, -1\n");
  test::check("corners of one pair of periodic sides",
              corner.find("<Boundary conditions/Hold periodic corner> holds "
                          "nothing") != std::string::npos &&
                corner.find("in each direction (1 given)") != std::string::npos,
              corner);
}

/** An oedometer, turned by @p degrees: between smooth walls a rigid plate, free
 * to shift and to turn, is pressed along them. The state is uniaxial strain,
 * whatever the angle, and the plate has the force, its corners being guided by
 * the walls. Returns the plate's way along its force (m). */
double
test_guided_plate(const double degrees, const std::string &form)
{
  const double c = std::cos(degrees * numbers::PI / 180),
               s = std::sin(degrees * numbers::PI / 180);
  std::ostringstream text;
  text.precision(17);
  text << "Grid/Type = trapezoid\nGrid/Subdivisions = 4, 8\nGrid/Corners = "
       << "0, 0; " << c << ", " << s << "; " << c - 2 * s << ", " << s + 2 * c
       << "; " << -2 * s << ", " << 2 * c
       << "\nQuadrature/Type = CPDI\nRigid body: top/Shape = half plane\n"
          "Rigid body: top/Point = "
       << c / 2 - 2 * s << ", " << s / 2 + 2 * c
       << "\nRigid body: top/Free = x, y, rotation\n"
          "Rigid body: top/Force = x = "
       << 3e6 * s << "*t, y = " << -3e6 * c
       << "*t\nInteraction: end - top/Law = tie\n"
          "Boundary conditions/Surfaces of body = end: "
       << c << "*y - " << s << "*x > 1.999\n";
  const auto problem = test::run_scene<2>(
    text.str() + test::keep_grid + form +
    "Material/Young modulus = 1e7\nTime/Step size = 0.5\n"
    "Newton/Tolerance = 1e-11\nPostprocess/Reactions = left, right\n"
    "Boundary conditions/Walls = left: n = 0; right: n = 0; bottom: n = 0\n");
  const auto along = [&](const std::string &before,
                         const std::string &after,
                         const double       x,
                         const double       y) {
    return x * get(*problem, before + " x " + after) +
           y * get(*problem, before + " y " + after);
  };
  const std::string top  = "of rigid body top (m)";
  const std::string what = ", " + std::to_string(static_cast<int>(degrees));
  const double      turn = get(*problem, "Rotation of rigid body top (rad)"),
               slip      = along("Translation", top, c, s),
               side      = along("Reaction", "on left (N)", c, s) +
                      along("Reaction", "on right (N)", c, s),
               force = along("Force", "on end by top (N)", s, -c),
               shear = along("Force", "on end by top (N)", c, s);
  test::check("a plate between walls doesn't turn" + what,
              std::abs(turn) < 1e-9 && std::abs(slip) < 1e-9,
              std::to_string(turn) + ", " + std::to_string(slip));
  test::check("forces of a plate between walls" + what,
              relative(force, 3e6) < 1e-8 && std::abs(shear) < 1e-2 &&
                std::abs(side) < 1e-2,
              std::to_string(force) + ", " + std::to_string(shear) + ", " +
                std::to_string(side));
  return along("Translation", top, s, -c);
}



void
test_guided_plates(const std::string &form)
{
  const double straight = test_guided_plate(0, form);
  for (const double degrees : {30., 45., 100.})
    {
      const double turned = test_guided_plate(degrees, form);
      test::check("its way",
                  relative(turned, straight) < 1e-9,
                  std::to_string(turned) + " and " + std::to_string(straight));
    }
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string up = "Formulation/Type = u-p\nFormulation/Stabilisation = "
                         "PPP\nMaterial/Poisson ratio = 0.45\n";
  const std::string cpdi = "Quadrature/Type = CPDI\n"
                           "Material points/Points per cell = 4\n";
  test_walls_on_adaptive_grid(up + cpdi);
  test_lid_on_adaptive_grid(up + cpdi);
  test_periodic_sides_on_adaptive_grid();
  test_plugins_on_adaptive_grid();
  test_lid_between_periodic(up);
  test_periodic_motion("");
  test_reactions();
  test_warnings();
  test_guided_plates("Material/Poisson ratio = 0.3\n");
  test_guided_plates(up);
  return 0;
}
