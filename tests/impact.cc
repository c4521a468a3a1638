/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// An elastic block that hits a one-sided wall keeps its energy, however small
// the steps are, and its momentum changes by the impulse of the wall.

#include "run_scene.h"

using namespace isochor;

namespace
{
  struct Record
  {
    double energy, momentum, force, time;
  };

  /** A value per step, of the scene run last. */
  std::vector<Record>
  records()
  {
    test::Recorded     &recorded = test::recorded();
    std::vector<Record> all;
    for (unsigned int n = 0; n < recorded.times.size(); ++n)
      all.push_back(
        {recorded.columns["Kinetic energy (J)"].at(n) +
           recorded.columns["Strain energy (J)"].at(n),
         recorded.columns["Momentum y (kg m/s)"].at(n),
         recorded.columns["Force y on body by boundary bottom (N)"].at(n),
         recorded.times[n]});
    return all;
  }
} // namespace

/** A block of 1 m x 0.5 m that flies at 2 m/s towards the bottom, 0.5 m away,
 * with E = 100 Pa: longitudinal waves have 11.6 m/s, and it bounces off after
 * some 0.15 s. No work is done on it. */
void
test_impact(const std::string &what, const std::string &settings)
{
  test::run_scene<2>(
    "Grid/Upper corner = 2, 2\nGrid/Subdivisions = 12, 12\n"
    "Grid/Diagonals = alternating\nFormulation/Type = u\n"
    "Quadrature/Type = CPDI\nMaterial points/Points per cell = 4\n"
    "Material points/Region = x > 0.5 && x < 1.5 && y > 0.5 && y < 1\n"
    "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.3\n"
    "Material/Density = 1\nDynamics/Inertia = true\n"
    "Dynamics/Initial velocity = 0, -2\nTime/End time = 0.4\n"
    "Boundary conditions/Walls = bottom: n >= 0\n" +
    settings);
  const auto all     = records();
  double     impulse = 0;
  for (unsigned int n = 1; n < all.size(); ++n)
    impulse += all[n].force * (all[n].time - all[n - 1].time);
  // during the contact a part of the energy is that of its law
  const double energy   = all.back().energy / all.front().energy - 1,
               momentum = all.back().momentum - all.front().momentum;
  test::check_error(what + ", energy gained", energy, 0.01);
  test::check_error(what + ", energy lost", -energy, 0.025);
  test::check_error(what + ", impulse",
                    test::relative(impulse, momentum),
                    1e-3);
  // it does bounce: off a rigid wall with its velocity, but for vibrations
  test::check(what + ", bounces",
              all.back().momentum > 0.8 * std::abs(all.front().momentum) &&
                all.back().force == 0,
              std::to_string(all.back().momentum));
}

/** A rod between smooth sides that is flush with a wall and flies into it: the
 * force is that of the wave that runs into it, ρ c v A. At t = 0 nothing acts
 * but rounding errors. */
void
test_flush_rod(const std::string &form)
{
  test::run_scene<2>(
    "Grid/Upper corner = 0.2, 2\nGrid/Subdivisions = 4, 40\n"
    "Material points/Region = y < 1\nMaterial/Young modulus = 1e6\n"
    "Material/Density = 1000\nDynamics/Inertia = true\n"
    "Dynamics/Initial velocity = 0, -1\nTime/Step size = 0.002\n"
    "Time/End time = 0.026\nQuadrature/Type = CPDI\n"
    "Boundary conditions/Walls = bottom: n >= 0\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0"
    "\nFormulation/Type = " +
    form + "\n");
  const auto   all     = records();
  const double modulus = 1e6 * 0.7 / (1.3 * 0.4),
               exact   = std::sqrt(1000 * modulus) * 0.2;
  double sum           = 0;
  for (unsigned int n = 3; n < all.size(); ++n)
    sum += all[n].force / (all.size() - 3);
  test::check_error("force on a flush rod, " + form,
                    test::relative(sum, exact),
                    0.04);
}

/** A prescribed motion that begins smoothly gives the body hardly any energy in
 * its first steps: that they don't resolve it is nothing to be told. */
void
test_smooth_start(const std::string &motion)
{
  const auto problem = test::run_scene<2>(
    "Grid/Subdivisions = 8, 8\nMaterial/Young modulus = 1e6\n"
    "Material/Density = 1000\nFormulation/Type = u\n"
    "Dynamics/Inertia = true\nGrid reset/Steps between resets = 0\n"
    "Postprocess/Reactions = bottom\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0, x=0; top: y=" +
    motion + "\nTime/Step size = 0.002\nTime/End time = 0.03\n");
  const std::string told = test::all_warnings(*problem).summary();
  test::check("a smooth start makes no energy, " + motion,
              told.find("energy balance") == std::string::npos,
              told);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test::record_columns({"Kinetic energy (J)",
                        "Strain energy (J)",
                        "Momentum y (kg m/s)",
                        "Force y on body by boundary bottom (N)"});
  test_impact("steps of 2 ms", "Time/Step size = 0.002\n");
  test_impact("steps of 0.5 ms", "Time/Step size = 0.0005\n");
  test_impact("a grid that is kept up to the wall",
              "Grid reset/Steps between resets = 0\n"
              "Time/Step size = 0.001\n");
  test_impact("steps that follow their error",
              "Time/Step size = 0.01\nTime/Tolerated error = 1e-4\n"
              "Time/Minimum step size = 1e-4\n");
  test_smooth_start("-0.01*(1-cos(20*t))");
  test_smooth_start("-0.05*t^2");
  test_flush_rod("u");
  test_flush_rod("u-p"); // did not start in an earlier version
  return 0;
}
