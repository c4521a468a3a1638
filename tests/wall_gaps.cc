/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// In statics with quadratures that know the surface of the body a one-sided
// wall acts where that is, not where the cells are that hold the body.

#include <array>

#include "seal.h"

using namespace isochor;

const std::string subject = "a wall that acts before the body reaches it";
std::string       quadrature;

template <int dim>
test::ProblemPointer<dim>
run_without_warning(const std::string &what, const std::string &settings)
{
  auto problem = test::run_scene<dim>(quadrature + settings);
  bool warns   = false;
  for (const auto &warning : test::all_warnings(*problem).all())
    warns = warns || warning.subject == subject;
  test::check(what + ": no warning",
              !warns && test::get(*problem, "Share of gaps in contact") < 5e-3,
              std::to_string(test::get(*problem, "Share of gaps in contact")));
  return problem;
}

const std::string reaction = "Reaction y on bottom (N)";

/** The references are those of a mesh of the disc as the grid, which is kept,
 * with 80 edges over the radius. */
void
test_seal()
{
  test::write_disc(40);
  const std::array<std::array<double, 3>, 3> references = {
    {{{0.03, 0.0096495, 0.03}},
     {{0.12, 0.0531865, 0.02}},
     {{0.3, 0.1885326, 0.02}}}};
  for (const auto &[squeeze, reference, tolerance] : references)
    {
      const std::string what =
        "seal, squeezed by " + test::in_short(50 * squeeze) + " %";
      const auto problem = run_without_warning<2>(
        what, test::seal(20, squeeze, "Time/Step size = 0.1\n"));
      test::check_error(what,
                        test::relative(2 * test::get(*problem, reaction),
                                       reference),
                        tolerance);
    }
  // a ball; the mesh has 60 edges over the radius
  const auto ball =
    run_without_warning<2>("ball",
                           test::seal(20,
                                      0.1,
                                      "Formulation/Geometry = axisymmetric\n"
                                      "Material/Poisson ratio = 0.3\n"
                                      "Formulation/Type = u\n"
                                      "Time/Step size = 0.1\n"));
  test::check_error("ball",
                    test::relative(test::get(*ball, reaction), 0.0182456),
                    0.04);
}

/** The force doesn't depend on how the scene is written down. */
void
test_variants()
{
  const auto force = [](const std::string &settings) {
    return test::get(*test::run_scene<2>(quadrature + settings), reaction);
  };
  const double F = force(test::seal(10, 0.12, ""));
  test::check_error(
    "walls along normals",
    test::relative(
      force(test::seal(10,
                       0.12,
                       "Boundary conditions/Displacement = left: x=0\n"
                       "Boundary conditions/Walls = bottom: n >= 0; top: "
                       "n >= 0.12*t\n")),
      F),
    1e-9);
  // a step before the end goes on from a file
  const std::string saves = "Checkpoint/Interval = 2\n";
  force(test::seal(10, 0.12, saves + "Time/End time = 0.5\n"));
  test::check_error(
    "after a restart",
    test::relative(
      force(test::seal(10, 0.12, saves + "Checkpoint/Resume = true\n")), F),
    1e-9);
}

/** A block half a cell above its wall, pressed or under its weight. */
template <int dim>
void
test_block()
{
  const bool        solid = (dim == 3);
  const std::string in    = ", dim " + std::to_string(dim),
                    held =
                      "left: x=0; " + std::string(solid ? "front: z=0; " : "");
  const auto block = [&](const double       bottom,
                         const unsigned int n,
                         const std::string &settings) {
    std::ostringstream scene;
    scene << "Grid/Lower corner = 0, " << bottom << (solid ? ", 0" : "")
          << "\nGrid/Upper corner = 2, 2" << (solid ? ", 1" : "")
          << "\nGrid/Subdivisions = 8, " << n << (solid ? ", 2" : "")
          << "\nMaterial points/Region = x < 1.125 && y > 0.125"
          << (solid ? " && z < 0.75" : "")
          << "\nMaterial points/Points per cell = " << (solid ? 8 : 4)
          << "\nMaterial/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n"
             "Formulation/Type = u\nTime/Step size = 0.25\n"
             "Postprocess/Reactions = bottom\n"
          << settings;
    return scene.str();
  };
  // the other one stands on its wall and is pressed by what is left
  const std::string press =
    "Boundary conditions/Displacement = " + held + "bottom: y>=0; top: y=-";
  const auto above = run_without_warning<dim>(
    "half a cell above" + in,
    block(0., 8, "Grid/Stretch = y: 0->0, 2->-0.5*t\n" + press + "0.5*t\n"));
  const auto on =
    run_without_warning<dim>("on the wall" + in,
                             block(0.125,
                                   15,
                                   "Grid/Stretch = y: 0.125->0, 2->-0.375*t\n" +
                                     press + "0.375*t\n"));
  test::check_error("half a cell above" + in,
                    test::relative(test::get(*above, reaction),
                                   test::get(*on, reaction)),
                    0.02);
}

