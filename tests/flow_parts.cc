/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Soil parts before the tip of a smooth wedge that is pushed into it, where
// triangles become needles: their edges collapse, and the mass is kept. The
// force grows in proportion to the depth by the field of slip lines of Hill,
// Lee & Tupper, Proc. R. Soc. A 188 (1947) 273-289: with half the angle β, θ
// from cos(2β - θ) = cos θ/(1 + sin θ) and the length l of contact on a flank,
//   p = 2 c_u (1 + θ),  l (cos β - sin(β - θ)) = depth.

#include <algorithm>
#include <cmath>

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::string force  = "Force y on body by tool (N)",
                    place  = "Translation y of rigid body tool (m)",
                    number = "Number of material points";

  void
  push(const std::string &name, const double volume, const std::string &more)
  {
    test::recorded()   = {};
    const auto problem = test::run_scene<2>(
      "Grid/Lower corner = 0, -2.5\nGrid/Upper corner = 3.5, 1\n"
      "Grid/Subdivisions = 28, 28\n"
      "Material points/Region = y < 0\n"
      "Quadrature/Type = CPDI\n"
      "Material/Model = Mohr-Coulomb\n"
      "Material/Young modulus = 2998\n"
      "Material/Poisson ratio = 0.499\n"
      "Material/Mohr-Coulomb/Cohesion = 1\n"
      "Material/Mohr-Coulomb/Friction angle = 0\n"
      "Material/Mohr-Coulomb/Dilation angle = 0\n"
      "Boundary conditions/Displacement = bottom: x=0, y=0; left: x=0; "
      "right: x=0\n"
      "Rigid body: tool/Apex angle = 60\n"
      "Rigid body: tool/Length = 10\n"
      "Rigid body: tool/Motion = y=-t\n"
      "Interaction: body - tool/Law = unilateral\n"
      "Time/Step size = 0.02\n"
      "Time/End time = 1\n" +
      more);
    test::check_error(name + ", mass",
                      std::abs(
                        test::get(*problem, "Mass (kg)") / (1000 * volume) - 1),
                      1e-12);
    test::check_error(name + ", smallest det F",
                      1 - test::get(*problem, "Smallest J"),
                      0.1);
    test::check_error(name + ", largest det F",
                      test::get(*problem, "Largest J") - 1,
                      0.1);
    const auto &n = test::recorded().columns.at(number);
    test::check(name + ", edges have collapsed",
                !std::is_sorted(n.begin(), n.end()),
                "");
  }

  /** That of the mean line through the second half of the way, as from where
   * flow follows. */
  double
  growth_of_force()
  {
    const auto &F = test::recorded().columns.at(force),
               &y = test::recorded().columns.at(place);
    double n = 0, mean_F = 0, mean_y = 0, F_y = 0, y_y = 0;
    for (unsigned int i = F.size() / 2; i < F.size(); ++i)
      {
        n += 1;
        mean_F += F[i];
        mean_y += y[i];
        F_y += F[i] * y[i];
        y_y += y[i] * y[i];
      }
    return (F_y - mean_F * mean_y / n) / (y_y - mean_y * mean_y / n);
  }

  double
  exact_growth(const double beta)
  {
    double theta = 0;
    for (double change = 1; std::abs(change) > 1e-12;)
      {
        const auto r = [&](const double t) {
          return std::cos(2 * beta - t) - std::cos(t) / (1 + std::sin(t));
        };
        change = -1e-6 * r(theta) / (r(theta + 1e-6) - r(theta));
        theta += change;
      }
    return 2 * (1 + theta) * std::sin(beta) /
           (std::cos(beta) - std::sin(beta - theta));
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test::record_columns({force, place, number});
  push("wedge", 8.75, "Rigid body: tool/Shape = wedge\n");
  test::check_error("wedge, growth of force",
                    std::abs(growth_of_force() / exact_growth(test::pi / 6) -
                             1),
                    0.08);
  return 0;
}
