/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Interactions in dynamics: what bounces keeps its energy however long the
// steps are, forces of pairs add up to nothing, what rests stays, what slides,
// sticks or rolls does it as rigid bodies do, and a tied bar vibrates as a held
// one.

#include "run_scene.h"

using namespace isochor;

namespace
{
  using Column = std::vector<double>;

  const Column &
  column(const std::string &name)
  {
    return test::recorded().columns[name];
  }

  double
  step_size(const unsigned int n)
  {
    const auto &times = test::recorded().times;
    return times[n] - (n > 0 ? times[n - 1] : 0.);
  }

  double
  range(const std::string &name)
  {
    const Column &values = column(name);
    return *std::max_element(values.begin(), values.end()) -
           *std::min_element(values.begin(), values.end());
  }

  /** Kinetic and strain energy, over that of the first step: the largest and
   * the last. */
  std::pair<double, double>
  energies()
  {
    const Column &kinetic = column("Kinetic energy (J)"),
                 &strain  = column("Strain energy (J)");
    std::pair<double, double> result(0., 0.);
    for (unsigned int n = 0; n < kinetic.size(); ++n)
      {
        result.second = (kinetic[n] + strain[n]) / (kinetic[0] + strain[0]);
        result.first  = std::max(result.first, result.second);
      }
    return result;
  }

  /** Of a bounce without loss: what was gained, and lost at the end. */
  void
  check_energy(const std::string &what, const double gain, const double loss)
  {
    const auto [most, last] = energies();
    test::check_error(what + ", energy gained", most - 1, gain);
    test::check_error(what + ", energy lost", 1 - last, loss);
  }

  const std::string floor_at = "Rigid body: floor/Shape = half plane\n"
                               "Rigid body: floor/Normal = 0, 1\n"
                               "Rigid body: floor/Point = 0, ",
                    dynamics = "Quadrature/Type = CPDI\n"
                               "Material points/Points per cell = 4\n"
                               "Dynamics/Inertia = true\n";
} // namespace

/** The block of the test "impact" on a rigid half plane. Its force has to be
 * the rate of the momentum. */
void
test_block(const std::string &form,
           const double       poisson_ratio,
           const std::string &scheme,
           const double       dt,
           const double       gain,
           const double       loss)
{
  test::run_scene<2>(
    dynamics + floor_at +
    "0.2\nInteraction: body - floor/Law = unilateral\n"
    "Grid/Lower corner = 0, -0.5\nGrid/Upper corner = 2, 2\n"
    "Grid/Subdivisions = 12, 15\nGrid/Diagonals = alternating\n"
    "Material points/Region = x > 0.5 && x < 1.5 && y > 0.5 && y < 1\n"
    "Material/Young modulus = 100\nMaterial/Density = 1\n"
    "Material/Poisson ratio = " +
    test::in_short(poisson_ratio) + "\nFormulation/Type = " + form +
    "\nDynamics/Scheme = " + scheme +
    "\nDynamics/Initial velocity = 0, -2\nTime/End time = 0.35\n"
    "Time/Step size = " +
    test::in_short(dt) + "\n");
  const std::string what = "block, " + form + ", " +
                           test::in_short(poisson_ratio) + ", " + scheme +
                           ", " + test::in_short(dt);
  check_energy(what, gain, loss);
  const Column &P = column("Momentum y (kg m/s)"),
               &F = column("Force y on body by floor (N)");
  double impulse  = 0;
  for (unsigned int n = 1; n < P.size(); ++n)
    impulse += F[n] * step_size(n);
  test::check_error(what + ", impulse",
                    std::abs(impulse / (P.back() - P.front()) - 1),
                    scheme == "Newmark" ? 1e-8 : 1e-3);
  test::check(what + ", bounces",
              P.back() > 0 && F.back() == 0,
              std::to_string(P.back()));
}

