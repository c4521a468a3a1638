/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A square that its wall, all four sides under one name, presses from all
// around: displacements are linear. A node at a corner has two normals, and the
// distance of each is that from its own side.

#include "mesh_file.h"
#include "run_scene.h"

using namespace isochor;

namespace
{
  constexpr double size = 0.2, way = 0.002;

  std::string
  write_square()
  {
    const StructuredGrid<2> grid({4, 4}, {});
    const auto              vertices =
      grid.vertices([](const Point<2> &x) { return Point<2>(size * x); });
    // diagonals that begin at the corners: no others join two sides
    return test::write_mesh<2>("square.msh",
                               vertices,
                               grid.cells(vertices, "alternating"),
                               {"outer"},
                               [&](const unsigned int v, const unsigned int) {
                                 bool is_outside = false;
                                 for (unsigned int side = 0; side < 4; ++side)
                                   is_outside =
                                     is_outside || grid.on_side(v, side);
                                 return is_outside;
                               });
  }

  void
  test_square(const std::string &steps_between_resets, const std::string &kind)
  {
    const std::string grid    = write_square();
    const auto        problem = test::run_scene<2>(
      grid +
      "Material/Young modulus = 1e6\nMaterial/Poisson ratio = 0.3\n"
             "Formulation/Type = u\nTime/Step size = 0.1\n"
             "Quadrature/Type = CPDI\nBoundary conditions/Walls = outer: n " +
      kind + ' ' + std::to_string(way) +
      "*t\nGrid reset/Steps between resets = " + steps_between_resets + "\n");
    const auto &layout  = problem->material_points().layout();
    double      largest = 0;
    for (const auto &particle : problem->material_points().handler())
      for (unsigned int a = 0; a < 2; ++a)
        {
          const double u = particle.get_properties()[layout.displacement + a],
                       X = particle.get_location()[a] - u;
          largest = std::max(largest, std::abs(u - way * (1 - 2 * X / size)));
        }
    test::check_error("square, n " + kind + ", resets " + steps_between_resets,
                      test::max_over_ranks(largest) / way,
                      1e-8);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_square("0", "=");
  test_square("0", ">=");
  test_square("1", ">=");
  return 0;
}
