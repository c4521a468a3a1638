/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A block is carried through a box, on a grid that stays or on an adaptive one
// that is never refined: each rank has its share of the points at all times.

#include "run_scene.h"

using namespace isochor;

template <int dim>
void
test_balance(const std::string &type, const std::string &box)
{
  // along the last axis: the coarse cells are numbered layer by layer, and with
  // the initial division a rank or two would have all of the points
  const std::string axis = (dim == 2 ? "y" : "z");
  // a quarter of the box is filled, and the block goes from end to end
  const auto problem =
    test::run_scene<dim>(box + "Grid/Type = " + type +
                         "\nAdaptive grid/Maximum level = 0\n"
                         "Material points/Region = " +
                         axis +
                         " < 2\n"
                         "Material/Young modulus = 1000\n"
                         "Dynamics/Inertia = true\n"
                         "Grid reset/Steps between resets = 1\n"
                         "Time/End time = 5.5\nTime/Step size = 0.25\n");
  const std::string name = std::to_string(dim) + "D, " + type + ": ";
  test::check_error(name + "the block is carried",
                    std::abs(
                      test::get(*problem, "Momentum " + axis + " (kg m/s)") /
                        test::get(*problem, "Mass (kg)") -
                      1),
                    1e-9);
  double most = 0; // on one rank a grid that stays has no such column
  if (test::n_ranks() > 1 && test::this_rank() == 0)
    most = test::largest_in_statistics("Imbalance of points");
  most = test::max_over_ranks(most);
  test::check_error(name + "no rank has 10 % more points than the mean",
                    most,
                    0.1);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const std::string type : {"adaptive", "box"})
    {
      test_balance<2>(type,
                      "Grid/Upper corner = 1, 8\nGrid/Subdivisions = 8, 64\n"
                      "Dynamics/Initial velocity = 0, 1\n");
      test_balance<3>(type,
                      "Grid/Upper corner = 1, 1, 8\n"
                      "Grid/Subdivisions = 4, 4, 32\n"
                      "Dynamics/Initial velocity = 0, 0, 1\n");
    }
  return 0;
}