/** Two blocks that meet: nothing acts from outside. */
void
test_two_blocks(const std::string &form, const std::string &scheme)
{
  test::run_scene<2>(
    dynamics +
    "Grid/Lower corner = -0.5, -1.5\nGrid/Upper corner = 1.5, 1.5\n"
    "Grid/Subdivisions = 12, 18\nGrid/Diagonals = alternating\n"
    "Material points/Region = x > 0 && x < 1 && "
    "((y > 1/6 && y < 2/3) || (y < 0 && y > -0.5))\n"
    "Material points/Bodies = auto\n"
    "Material/Young modulus = 100\nMaterial/Density = 1\n"
    "Material/Poisson ratio = 0.3\nFormulation/Type = " +
    form + "\nDynamics/Scheme = " + scheme +
    "\nDynamics/Initial velocity = 0, if(y>0,-1,1)\nTime/End time = 0.3\n"
    "Time/Step size = 0.0025\n");
  const std::string what = "two blocks, " + form + ", " + scheme;
  check_energy(what, 0.05, 0.06);
  test::check_error(what + ", momentum",
                    std::max(range("Momentum x (kg m/s)"),
                             range("Momentum y (kg m/s)")),
                    1e-9);
  test::check_error(what + ", angular momentum",
                    range("Angular momentum z (kg m^2/s)"),
                    1e-9);
  const Column &F = column("Force y on body 1 by body 2 (N)");
  test::check(what + ", bounce",
              *std::max_element(F.begin(), F.end()) +
                    std::abs(*std::min_element(F.begin(), F.end())) >
                  1 &&
                F.back() == 0,
              std::to_string(F.back()));
}

/** A block that gravity presses on a half plane, then also along it, more and
 * more, up to the slope of an angle of 20 degrees. */
void
test_slope(const double friction, const double acceleration)
{
  const double angle = test::pi / 9;
  test::run_scene<2>(
    dynamics + floor_at +
    "0\nInteraction: body - floor/Law = Coulomb\n"
    "Interaction: body - floor/Friction coefficient = " +
    test::in_short(friction) +
    "\nGrid/Lower corner = -0.5, -0.25\nGrid/Upper corner = 2, 1.5\n"
    "Grid/Subdivisions = 20, 14\n"
    "Material points/Region = x > 0 && x < 1 && y > 0 && y < 0.5\n"
    "Material/Young modulus = 1e7\nMaterial/Density = 1000\n"
    "Material/Poisson ratio = 0.3\nDynamics/Spectral radius = 0.5\n"
    "Boundary conditions/Gravity = "
    "9.81*sin(pi/9)*min(1,max(0,t-0.3)/0.5), -9.81*cos(pi/9)*min(1,t/0.3)\n"
    "Time/Step size = 0.01\nTime/End time = 1.2\n");
  const std::string what  = "slope, friction " + test::in_short(friction);
  const Column     &P     = column("Momentum x (kg m/s)"),
               &Fx        = column("Force x on body by floor (N)"),
               &Fy        = column("Force y on body by floor (N)");
  const double       mass = 500, weight = mass * 9.81 * std::cos(angle);
  const unsigned int last = P.size() - 1, first = last - 30;
  double             time = 0, f_x = 0, f_y = 0;
  for (unsigned int n = first + 1; n <= last; ++n)
    {
      time += step_size(n);
      f_x += Fx[n] * step_size(n);
      f_y += Fy[n] * step_size(n);
    }
  test::check_error(what + ", acceleration",
                    std::abs((P[last] - P[first]) / mass / time - acceleration),
                    1e-3);
  test::check_error(what + ", weight",
                    test::relative(f_y / time, weight),
                    1e-3);
  test::check_error(what + ", friction",
                    std::abs(-f_x / f_y - std::min(friction, std::tan(angle))),
                    1e-3);
}

/** The period of the longitudinal vibration of a bar that is tied at its end to
 * a rigid wall or to places, against 4 L/c. */
