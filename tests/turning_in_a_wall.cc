/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A part of a ring that is turned inside of a round wall, which holds it: a
// rigid rotation without stress. Steps along tangents of the wall would take it
// outwards, further in each step on a grid that is put back.

#include <cmath>

#include "mesh_file.h"
#include "run_scene.h"

using namespace isochor;

namespace
{
  constexpr double inner = 0.1, outer = 0.2, turn = 0.3;

  /** Radius and angle of a place, and back. */
  Point<2>
  polar(const double r, const double angle)
  {
    return Point<2>(r * std::cos(angle), r * std::sin(angle));
  }

  /** The largest distance of a point from where the rotation takes it, over the
   * thickness of the ring. */
  double
  largest_error(const MaterialPointMethod<2> &problem)
  {
    const auto &handler = problem.material_points().handler();
    const auto &layout  = problem.material_points().layout();
    double      largest = 0;
    for (const auto &particle : handler)
      {
        const Point<2> x = particle.get_location();
        Point<2>       X = x;
        for (unsigned int a = 0; a < 2; ++a)
          X[a] -= particle.get_properties()[layout.displacement + a];
        const Point<2> place = polar(X.norm(), std::atan2(X[1], X[0]) + turn);
        largest              = std::max(largest, x.distance(place));
      }
    return test::max_over_ranks(largest) / (outer - inner);
  }

  /** That of ten steps, or of more. */
  double
  error_of_ring(const std::string &poisson_ratio,
                const std::string &steps_between_resets,
                const std::string &step_size)
  {
    const std::string grid =
      test::write_image_of_box<2>("ring.msh", {18, 8}, [](const Point<2> &x) {
        // counter-clockwise
        return polar(inner + (outer - inner) * x[1], (1 - x[0]) * M_PI / 2);
      });
    const auto problem = test::run_scene<2>(
      grid +
      "Material points/Region = y > 0.36397*x && y < 1.19175*x\n"
      "Material/Young modulus = 1e6\nMaterial/Poisson ratio = " +
      poisson_ratio +
      "\nBoundary conditions/Displacement = y0: x = x*(cos(0.3*t) - 1) - "
      "y*sin(0.3*t), y = x*sin(0.3*t) + y*(cos(0.3*t) - 1)\n"
      "Boundary conditions/Walls = y1: n = 0\nTime/Step size = " +
      step_size +
      "\nGrid reset/Steps between resets = " + steps_between_resets + "\n");
    return largest_error(*problem);
  }

  /** What a step along the tangent errs, r Δθ²/2, is 0.0009 of the thickness in
   * ten steps; it would be ten times that if it added up. */
  void
  test_ring(const std::string &poisson_ratio,
            const std::string &steps_between_resets)
  {
    const std::string what =
      "nu = " + poisson_ratio + ", resets " + steps_between_resets;
    const double error =
      error_of_ring(poisson_ratio, steps_between_resets, "0.1");
    test::check_error("ring, " + what, error, 2.5e-3);
    const double of_half_steps =
      error_of_ring(poisson_ratio, steps_between_resets, "0.05");
    test::check("... falls with the square of the step",
                of_half_steps < 0.35 * error,
                std::to_string(of_half_steps / error));
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const std::string nu : {"0.3", "0.4999"})
    for (const std::string interval : {"1", "0"})
      test_ring(nu, interval);
  return 0;
}
