/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Hinges: parts of a body's surface that are tied to rigid bodies which turn
// freely. A tie to places holds the rotation.

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::string
    bar    = "Quadrature/Type = CPDI\n"
             "Material points/Region = x>0 && x<1 && y>0 && y<0.25\n"
             "Formulation/Type = u\nMaterial/Young modulus = 1e7\n"
             "Material/Poisson ratio = 0.3\nTime/Step size = 0.1\n"
             "Boundary conditions/Surfaces of body = l: x<1e-6; r: x>0.99999\n",
    grid   = "Grid/Lower corner = -0.25, -0.5\n"
             "Grid/Upper corner = 1.25, 0.75\n"
             "Grid/Subdivisions = 12, 10\n",
    hinged = "Rigid body: pin/Shape = half plane\n"
             "Rigid body: pin/Point = 0, 0.125\n"
             "Rigid body: pin/Normal = 1, 0\n"
             "Rigid body: pin/Free = rotation\n"
             "Rigid body: hook/Shape = half plane\n"
             "Rigid body: hook/Point = 1, 0.125\n"
             "Rigid body: hook/Normal = -1, 0\n"
             "Rigid body: hook/Free = x, rotation\n"
             "Interaction: l - pin/Law = tie\n"
             "Interaction: r - hook/Law = tie\n",
    down   = "Rigid body: hook/Motion = y=-0.3*t\n";

  double
  force(const MaterialPointMethod<2> &problem, const std::string &column)
  {
    return std::abs(test::get(problem, column));
  }

  /** A bar, hinged at both ends, turns as a rigid body: no force is needed.
   * Refined in the middle of its way. */
  void
  test_change_of_grid()
  {
    const std::string scene =
      bar + "Grid/Type = adaptive\n" + grid +
      "Adaptive grid/Minimum level = 0\nAdaptive grid/Maximum level = 1\n"
      "Adaptive grid/Cell size = if(t > 0.25, 0.0625, 0.125)\n"
      "Time/End time = 0.5\n";
    const double turned = force(*test::run_scene<2>(scene + hinged + down),
                                "Force y on r by hook (N)"),
                 clamped =
                   force(*test::run_scene<2>(
                           scene +
                           "Interaction: l - place/Displacement = x=0, y=0\n"
                           "Interaction: r - place/Displacement = y=-0.3*t\n"),
                         "Force y on r by place (N)");
    test::check("a hinge on a grid that changes",
                turned < 1e-6 * clamped,
                test::in_short(turned) + " N, clamped " +
                  test::in_short(clamped));
  }

  /** It is pressed as well, from a checkpoint in the middle. */
  void
  test_restart()
  {
    const std::string scene = bar + grid + hinged +
                              "Rigid body: hook/Free = rotation\n"
                              "Rigid body: hook/Motion = x=-0.05*t, y=-0.3*t\n";
    const auto pressed = [&](const std::string &settings) {
      return force(*test::run_scene<2>(scene + settings),
                   "Force x on r by hook (N)");
    };
    const double whole = pressed("Time/End time = 0.6\n");
    pressed("Time/End time = 0.3\nCheckpoint/Interval = 3\n");
    test::check_error("a hinge after a restart",
                      test::relative(pressed("Time/End time = 0.6\n"
                                             "Checkpoint/Resume = true\n"),
                                     whole),
                      1e-10);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_change_of_grid();
  test_restart();
  return 0;
}
