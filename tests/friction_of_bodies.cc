/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Friction between two bodies: a block on a wider one sticks, then slides with
// T = μ N, and what it dissipates is μ N s, whatever the number of steps; two
// blocks under loads that grow together, with places beside the upper one which
// face nothing; a load on a region with a border through the faces' centres.

#include <string>

#include "run_scene.h"

using namespace isochor;

namespace
{
  constexpr double mu = 0.3;

  /** The upper block is pressed down until t = 0.25, and then moved along by
   * 0.3 m. */
  double
  moved(const double t)
  {
    return 0.4 * std::max(0., t - 0.25);
  }

  double
  test_dragged(const unsigned int n_steps)
  {
    test::run_scene<2>(
      "Quadrature/Type = CPDI\nGrid/Lower corner = -0.25, -0.125\n"
      "Grid/Upper corner = 1.75, 0.875\nGrid/Subdivisions = 16, 8\n"
      "Material points/Region = y>0 && y<0.75 && if(y<0.375, x>0 && x<1.5, "
      "x>0.25 && x<0.75)\n"
      "Material points/Bodies = A: y<0.375; B: y>0.375\n"
      "Material/Young modulus = 1000\nMaterial/Poisson ratio = 0.3\n"
      "Boundary conditions/Surfaces of body = bottom: y<0.01; top: y>0.74\n"
      "Interaction: A - B/Law = Coulomb\n"
      "Interaction: A - B/Friction coefficient = 0.3\n"
      "Interaction: bottom - place/Displacement = x=0, y=0\n"
      "Interaction: top - place/Displacement = x=0.4*max(0,t-0.25), "
      "y=-0.001*min(1,4*t)\nNewton/Tolerance = 1e-10\n"
      "Postprocess/Write energies = always\nTime/Step size = " +
      std::to_string(1. / n_steps) + '\n');
    const auto &t              = test::recorded().times;
    const auto &columns        = test::recorded().columns;
    const auto &T              = columns.at("Force x on A by B (N)"),
               &N              = columns.at("Force y on A by B (N)"),
               &pull           = columns.at("Force x on top by place (N)"),
               &energy         = columns.at("Strain energy (J)");
    const std::string what     = " in " + std::to_string(n_steps) + " steps";
    double            sticking = 0, sliding = 0, work = 0, friction = 0;
    unsigned int      first = 0;
    for (unsigned int i = 0; i < t.size(); ++i)
      if (moved(t[i]) < 1e-10)
        sticking = std::max(sticking, std::abs(T[i] / N[i]));
      else if (t[i] > 0.4)
        {
          sliding = std::max(sliding, std::abs(std::abs(T[i] / N[i]) - mu));
          if (first == 0)
            {
              first = i;
              continue;
            }
          const double s = moved(t[i]) - moved(t[i - 1]);
          work += s * (pull[i] + pull[i - 1]) / 2;
          friction -= s * mu * (N[i] + N[i - 1]) / 2;
        }
    test::check("it sticks" + what,
                sticking < mu / 2,
                test::in_short(sticking));
    test::check_error("T/N of a block that slides" + what, sliding / mu, 0.01);
    test::check_error("friction dissipates mu N s" + what,
                      test::relative(work - (energy.back() - energy[first]),
                                     friction),
                      0.01);
    return N.back();
  }

  /** The displacement of a point of the upper block. */
  double
  displacement(const unsigned int n_steps)
  {
    return test::get(
      *test::run_scene<2>(
        "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 1.5\n"
        "Grid/Subdivisions = 32, 24\nGrid/Diagonals = alternating\n"
        "Material points/Region = (x>0.3 && x<1.3 && y>0.25 && y<0.625) || "
        "(x>0.5 && x<1.1 && y>0.625 && y<1.1)\n"
        "Material points/Bodies = A: y<0.625; B: y>0.625\n"
        "Material/Young modulus = 1000\nMaterial/Poisson ratio = 0.4\n"
        "Boundary conditions/Surfaces of body = side: x<0.3126; top: y>1.08\n"
        "Rigid body: plane/Shape = half plane\n"
        "Rigid body: plane/Point = 0, 0.25\n"
        "Rigid body: plane/Normal = 0, 1\n"
        "Interaction: A - plane/Law = Coulomb\n"
        "Interaction: A - plane/Friction coefficient = 0.3\n"
        "Interaction: A - B/Law = Coulomb\n"
        "Interaction: A - B/Friction coefficient = 0.2\n"
        "Interaction: top - load/Pressure = 24*t*(1+0.5*x)\n"
        "Interaction: top - load/Traction = 1.2*t, 0\n"
        "Interaction: side - load/Traction = 3*t, 0\n"
        "Newton/Tolerance = 1e-12\n"
        "Postprocess/Point probes = P: 0.79, 1.03\nTime/Step size = " +
        std::to_string(1. / n_steps) + '\n'),
      "Displacement x of P (m)");
  }

  /** The force on a block that is pressed and dragged over three faces in the
   * given number of steps. */
  double
  force(const unsigned int n_steps)
  {
    return test::get(
      *test::run_scene<2>(
        "Quadrature/Type = CPDI\nGrid/Lower corner = -0.25, -0.125\n"
        "Grid/Upper corner = 2.75, 0.875\nGrid/Subdivisions = 24, 8\n"
        "Material points/Region = y>0 && y<0.75 && if(y<0.375, x>0 && x<1.5, "
        "x>0.25 && x<0.75)\n"
        "Material points/Bodies = A: y<0.375; B: y>0.375\n"
        "Material/Young modulus = 1000\nMaterial/Poisson ratio = 0.3\n"
        "Boundary conditions/Surfaces of body = bottom: y<0.01; top: y>0.74\n"
        "Interaction: A - B/Law = Coulomb\n"
        "Interaction: A - B/Friction coefficient = 0.3\n"
        "Interaction: bottom - place/Displacement = x=0, y=0\n"
        "Interaction: top - place/Displacement = x=0.2*t, y=-0.001*t\n"
        "Time/Step size = " +
        std::to_string(1. / n_steps) + '\n'),
      "Force y on A by B (N)");
  }

