/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The springs that prescribe displacements on a surface of the body, as stiff
// as they are by default: on a curved surface that goes through cells they must
// not be too stiff, and on a body that is stiffer than they are a warning says
// that the surface stays behind. Exact: Lamé's thick cylinder, and uniaxial
// strain.

#include <algorithm>
#include <cmath>

#include "scene.h"

using namespace isochor;

/** A ring of radii 1 m and 2 m in plane strain, in a grid that knows nothing of
 * it, is widened at its bore by 1e-4 m. With u = A r + B/r and no stress
 * outside the pressure inside is 2 G B (1 - 1/4), and the force on the quarter
 * of the bore in a direction is that times 1 m. That force has the tangential
 * forces of the springs at the ends of the quarter in it, which alternate along
 * the bore. How stiff the ring is tells its strain energy. */
struct Widened
{
  double force, energy; ///< errors
  bool   too_stiff;     ///< warned of
};

Widened
widen_bore(const std::string &cells,
           const std::string &points,
           const std::string &settings)
{
  const double nu = 0.3, G = 0.5 / (1 + nu), w = 1e-4;
  const double B = w / (1 + (1 - 2 * nu) / 4), force = 2 * G * B * 0.75;
  const auto   ring = test::run_scene<2>(
    "Grid/Upper corner = 2.2, 2.2\nGrid/Subdivisions = " + cells + ", " +
    cells +
    "\nGrid reset/Steps between resets = 0\nFormulation/Type = u\n"
      "Material points/Points per cell = " +
    points +
    "\n"
      "Material points/Body mesh = " SOURCE_DIR "/quarter_ring.msh\n"
      "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n"
      "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
      "Boundary conditions/Mesh of body surfaces = " SOURCE_DIR
    "/quarter_ring.msh\n"
      "Boundary conditions/Surfaces of body = bore: x^2+y^2 < 1.05\n"
      "Boundary conditions/Displacement of body = "
      "bore: x=1e-4*t*x, y=1e-4*t*y\nOutput/Terminal = quiet\n"
      "Postprocess/Write energies = always\n" +
    settings);
  const auto &warnings = ring->all_warnings().all();
  return {
    test::get(*ring, "Reaction x on bore by boundary points (N)") / force - 1,
    test::get(*ring, "Strain energy (J)") / (force * w * numbers::PI / 4) - 1,
    std::any_of(warnings.begin(), warnings.end(), [](const auto &warning) {
      return warning.subject == "springs that are too stiff for a surface";
    })};
}

void
test_widened_bore()
{
  const Widened coarse = widen_bore("18", "4", ""),
                fine   = widen_bore("36", "16", "");
  test::check_error("bore of a ring, 8 cells thick",
                    std::abs(coarse.force),
                    0.08);
  test::check_error("bore of a ring, 16 cells thick",
                    std::abs(fine.force),
                    0.04);
  // most of this is the error of the quadrature
  test::check_error("its energy, 8 cells thick", std::abs(coarse.energy), 0.02);
  test::check_error("its energy, 16 cells thick", std::abs(fine.energy), 0.02);
  const Widened stiff =
    widen_bore("18",
               "4",
               "Boundary conditions/Penalty of body displacement = 1e4\n");
  test::check("springs that are too stiff: the warning",
              stiff.too_stiff && !coarse.too_stiff && !fine.too_stiff,
              stiff.too_stiff ? "warned of the default" : "not warned");
}

struct Pressed
{
  double force;
  bool   warned;
};

/** A block between smooth walls that is pressed by 1e-6 of its height. */
Pressed
press(const std::string &settings)
{
  const auto block = test::run_scene<2>(
    "Grid/Upper corner = 1, 1.5\nGrid/Subdivisions = 16, 24\n"
    "Material points/Region = y < 1\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
    "Boundary conditions/Surfaces of body = top: y > 0.999\n"
    "Boundary conditions/Displacement of body = top: y=-1e-6*t\n"
    "Material/Young modulus = 1\nOutput/Terminal = quiet\n" +
    settings);
  const auto &warnings = block->all_warnings().all();
  return {
    test::get(*block, "Reaction y on top by boundary points (N)"),
    std::any_of(warnings.begin(), warnings.end(), [](const auto &warning) {
      return warning.subject == "a surface stays behind its displacement";
    })};
}

/** The force of the confined block is its modulus M times the strain, and M/G
 * is 500: with springs that are too soft it is 1/(1 + M/(β G) h) of it. */
void
test_confined()
{
  const std::string rubber = "Formulation/Type = u-p\n"
                             "Material/Poisson ratio = 0.499\n";
  const double      nu = 0.499, G = 0.5 / (1 + nu),
               M   = 2 * G * (1 - nu) / (1 - 2 * nu);
  const auto check = [&](const std::string &what,
                         const double       penalty,
                         const std::string &settings) {
    const Pressed pressed = press(rubber + settings);
    test::check_error("confined rubber, " + what,
                      test::relative(pressed.force,
                                     -1e-6 * M / (1 + M / (penalty * G) / 16)),
                      1e-5);
    test::check("confined rubber, " + what + ": the warning",
                pressed.warned == (penalty < 2e3),
                pressed.warned ? "warned" : "not warned");
  };
  const std::string stiffness =
    "Boundary conditions/Penalty of body displacement = ";
  check("default", 100, "");
  check("stiffer", 2e3, stiffness + "2e3\n");
  check("stiff enough", 1e4, stiffness + "1e4\n");
  const Pressed steel =
    press("Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n");
  test::check("compressible: no warning", !steel.warned, "warned");
  // what a formula makes of zero is no motion to compare with
  const Pressed free =
    press("Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n"
          "Boundary conditions/Displacement = bottom: y=0\n"
          "Boundary conditions/Displacement of body = top: y=-1e-6*t, "
          "x=1e-22*t*x\n");
  test::check("rounding: no warning", !free.warned, "warned");
  // the first instant of an impact is one of inertia, not of springs
  const Pressed hit =
    press(rubber + "Dynamics/Inertia = true\nMaterial/Density = 1\n"
                   "Time/Step size = 1e-3\nTime/End time = 1e-3\n");
  test::check("dynamics: no warning", !hit.warned, "warned");
}

/** Held by its springs alone and loaded: what counts is how far the body goes.
 */
void
test_held()
{
  const auto hang = [](const std::string &penalty) {
    const auto bar = test::run_scene<2>(
      "Grid/Upper corner = 3, 1\nGrid/Subdivisions = 24, 8\n"
      "Material points/Region = x > 0.5 && x < 2.5\nFormulation/Type = u\n"
      "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n"
      "Boundary conditions/Displacement = bottom: y=0\n"
      "Boundary conditions/Surfaces of body = left: x < 0.501; right: x > "
      "2.499\n"
      "Boundary conditions/Displacement of body = left: x=0\n"
      "Boundary conditions/Traction on body = right: 1e-6*t, 0\n"
      "Output/Terminal = quiet\n"
      "Boundary conditions/Penalty of body displacement = " +
      penalty + '\n');
    const auto &warnings = bar->all_warnings().all();
    return std::any_of(warnings.begin(),
                       warnings.end(),
                       [](const auto &warning) {
                         return warning.subject ==
                                "a surface stays behind its displacement";
                       });
  };
  test::check("a bar that hangs from its springs", !hang("100"), "");
  test::check("a bar that hangs from soft springs", hang("1"), "");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_widened_bore();
  test_confined();
  test_held();
}
