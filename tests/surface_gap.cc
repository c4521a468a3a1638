/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The springs that prescribe displacements on a surface of the body: what they
// stay behind by is corrected, so that forces don't depend on their stiffness,
// and on a curved surface that goes through cells they are not too stiff.
// Exact: Lamé's thick cylinder, uniaxial strain, and large homogeneous strain
// of an incompressible block.

#include <algorithm>
#include <cmath>

#include "run_scene.h"

using namespace isochor;

/** A ring of radii 1 m and 2 m in plane strain, in a grid that knows nothing of
 * it, is widened at its bore by 1e-4 m. With u = A r + B/r and no stress
 * outside the pressure inside is 2 G B (1 - 1/4), and the force on the quarter
 * of the bore in a direction is that times 1 m. How stiff the ring is tells its
 * strain energy, too. */
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
  const auto &warnings = test::all_warnings(*ring).all();
  return {
    test::get(*ring, "Reaction x on bore by boundary points (N)") / force - 1,
    test::get(*ring, "Strain energy (J)") / (force * w * test::pi / 4) - 1,
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
                    0.02);
  test::check_error("bore of a ring, 16 cells thick",
                    std::abs(fine.force),
                    0.007);
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

const std::string stiffness =
  "Boundary conditions/Penalty of body displacement = ";

template <int dim>
Pressed
run(const std::string &settings)
{
  const auto block =
    test::run_scene<dim>("Output/Terminal = quiet\n" + settings);
  const auto &warnings = test::all_warnings(*block).all();
  return {
    test::get(*block,
              "Reaction " + std::string(1, "xyz"[dim - 1]) +
                " on top by boundary points (N)"),
    std::any_of(warnings.begin(), warnings.end(), [](const auto &warning) {
      return warning.subject == "a surface stays behind its displacement";
    })};
}

/** A block between smooth walls that is pressed by 1e-6 of its height. */
Pressed
press(const std::string &settings)
{
  return run<2>(
    "Grid/Upper corner = 1, 1.5\nGrid/Subdivisions = 16, 24\n"
    "Material points/Region = y < 1\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
    "Boundary conditions/Surfaces of body = top: y > 0.999\n"
    "Boundary conditions/Displacement of body = top: y=-1e-6*t\n"
    "Material/Young modulus = 1\n" +
    settings);
}

/** The force of the confined block is its modulus M times the strain, and M/G
 * is 500: springs that stay behind would make it 1/(1 + M/(β G) h) of it, from
 * 0.3 of it on. */
void
test_confined()
{
  const std::string rubber = "Formulation/Type = u-p\n"
                             "Material/Poisson ratio = 0.499\n";
  const double      nu = 0.499, G = 0.5 / (1 + nu),
               M = 2 * G * (1 - nu) / (1 - 2 * nu);
  for (const std::string penalty : {"auto", "1", "100", "1e4"})
    {
      const Pressed pressed = press(rubber + stiffness + penalty + '\n');
      test::check_error("confined rubber, " + penalty,
                        test::relative(pressed.force, -1e-6 * M),
                        2e-4);
      test::check("confined rubber, " + penalty + ": no warning",
                  !pressed.warned,
                  "warned");
    }
  // what a formula makes of zero is no motion to compare with
  const Pressed free =
    press("Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n"
          "Boundary conditions/Displacement = bottom: y=0\n"
          "Boundary conditions/Displacement of body = top: y=-1e-6*t, "
          "x=1e-22*t*x\n");
  test::check("rounding: no warning", !free.warned, "warned");
  // nor is what second order leaves of a motion in another direction
  const Pressed sheared = run<2>(
    "Grid/Upper corner = 1.25, 1.25\nGrid/Lower corner = -0.25, -0.25\n"
    "Grid/Subdivisions = 12, 12\nQuadrature/Type = CPDI\n"
    "Material points/Region = x > 0 && x < 1 && y > 0 && y < 1\n"
    "Boundary conditions/Surfaces of body = top: x < 0.001 || x > 0.999 || y < "
    "0.001 || y > 0.999\n"
    "Boundary conditions/Displacement of body = top: x=0.01*t*y, y=0\n"
    "Material/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n"
    "Formulation/Type = u-p\nTime/Step size = 0.1\n");
  test::check("sheared on all sides: no warning", !sheared.warned, "warned");
  // the first instant of an impact is one of inertia, not of springs
  const Pressed hit =
    press(rubber + "Dynamics/Inertia = true\nMaterial/Density = 1\n"
                   "Time/Step size = 1e-3\nTime/End time = 1e-3\n");
  test::check("dynamics: no warning", !hit.warned, "warned");
}

/** An incompressible block between smooth surfaces that is pressed to 0.8 of
 * its height and let go to 0.9, with steps of different size: the force per
 * undeformed area is G (λ - λ^-3) in the plane, G (λ - λ^-2) in space. */
