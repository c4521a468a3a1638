/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A C that is closed: parts of one body don't come into contact, which is told
// at the latest when the force is wrong, and not before they are near; three
// bodies that are tied do.

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** The arms are 0.4 m apart, the upper one is lowered by @p way. */
  test::ProblemPointer<2>
  close(const double way, const std::string &settings)
  {
    return test::run_scene<2>(
      "Grid/Lower corner = -0.2, -0.2\nGrid/Upper corner = 2.4, 1.2\n"
      "Grid/Subdivisions = 26, 14\nMaterial points/Region = x > 0 && x < 2 && "
      "y > 0 && y < 1 && (x < 0.3 || y < 0.3 || y > 0.7)\n"
      "Quadrature/Type = CPDI\nMaterial/Young modulus = 1000\n"
      "Material/Poisson ratio = 0.3\nBoundary conditions/Surfaces of body = "
      "top: y > 0.9999 && x > 1.7; low: y < 0.0001\n"
      "Interaction: low - place/Displacement = x=0, y=0\n"
      "Interaction: top - place/Displacement = y=-" +
      std::to_string(way) + "*t\nTime/Step size = 0.05\n" + settings);
  }

  bool
  is_told(const MaterialPointMethod<2> &problem)
  {
    return !test::warning_of(problem, "parts of one body in contact").empty();
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession  mpi(argc, argv);
  const std::string kept = "Grid reset/Steps between resets = 0\n",
                    three =
                      "Material points/Bodies = web: x < 0.3; lower: x > 0.3 "
                      "&& y < 0.5; upper: x > 0.3 && y > 0.5\n";
  const auto open = close(0.1, ""), closed = close(0.4, ""),
             passed = close(0.45, kept), apart = close(0.38, three),
             touching = close(0.45, three);
  test::check("arms that are apart", !is_told(*open), "");
  test::check("arms that share nodes", is_told(*closed), "");
  test::check("arms that go through each other", is_told(*passed), "");
  test::check("arms that are bodies",
              !is_told(*apart) && !is_told(*touching),
              "");
  const std::string force = "Force y on lower by upper (N)";
  test::check_error("these don't feel each other before they touch",
                    std::abs(test::get(*apart, force)),
                    1e-9);
  test::check("then they do",
              test::get(*touching, force) < -10,
              std::to_string(test::get(*touching, force)));
  return 0;
}
