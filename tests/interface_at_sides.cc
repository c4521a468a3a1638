/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Two materials whose interface goes through cells (CPDI), and meets a side of
// the grid: periodic sides, where cells of both sides have to decide alike
// (stresses were wrong by up to twice their size), and walls that move, so that
// the body leaves the grid's boundary by a small part of a cell (34 and 180 %).
// Layers one cell thick at walls (110 %), and thin ones at hanging nodes (10
// %). What is exact is linear in each material.

#include <cmath>
#include <sstream>

#include "mesh_file.h"
#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::string common =
    "Quadrature/Type = CPDI\nMaterial 2/Poisson ratio = 0.3\n";

  /** Layers under a load across them, periodic. */
  void
  test_periodic(const std::string &what, const std::string &settings)
  {
    const auto problem = test::run_scene<2>(
      common +
      "Grid/Upper corner = 0.2, 1.25\nGrid/Subdivisions = 4, 25\n"
      "Material points/Region = y < 1\n"
      "Material points/Materials in zones = 2: y > 0.425\n"
      "Material/Young modulus = 1e8\nMaterial/Poisson ratio = 0.3\n"
      "Material 2/Young modulus = 1e6\n"
      "Boundary conditions/Displacement = bottom: x=0, y=0\n"
      "Boundary conditions/Periodic sides = left: right\n"
      "Boundary conditions/Surfaces of body = top: y > 0.9999\n"
      "Boundary conditions/Traction on body = top: 0, -100*t\n"
      "Postprocess/Exact stress = yy: -100*t\n" +
      settings);
    test::check_error("periodic sides, " + what,
                      test::get(*problem, "L2 error of stress yy"),
                      1e-5);
  }

  /** Two materials compressed along their interface by a wall that moves in ten
   * steps: side by side, and one on the other. Stresses of the lower or left
   * material and of the other one, E e/(1 - ν²) in the plane strain e. */
  void
  test_moving_wall(const std::string &what,
                   const double       E_1,
                   const double       E_2,
                   const double       e,
                   const std::string &settings)
  {
    constexpr double   nu = 0.3;
    std::ostringstream scene;
    scene << common
          << "Grid/Upper corner = 0.5, 1.125\nGrid/Subdivisions = 8, 18\n"
             "Material points/Region = y < 1\n"
             "Material points/Materials in zones = 2: y > 0.53125\n"
             "Material/Young modulus = "
          << E_1 << "\nMaterial/Poisson ratio = 0.3\n"
          << "Material 2/Young modulus = " << E_2
          << "\nBoundary conditions/Displacement = bottom: y=0; left: x=0; "
             "right: x="
          << e / 2 << "*t\nTime/Step size = 0.1\n"
          << "Postprocess/Exact stress = xx: if(y < 0.53125, " << E_1 * e
          << ", " << E_2 * e << ")*t/" << 1 - nu * nu << "\n"
          << settings;
    const auto problem = test::run_scene<2>(scene.str());
    test::check_error("wall, " + what,
                      test::get(*problem, "L2 error of stress xx"),
                      1e-3);
  }

  /** A layer that is one cell thick and in the middle of two, on another one,
   * between walls, under a load across them. */
  void
  test_layer_between_walls(const std::string &what, const std::string &settings)
  {
    test::write_image_of_box<2>("layer.msh", {8, 7}, [](const Point<2> &x) {
      return Point<2>(x[0] / 2, x[1] * 0.4375);
    });
    const auto problem = test::run_scene<2>(
      common +
      "Grid/Upper corner = 0.5, 0.625\nGrid/Subdivisions = 4, 5\n"
      "Material points/Body mesh = layer.msh\n"
      "Boundary conditions/Mesh of body surfaces = layer.msh\n"
      "Material points/Materials in zones = 2: y > 0.3125\n"
      "Material/Poisson ratio = 0.3\nFormulation/Type = u\n"
      "Boundary conditions/Displacement = bottom: y=0; left: x=0; right: x=0\n"
      "Boundary conditions/Surfaces of body = top: y > 0.4374\n"
      "Boundary conditions/Traction on body = top: 0, -100*t\n"
      "Postprocess/Exact stress = yy: -100*t\n" +
      settings);
    test::check_error("layer between walls, " + what,
                      test::get(*problem, "L2 error of stress yy"),
                      1e-3);
  }

  /** A soft layer of one and a half coarse, three fine cells of an adaptive
   * grid that is finer in a part of it, at its edges. */
  void
  test_layer_at_hanging_nodes()
  {
    test::write_image_of_box<3>("layers.msh", {4, 8, 4}, [](const Point<3> &x) {
      return Point<3>(x[0] / 4, x[1] / 2, x[2] / 4);
    });
    const auto problem = test::run_scene<3>(
      common +
      "Grid/Type = adaptive\nGrid/Upper corner = 0.25, 0.625, 0.25\n"
      "Grid/Subdivisions = 2, 5, 2\nAdaptive grid/Minimum level = 0\n"
      "Adaptive grid/Maximum level = 1\n"
      "Adaptive grid/Cell size = if(y > 0.2 && x < 0.12, 0.06, 0.13)\n"
      "Material points/Body mesh = layers.msh\n"
      "Material points/Materials in zones = 2: y > 0.3125\n"
      "Material/Young modulus = 1e8\nMaterial/Poisson ratio = 0.3\n"
      "Material 2/Young modulus = 1e6\nFormulation/Type = u\n"
      "Time/Step size = 0.5\n"
      "Boundary conditions/Displacement = bottom: y=0; left: x=0; right: x=0; "
      "front: z=0; back: z=0\n"
      "Boundary conditions/Mesh of body surfaces = layers.msh\n"
      "Boundary conditions/Surfaces of body = top: y > 0.4999\n"
      "Boundary conditions/Traction on body = top: 0, -100*t, 0\n"
      "Postprocess/Exact stress = yy: -100*t\n");
    test::check_error("layer at hanging nodes",
                      test::get(*problem, "L2 error of stress yy"),
                      1e-3);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_periodic("u", "Formulation/Type = u\n");
  test_periodic("u-p",
                "Formulation/Type = u-p\nMaterial 2/Poisson ratio = 0.49\n");
  test_periodic("Q1", "Formulation/Type = u\nGrid/Shape functions = Q1\n");
  for (const std::string form : {"u", "u-p"})
    {
      const std::string settings = "Formulation/Type = " + form + "\n";
      for (const double e : {-2e-4, 2e-4})
        {
          const std::string name =
            (e < 0 ? " below, pushed, " : " below, pulled, ") + form;
          test_moving_wall("soft" + name, 1e6, 1e8, e, settings);
          test_moving_wall("stiff" + name, 1e8, 1e6, e, settings);
        }
    }
  for (const std::string diagonals : {"/", "backslash"})
    {
      const std::string grid = "Grid/Diagonals = " + diagonals + "\n";
      test_layer_between_walls("soft, " + diagonals,
                               "Material/Young modulus = 1e8\n"
                               "Material 2/Young modulus = 1e6\n" +
                                 grid);
      test_layer_between_walls("stiff, " + diagonals,
                               "Material/Young modulus = 1e6\n"
                               "Material 2/Young modulus = 1e8\n" +
                                 grid);
    }
  test_layer_at_hanging_nodes();
  return 0;
}