template <int dim>
void
test_large_strain()
{
  const bool        plane = dim == 2;
  const std::string common =
    plane ? "Grid/Upper corner = 1.5, 1\n"
            "Grid/Subdivisions = 12, 8\n"
            "Material points/Region = x < 1\n"
            "Boundary conditions/Displacement = left: x=0; "
            "bottom: y=0\n"
            "Boundary conditions/Surfaces of body = top: "
            "y > 0.999\n"
            "Boundary conditions/Displacement of body = top: "
            "y=-0.2*min(t, 1.5-0.5*t)\n" :
            "Grid/Upper corner = 1.5, 1.5, 1\n"
            "Grid/Subdivisions = 6, 6, 4\n"
            "Material points/Region = x < 1 && y < 1\n"
            "Boundary conditions/Displacement = left: x=0; "
            "bottom: y=0; front: z=0\n"
            "Boundary conditions/Surfaces of body = top: "
            "z > 0.999\n"
            "Boundary conditions/Displacement of body = top: "
            "z=-0.2*min(t, 1.5-0.5*t)\n";
  const std::string rubber =
    "Quadrature/Type = CPDI\n"
    "Formulation/Type = u-p\nMaterial/Young modulus = 3\n"
    "Material/Poisson ratio = 0.5\nTime/Step size = 0.1\n"
    "Time/Output interval = 0.25\n";
  for (const double end : {1., 2.})
    {
      const double lambda  = end == 1 ? 0.8 : 0.9;
      const double exact   = lambda - std::pow(lambda, plane ? -3 : -2);
      const auto   pressed = run<dim>(
        common + rubber + "Time/End time = " + std::to_string(end) + '\n');
      test::check_error("a block pressed to " + std::to_string(lambda),
                        test::relative(pressed.force, exact),
                        1e-3);
    }
}

/** Held by its springs alone and loaded: they stretch, and the body doesn't
 * follow. */
void
test_held()
{
  for (const std::string penalty : {"auto", "1"})
    {
      const auto bar = test::run_scene<2>(
        "Grid/Upper corner = 3, 1\nGrid/Subdivisions = 24, 8\n"
        "Material points/Region = x > 0.5 && x < 2.5\nFormulation/Type = u\n"
        "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n"
        "Boundary conditions/Displacement = bottom: y=0\n"
        "Boundary conditions/Surfaces of body = left: x < 0.501; right: x > "
        "2.499\n"
        "Boundary conditions/Displacement of body = left: x=0\n"
        "Boundary conditions/Traction on body = right: 1e-6*t, 0\n"
        "Postprocess/Point probes = P: 2.4999, 0.5\n"
        "Output/Terminal = quiet\n" +
        stiffness + penalty + '\n');
      test::check_error(
        "a bar that hangs from its springs, " + penalty,
        test::relative(test::get(*bar, "Displacement x of P (m)"), 2e-6 * 0.91),
        4e-4);
    }
}

/** Nodes that are held elsewhere don't let the surface go where it should: the
 * springs act as they are, and the warning says so. */
void
test_contradiction()
{
  const Pressed held = run<2>(
    "Grid/Subdivisions = 4, 4\nMaterial/Young modulus = 1\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0; top: y=0\n"
    "Boundary conditions/Surfaces of body = top: top\n"
    "Boundary conditions/Displacement of body = top: y=-1e-6*t\n"
    "Time/Step size = 0.25\nMaterial/Poisson ratio = 0.25\n"
    "Formulation/Type = u\n");
  test::check("a surface that is held elsewhere: the warning",
              held.warned,
              "not warned");
  // β G/h times area and gap
  test::check_error("a surface that is held elsewhere: the force",
                    test::relative(held.force, -10 * 0.4 * 4 * 1e-6),
                    1e-6);
}

/** Springs can't be too stiff for displacements that are rounding, as those of
 * a surface that is held until t = 1, nor for such as meet no resistance: their
 * work is none. */
void
test_no_work()
{
  const std::string block =
    "Output/Terminal = quiet\nGrid/Upper corner = 3, 1.5\n"
    "Grid/Subdivisions = 24, 12\nMaterial/Poisson ratio = 0.3\n"
    "Boundary conditions/Surfaces of body = top: y > 0.99\n"
    "Boundary conditions/Gravity = 0, -10\n";
  for (const std::string motion :
       {"Material points/Region = x < 1 && y < 1\nTime/Step size = 0.05\n"
        "Time/End time = 1.2\nBoundary conditions/Displacement = left: x=0; "
        "bottom: y=0\n"
        "Boundary conditions/Displacement of body = top: y=-0.1*max(t-1,0)\n",
        "Material points/Region = x > 0.25 && x < 1.25 && y < 1\n"
        "Boundary conditions/Displacement = bottom: y=0\nTime/Step size = 0.1\n"
        "Boundary conditions/Displacement of body = top: x=0.5*t\n"})
    {
      const auto  problem = test::run_scene<2>(block + motion);
      std::string subjects;
      for (const auto &warning : test::all_warnings(*problem).all())
        if (warning.subject == "springs that are too stiff for a surface")
          subjects += warning.text;
      test::check("displacements without work", subjects.empty(), subjects);
    }
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_widened_bore();
  test_confined();
  test_large_strain<2>();
  test_large_strain<3>();
  test_held();
  test_contradiction();
  test_no_work();
}