void
test_bar(const std::string &what, const std::string &tie)
{
  test::run_scene<2>(
    dynamics + tie +
    "Grid/Lower corner = -0.25, -0.25\nGrid/Upper corner = 1.5, 0.5\n"
    "Grid/Subdivisions = 14, 6\n"
    "Material points/Region = x > 0 && x < 1 && y > 0 && y < 0.25\n"
    "Material/Young modulus = 1e6\nMaterial/Poisson ratio = 0\n"
    "Material/Density = 1000\nFormulation/Type = u\n"
    "Dynamics/Scheme = Newmark\n"
    "Dynamics/Initial velocity = 0.05*sin(pi*x/2), 0\n"
    "Time/Step size = 0.0025\nTime/End time = 0.4\n");
  const Column &P     = column("Momentum x (kg m/s)");
  const auto   &times = test::recorded().times;
  Column        zeros;
  for (unsigned int n = 1; n < P.size(); ++n)
    if (P[n - 1] * P[n] < 0)
      zeros.push_back(times[n] -
                      P[n] * (times[n] - times[n - 1]) / (P[n] - P[n - 1]));
  const double period = 2 * (zeros.back() - zeros.front()) / (zeros.size() - 1);
  test::check_error("bar tied to " + what + ", period",
                    test::relative(period, 4 / std::sqrt(1000.)),
                    2e-3);
  const Column &lost = column("Energy lost by the scheme (J)"),
               &E    = column("Kinetic energy (J)");
  test::check_error("bar tied to " + what + ", energy",
                    std::abs(lost.back() / E.front()),
                    1e-3);
}

/** A body that moves along with its partner from the start feels nothing. */
void
test_carried(const std::string &what, const std::string &partner)
{
  test::run_scene<2>(
    dynamics + partner +
    "Grid/Lower corner = -0.25, -0.25\nGrid/Upper corner = 1.5, 0.5\n"
    "Grid/Subdivisions = 14, 6\n"
    "Material points/Region = x > 0 && x < 1 && y > 0 && y < 0.25\n"
    "Material/Young modulus = 1e6\nMaterial/Poisson ratio = 0.3\n"
    "Material/Density = 1000\nDynamics/Initial velocity = 0.1, 0\n"
    "Time/Step size = 0.005\nTime/End time = 0.02\n");
  test::check_error("carried by " + what + ", momentum",
                    test::relative(column("Momentum x (kg m/s)").back(), 25),
                    1e-8);
  test::check_error("carried by " + what + ", energy",
                    column("Strain energy (J)").back(),
                    1e-8);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test::record_columns({"Kinetic energy (J)",
                        "Strain energy (J)",
                        "Energy lost by the scheme (J)",
                        "Momentum x (kg m/s)",
                        "Momentum y (kg m/s)",
                        "Angular momentum z (kg m^2/s)",
                        "Force x on body by floor (N)",
                        "Force y on body by floor (N)",
                        "Force y on body 1 by body 2 (N)"});
  test_block("u", 0.3, "Newmark", 0.01, 0.1, 0.02);
  test_block("u", 0.3, "Newmark", 0.0025, 0.07, 0.02);
  test_block("u-p", 0.3, "Newmark", 0.0025, 0.02, 0.03);
  // steps that don't resolve waves of pressure: nothing may be gained; contact
  // that begins loses what its pressure does on the way that is left
  test_block("u-p", 0.4999, "Newmark", 0.0025, 1e-8, 0.25);
  test_block("u-p", 0.5, "Newmark", 0.01, 1e-8, 0.06);
  test_block("u-p", 0.499, "Bossak", 0.0025, 1e-8, 0.35);
  test_block("u-p", 0.3, "Bossak", 0.0025, 0.02, 0.05);
  test_two_blocks("u", "Newmark");
  test_two_blocks("u-p", "Bossak");
  test_slope(0.2,
             9.81 * (std::sin(test::pi / 9) - 0.2 * std::cos(test::pi / 9)));
  test_slope(0.36,
             9.81 * (std::sin(test::pi / 9) - 0.36 * std::cos(test::pi / 9)));
  test_slope(0.37, 0);
  const std::string wall = "Rigid body: wall/Shape = half plane\n"
                           "Rigid body: wall/Normal = 1, 0\n",
                    end =
                      "Boundary conditions/Surfaces of body = end: x < 0.001\n"
                      "Interaction: end - ";
  test_bar("a rigid wall", wall + end + "wall/Law = tie\n");
  test_bar("places", end + "place/Displacement = x=0, y=0\n");
  test_carried("places", end + "place/Displacement = x=0.1*t, y=0\n");
  test_carried("a wall",
               wall + "Rigid body: wall/Motion = x=0.1*t\n"
                      "Interaction: body - wall/Law = unilateral\n");
  return 0;
}