/** A body that nothing holds at first, between plates that come nearer. */
void
test_free()
{
  // a cell below the upper one
  const std::string settings =
    test::seal(10,
               0.1,
               "Grid/Upper corner = 1.5, 2.1\nGrid/Subdivisions = 15, 21\n"
               "Grid/Stretch = y: 0 -> 0, 2.1 -> -0.2*t\n"
               "Boundary conditions/Displacement = left: x=0; bottom: y>=0; "
               "top: y<=-0.2*t\nTime/Step size = 0.1\n");
  run_without_warning<2>("free", settings + "Time/End time = 0.4\n");
  const double early   = test::largest_in_statistics(reaction);
  const auto   problem = run_without_warning<2>("free, pressed", settings);
  test::check("free, not touched yet",
              std::abs(early) < 1e-10,
              std::to_string(early));
  const double F =
    test::get(*run_without_warning<2>(
                "not free", test::seal(10, 0.1, "Time/Step size = 0.1\n")),
              reaction);
  test::check_error("free, pressed",
                    test::relative(test::get(*problem, reaction), F),
                    0.03);
}

/** In steps that are too large the disc rolls through the wall, which is told
 * of where they can't be cut. */
void
test_passage()
{
  for (const std::string size : {"0.5", "0.1"})
    {
      const auto problem = test::run_scene<2>(
        quadrature + test::seal(20,
                                0.3,
                                "Time/Step size = " + size +
                                  "\nTime/Minimum step size = " + size + "\n"));
      bool told = false;
      for (const auto &warning : test::all_warnings(*problem).all())
        told = told || warning.subject == "a body that went through a wall";
      test::check("through the wall in steps of " + size,
                  told == (size == "0.5"),
                  told ? "told" : "not told");
    }
}

/** A wall that moves into a grid that stays, by almost half of a cell. */
void
test_moving_wall()
{
  const std::string block =
    "Grid/Upper corner = 2, 2\nGrid/Subdivisions = 16, 16\n"
    "Material points/Region = x < 1.125\nMaterial points/Points per cell = 4\n"
    "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n"
    "Formulation/Type = u\nTime/Step size = 0.1\n"
    "Postprocess/Reactions = bottom\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y>=0.05*t; top: "
    "y=0\n";
  const auto stays = run_without_warning<2>("moving wall", block),
             moves =
               run_without_warning<2>("moving wall, grid",
                                      block +
                                        "Grid/Stretch = y: 0->0.05*t, 2->0\n");
  test::check_error("moving wall",
                    test::relative(test::get(*stays, reaction),
                                   test::get(*moves, reaction)),
                    0.07);
}

/** Half of a disc that comes to rest on a wall which it touches with one
 * corner, and yields there: nodes beside it that the first iteration held would
 * pull its surface down, by so much that no step is small enough for a plastic
 * body. The reaction is the weight. */
void
test_plastic()
{
  for (const std::string law :
       {"Material/Model = J2\nMaterial/J2/Yield stress = 0.02\n",
        "Material/Model = Mohr-Coulomb\nMaterial/Mohr-Coulomb/Cohesion = 0.01\n"
        "Material/Mohr-Coulomb/Friction angle = 20\n"})
    {
      const auto problem = test::run_scene<2>(
        quadrature +
        test::seal(8,
                   0.,
                   "Grid/Stretch = \n"
                   "Boundary conditions/Displacement = left: "
                   "x=0; bottom: y>=0\n"
                   "Boundary conditions/Gravity = 0, -0.01*t\n"
                   "Material/Density = 1\n"
                   "Material/Poisson ratio = 0.45\n"
                   "Time/Step size = 0.1\n"
                   "Time/Minimum step size = 0.05\n") +
        law);
      const double weight = 0.01 * test::get(*problem, "Mass (kg)");
      test::check_error("plastic, the reaction is the weight",
                        test::relative(test::get(*problem, reaction), weight),
                        1e-7);
    }
}

/** A ring between plates, incompressible, flattened by 40 %: its crown stays at
 * the plate, where it was held a third of a cell away. */
void
test_ring()
{
  const auto problem = run_without_warning<2>(
    "ring",
    test::seal(15,
               0.8,
               "Material points/Region = x^2 + (y - 1)^2 > 0.36\n"
               "Material/Poisson ratio = 0.5\nTime/Step size = 0.04\n"
               "Postprocess/Reactions = bottom, top\n"
               "Postprocess/Point probes = crown: 0, 1.999\n"));
  test::check_error(
    "ring, the way of the crown",
    test::relative(test::get(*problem, "Displacement y of crown (m)"), -0.8),
    1e-3);
  // pockets of air between the ring and a plate don't count as full
  test::check_error(
    "ring, volume in the grid",
    test::relative(test::get(*problem, "Volume in the grid (m^2)"),
                   test::get(*problem, "Material volume (m^2)")),
    2e-3);
  test::check_error("ring, the forces of both plates",
                    test::relative(test::get(*problem, "Reaction y on top (N)"),
                                   -test::get(*problem, reaction)),
                    1e-6);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const std::string type : {"CPDI", "cell-filled + boundary"})
    {
      quadrature = "Quadrature/Type = " + type + '\n';
      if (test::this_rank() == 0)
        std::cout << type << std::endl;
      test_seal();
      test_variants();
      test_block<2>();
      test_block<3>();
      test_free();
      test_moving_wall();
      if (type == "CPDI")
        test_passage();
      test_plastic();
      test_ring();
    }
}
