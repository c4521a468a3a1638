/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A surface of one face that is held at its centre is a hinge, and stays one
// where the grid changes; but not the end of a column that is one cell wide and
// stands between walls, which is a plate.

#include "run_scene.h"

using namespace isochor;

/** A bar that is held at one end and moved at the other one, at one face of a
 * cell each, turns as a rigid body: no force is needed. Refined in the middle
 * of its way, so that the faces belong to smaller cells from there on. */
void
test_change_of_grid(const std::string &quadrature)
{
  const auto turn = [&](const std::string &points_per_face) {
    const auto bar = test::run_scene<2>(
      "Grid/Type = adaptive\nGrid/Lower corner = -0.25, -0.5\n"
      "Grid/Upper corner = 1.25, 0.75\nGrid/Subdivisions = 12, 10\n"
      "Adaptive grid/Minimum level = 0\nAdaptive grid/Maximum level = 1\n"
      "Adaptive grid/Cell size = if(t > 0.25, 0.0625, 0.125)\n"
      "Material points/Region = x>0 && x<1 && y>0 && y<0.25\n"
      "Formulation/Type = u\nMaterial/Young modulus = 1e7\n"
      "Material/Poisson ratio = 0.3\nTime/Step size = 0.1\n"
      "Time/End time = 0.5\nBoundary conditions/Surfaces of body = l: x<1e-6 "
      "&& y<0.126; r: x>0.99999 && y<0.126\n"
      "Boundary conditions/Displacement of body = l: x=0,y=0; r: y=-0.3*t\n"
      "Boundary conditions/Boundary points per face = " +
      points_per_face + "\nQuadrature/Type = " + quadrature + '\n');
    return std::abs(test::get(*bar, "Reaction y on r by boundary points (N)"));
  };
  const double hinged = turn("1"), clamped = turn("3");
  test::check("a hinge on a grid that changes, " + quadrature,
              hinged < 1e-6 * clamped,
              std::to_string(hinged) + " N, clamped " +
                std::to_string(clamped));
}

/** The same on a grid that is put back, from a checkpoint in the middle. */
void
test_restart()
{
  const std::string bar =
    "Grid/Lower corner = -0.25, -0.5\nGrid/Upper corner = 1.25, 0.75\n"
    "Grid/Subdivisions = 12, 10\nQuadrature/Type = CPDI\n"
    "Material points/Region = x>0 && x<1 && y>0 && y<0.25\n"
    "Formulation/Type = u\nMaterial/Young modulus = 1e7\n"
    "Material/Poisson ratio = 0.3\nTime/Step size = 0.1\n"
    "Boundary conditions/Surfaces of body = l: x<1e-6 && y<0.126; r: "
    "x>0.99999 && y<0.126\n"
    "Boundary conditions/Displacement of body = l: x=0,y=0; r: x=-0.05*t, "
    "y=-0.3*t\nBoundary conditions/Boundary points per face = 1\n";
  const auto force = [&](const std::string &settings) {
    return test::get(*test::run_scene<2>(bar + settings),
                     "Reaction x on r by boundary points (N)");
  };
  const double whole = force("Time/End time = 0.6\n");
  force("Time/End time = 0.3\nCheckpoint/Interval = 3\n");
  test::check_error("a hinge after a restart",
                    test::relative(force("Time/End time = 0.6\n"
                                         "Checkpoint/Resume = true\n"),
                                   whole),
                    1e-10);
}

/** Poisson's ratio is zero: the strain is the same everywhere. */
template <int dim>
void
test_narrow_column()
{
  const bool        plane  = dim == 2;
  const std::string up     = plane ? "y" : "z";
  const auto        column = test::run_scene<dim>(
    std::string(plane ?
                  "Grid/Upper corner = 0.125, 1.25\nGrid/Subdivisions = 1, 10\n"
                         "Boundary conditions/Displacement = left: x=0; right: x=0; "
                         "bottom: y=0\nPostprocess/Point probes = top: 0.04, 0.97; "
                         "middle: 0.06, 0.5\n" :
                  "Grid/Upper corner = 0.125, 0.125, 1.25\n"
                         "Grid/Subdivisions = 1, 1, 10\n"
                         "Boundary conditions/Displacement = left: x=0; right: x=0; "
                         "bottom: y=0; top: y=0; front: z=0\n"
                         "Postprocess/Point probes = top: 0.04, 0.08, 0.97; middle: "
                         "0.06, 0.06, 0.5\n") +
    "Quadrature/Type = CPDI\nFormulation/Type = u\nMaterial points/Region = " +
    up +
    " < 1\nMaterial/Young modulus = 1\nMaterial/Poisson ratio = 0\n"
           "Boundary conditions/Surfaces of body = plate: " +
    up + " > 0.999\nBoundary conditions/Displacement of body = plate: " + up +
    " = -0.1*t\nBoundary conditions/Boundary points per face = 1\n"
           "Time/Step size = 0.1\n");
  for (const auto &[probe, height] :
       {std::make_pair("top", 0.97), std::make_pair("middle", 0.5)})
    test::check_error(
      std::to_string(dim) + "D, a column of one cell, its " + probe,
      test::relative(test::get(*column,
                               "Displacement " + up + " of " + probe + " (m)"),
                     -0.1 * height),
      1e-5);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const std::string quadrature : {"CPDI", "cell-filled + boundary"})
    test_change_of_grid(quadrature);
  test_restart();
  test_narrow_column<2>();
  test_narrow_column<3>();
}
