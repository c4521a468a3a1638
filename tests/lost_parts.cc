/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Gaps and thin parts of a region that lie between the points, and so are
// filled or left out: told, on any number of ranks. Surfaces that go through
// cells, and bodies that end between points and the grid's boundary, are not.

#include "scene_messages.h"

using namespace isochor;

namespace
{
  template <int dim>
  void
  test_region(const std::string              &region,
              const unsigned int              n,
              const std::vector<std::string> &words)
  {
    const std::string each = std::to_string(n), three = dim == 2 ? "" : ", ";
    const std::string told = messages<dim>(
      "Grid/Subdivisions = " + each + ", " + each + three +
      (dim == 2 ? "" : each) +
      "\nBoundary conditions/Displacement = bottom: x=0, y=0\n"
      "Dynamics/Inertia = true\n"
      "Boundary conditions/Gravity = 0, -1" +
      (dim == 2 ? "" : ", 0") + "\nMaterial points/Region = " + region + '\n');
    bool ok = words.empty() ==
              (told.find("finer than the points") == std::string::npos);
    for (const std::string &word : words)
      ok = ok && told.find(word) != std::string::npos;
    test::check(region + ", " + each + " cells", ok, told);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession               mpi(argc, argv);
  const std::vector<std::string> filled   = {"Material points/Region",
                                             "does not hold in places of",
                                             "a gap is filled"},
                                 left_out = {"holds in places of",
                                             "a part of the body is left out"};
  const std::vector<std::string> no_message;
  // domains are cut by a gap with corners in it or at it, but not between them
  test_region<2>("y < 0.5 || y > 0.505", 20, no_message);
  test_region<2>("abs(y - x) > 0.0025", 20, no_message);
  test_region<2>("y < 0.51 || y > 0.515", 20, filled);
  test_region<2>("abs(y - x - 0.0125) > 0.0025", 20, filled);
  test_region<2>("y < 0.45 || abs(y - 0.77) < 0.0015", 20, left_out);
  for (const unsigned int n : {8, 21})
    for (const std::string region : {"(x - 0.5)^2 + (y - 0.5)^2 < 0.3^2",
                                     "(x - 0.5)^2 + (y - 0.5)^2 > 0.2^2",
                                     "x^2 + y^2 < 1",
                                     "y < 0.5 + 0.02*x",
                                     "y < 0.3 + 0.1*sin(10*x)",
                                     "y < 0.993",
                                     "y < 0.5 || y > 0.55"})
      test_region<2>(region, n, no_message);
  test_region<3>("y < 0.54 || y > 0.55", 6, filled);
  test_region<3>("x^2 + y^2 + z^2 < 1", 6, no_message);
  test_region<3>("(x - 0.5)^2 + y^2 + z^2 > 0.2", 6, no_message);
  return 0;
}