  /** The force on a stiff disc that is pressed into a soft block, whose faces
   * meet those of the disc at angles, in @p n_steps steps. */
  double
  force_on_disc(const unsigned int n_steps)
  {
    return test::get(
      *test::run_scene<2>(
        "Quadrature/Type = CPDI\nGrid/Upper corner = 1, 1.5\n"
        "Grid/Subdivisions = 16, 24\n"
        "Material points/Region = y < 0.49999 || x^2+(y-0.9)^2 < 0.16\n"
        "Material points/Bodies = low: y < 0.5; disc: y > 0.5\n"
        "Material points/Materials in zones = 2: y > 0.5\n"
        "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.45\n"
        "Material 2/Young modulus = 1e5\nMaterial 2/Poisson ratio = 0.3\n"
        "Boundary conditions/Displacement = left: x=0; right: x=0; "
        "bottom: y=0\n"
        "Boundary conditions/Surfaces of body = core: x < 0.001 && y > 0.8\n"
        "Interaction: core - place/Displacement = y=-0.2*t\n"
        "Time/Step size = " +
        std::to_string(1. / n_steps) + '\n'),
      "Force y on core by place (N)");
  }

  /** A block that is pushed along; the centres of the faces at its side lie on
   * the border of the region. */
  void
  test_border()
  {
    test::run_scene<2>(
      "Quadrature/Type = CPDI\nGrid/Upper corner = 2.4, 1.8\n"
      "Grid/Subdivisions = 24, 18\n"
      "Material points/Region = x>0.3 && x<1.3 && y>0.3 && y<0.7\n"
      "Material/Young modulus = 1000\nMaterial/Poisson ratio = 0.4\n"
      "Boundary conditions/Surfaces of body = side: x<=0.3; end: x>1.29\n"
      "Interaction: end - place/Displacement = x=0.2*t, y=0.1*t\n"
      "Interaction: side - load/Traction = 5*t, 0\n"
      "Time/Step size = 0.05\n");
    const auto &load  = test::recorded().columns.at("Load x on side (N)");
    double      error = 0;
    for (unsigned int i = 0; i < load.size(); ++i)
      error =
        std::max(error,
                 test::relative(load[i], 5 * test::recorded().times[i] * 0.4));
    test::check_error("load on faces at the border of a region", error, 1e-10);
  }

  /** A block is pressed on a wider one that it meets on its way: a run that is
   * resumed after they have met goes on as if not. In statics so does one that
   * knows a plate far away. */
  void
  test_met(const std::string &name,
           const std::string &settings,
           const double       tolerance)
  {
    const std::string scene =
      "Quadrature/Type = CPDI\nGrid/Lower corner = -0.5, 0\n"
      "Grid/Upper corner = 2, 1.5\n"
      "Grid/Subdivisions = 25, 15\nMaterial points/Region = (x > 0 && x < 1.5 "
      "&& y < 0.6) || (abs(x - 0.8) < 0.25 && y > 0.65 && y < 1)\n"
      "Material/Young modulus = 1e5\nMaterial/Density = 100\n"
      "Boundary conditions/Displacement = bottom: x=0, y=0\n"
      "Boundary conditions/Surfaces of body = top: y > 0.999\n"
      "Interaction: top - place/Displacement = x=0, y=-0.5*t\n"
      "Time/Step size = 0.02\nCheckpoint/Interval = 2\n" +
      settings;
    const auto force = [&](const std::string &others) {
      return test::get(*test::run_scene<2>(scene + others),
                       "Force y on body 1 by body 2 (N)");
    };
    const double whole = force("Time/End time = 0.24\n");
    test::check("blocks meet, " + name, whole < -500, std::to_string(whole));
    force("Time/End time = 0.2\n");
    test::check_error(
      "blocks that have met, resumed, " + name,
      test::relative(force("Time/End time = 0.24\nCheckpoint/Resume = true\n"),
                     whole),
      tolerance);
    if (settings.empty())
      test::check_error(
        "blocks that have met, a plate below them",
        test::relative(
          force("Time/End time = 0.24\nRigid body: plate/Shape = half plane\n"
                "Rigid body: plate/Point = 0, -3\n"
                "Interaction: body 1 - plate/Law = unilateral\n"),
          whole),
        1e-9);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test::record_columns({"Force x on A by B (N)",
                        "Force y on A by B (N)",
                        "Force x on top by place (N)",
                        "Load x on side (N)",
                        "Strain energy (J)"});
  const double N = test_dragged(8);
  test::check_error("pressure in 8 and in 20 steps",
                    test::relative(test_dragged(20), N),
                    0.01);
  test::check_error("loads in 6 and in 12 steps",
                    test::relative(displacement(12), displacement(6)),
                    0.01);
  test::check_error("force in 1 and in 16 steps",
                    test::relative(force(1), force(16)),
                    0.1);
  test::check_error("force on a disc in 50 and in 100 steps",
                    test::relative(force_on_disc(50), force_on_disc(100)),
                    0.005);
  test_border();
  test_met("statics", "", 1e-13);
  test_met("dynamics", "Dynamics/Inertia = true\n", 1e-10);
  return 0;
}
