/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Dynamics: what energy and momenta do, the acceleration a body starts with,
// and prescribed motions from rest.

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "run_scene.h"

using namespace isochor;

/** Columns of the statistics, a value per step, of the scene run last. */
std::map<std::string, std::vector<double>> &
columns()
{
  return test::recorded().columns;
}

/** One of them, which must be there. */
const std::vector<double> &
column(const std::string &name)
{
  if (columns()[name].empty())
    throw std::runtime_error("no column " + name);
  return columns()[name];
}

/** Kinetic and strain energy after each step; the first entry is the energy at
 * the start, of a body that nothing acts on. */
std::vector<double>
total_energy()
{
  std::vector<double> energy;
  const auto         &kinetic = columns()["Kinetic energy (J)"];
  const auto         &strain  = columns()["Strain energy (J)"];
  energy.push_back(kinetic[0] + strain[0] - columns()["External work (J)"][0] +
                   columns()["Energy lost by the scheme (J)"][0]);
  for (unsigned int i = 0; i < kinetic.size(); ++i)
    energy.push_back(kinetic[i] + strain[i]);
  return energy;
}

/** A free elastic square that turns once in 50 steps. At the start it isn't
 * stretched, so that it breathes, too. */
void
test_spin(const std::string &quadrature, const std::string &formulation)
{
  test::run_scene<2>(
    "Quadrature/Type = " + quadrature + "\nFormulation/Type = " + formulation +
    "\nGrid/Lower corner = -1, -1\nGrid/Upper corner = 1, 1\n"
    "Grid/Subdivisions = 10, 10\nMaterial points/Points per cell = 4\n"
    "Material points/Region = abs(x) < 0.5 && abs(y) < 0.5\n"
    "Material/Young modulus = 1e5\nMaterial/Poisson ratio = 0.3\n"
    "Dynamics/Inertia = true\nDynamics/Initial velocity = -y, x\n"
    "Time/End time = 6.283185307179586\nTime/Step size = 0.12566370614359172\n");
  const auto        energy = total_energy();
  const auto       &L      = columns()["Angular momentum z (kg m^2/s)"];
  const std::string what   = "spin, " + quadrature + ", " + formulation + ", ";
  double            momentum = 0;
  for (unsigned int i = 0; i < L.size(); ++i)
    {
      test::add_error(momentum,
                      std::hypot(columns()["Momentum x (kg m/s)"][i],
                                 columns()["Momentum y (kg m/s)"][i]) /
                        1000);
    }
  test::check_error(what + "energy lost", 1 - energy.back() / energy[0], 0.01);
  test::check_error(what + "energy gained",
                    *std::max_element(energy.begin(), energy.end()) /
                        energy[0] -
                      1,
                    1e-3);
  test::check_error(what + "angular momentum",
                    std::abs(L.back() / L[0] - 1),
                    1e-3);
  test::check_error(what + "momentum", momentum, 1e-12);
}

/** The same, incompressible, three times around by Newmark's scheme: on a grid
 * that is reset in each step or never it keeps its energy. */
void
test_spins(const std::string &resets)
{
  test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid reset/Steps between resets = " + resets +
    "\nGrid/Lower corner = -1, -1\nGrid/Upper corner = 1, 1\n"
    "Grid/Subdivisions = 10, 10\nMaterial points/Points per cell = 4\n"
    "Material points/Region = abs(x) < 0.5 && abs(y) < 0.5\n"
    "Material/Young modulus = 1e5\nMaterial/Poisson ratio = 0.5\n"
    "Dynamics/Inertia = true\nDynamics/Initial velocity = -y, x\n"
    "Dynamics/Scheme = Newmark\n"
    "Time/End time = 18.849555921538759\nTime/Step size = "
    "0.12566370614359172\n");
  const auto energy  = total_energy();
  double     changed = 0;
  // at the start of the first step nothing is known of forces
  for (unsigned int i = 1; i < energy.size(); ++i)
    test::add_error(changed, std::abs(energy[i] / energy[1] - 1));
  test::check_error("three turns, incompressible, resets = " + resets,
                    changed,
                    1e-4);
}

/** A block of an incompressible material in a box with smooth walls cannot
 * move: in each step the bottom carries its weight. In 2D the block ends within
 * cells (in 3D the quadrature of such cells has an error of its own). */
template <int dim>
void
test_box(const std::string &quadrature, const std::string &stabilisation)
{
  const bool in_3D   = (dim == 3);
  const auto problem = test::run_scene<dim>(
    "Quadrature/Type = " + quadrature + "\nGrid/Diagonals = alternating\n" +
    "Formulation/Stabilisation = " + stabilisation + "\nGrid/Subdivisions = " +
    (in_3D ? "2, 3, 2" : "4, 5") + "\nGrid/Upper corner = 1, 1" +
    (in_3D ? ", 1" : "") + "\nMaterial points/Points per cell = 4\n" +
    "Material points/Region = " + (in_3D ? "0.67 - y" : "0.9 - y") +
    "\nMaterial/Young modulus = 1e7\nMaterial/Poisson ratio = 0.5\n"
    "Dynamics/Inertia = true\nBoundary conditions/Gravity = 0, -10" +
    (in_3D ? ", 0" : "") +
    "\nBoundary conditions/Displacement = left: x = 0; right: x = 0; " +
    (in_3D ? "front: z = 0; back: z = 0; " : "") +
    "bottom: y = 0\nPostprocess/Reactions = bottom\n"
    "Time/End time = 0.05\nTime/Step size = 0.01\n");
  double error = 0;
  for (unsigned int i = 0; i < column("Mass (kg)").size(); ++i)
    test::add_error(error,
                    std::abs(column("Reaction y on bottom (N)")[i] /
                               (10 * column("Mass (kg)")[i]) -
                             1));
  const std::string what = "smooth box, " + std::to_string(dim) + "D, " +
                           quadrature + ", " + stabilisation;
  test::check_error(what + ", reaction", error, 1e-8);
  test::check(what + ", no warning",
              test::all_warnings(*problem).all().empty(),
              test::all_warnings(*problem).summary());
}

/** Bodies in free fall, in which the stabilisation must not see a weight: under
 * a gravity that grows, and two of them on ways of their own. */
void
test_free_fall(const std::string &what,
               const std::string &region,
               const std::string &gravity,
               const std::string &velocity)
{
  test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Lower corner = -1, -3\n"
    "Grid/Upper corner = 2, 2\nGrid/Subdivisions = 12, 20\n"
    "Material points/Region = " +
    region +
    "\nMaterial/Young modulus = 1e5\nMaterial/Poisson ratio = 0.5\n"
    "Dynamics/Inertia = true\nDynamics/Initial velocity = " +
    velocity + "\nBoundary conditions/Gravity = 0, " + gravity +
    "\nTime/End time = 0.3\nTime/Step size = 0.05\n");
  double error = 0;
  for (const double strain : column("Strain energy (J)"))
    test::add_error(error,
                    std::abs(strain) / column("Kinetic energy (J)").back());
  test::check_error("free fall, " + what + ", strain energy", error, 1e-9);
}

/** A block on a smooth floor that it may leave: after it has settled, the mean
 * reaction is its weight. */
void
test_resting()
{
  test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Upper corner = 0.6, 0.4\n"
    "Grid/Subdivisions = 9, 6\nMaterial points/Region = x < 0.4 && y < 0.2\n"
    "Material/Young modulus = 1e6\nMaterial/Poisson ratio = 0.3\n"
    "Dynamics/Inertia = true\nBoundary conditions/Gravity = 0, -10\n"
    "Boundary conditions/Walls = bottom: n >= 0\nTime/End time = 0.5\n"
    "Time/Step size = 0.01\n");
  const auto &R   = column("Force y on body by boundary bottom (N)");
  double      sum = 0;
  for (unsigned int i = R.size() / 2; i < R.size(); ++i)
    sum += R[i];
  test::check_error("force of a floor",
                    std::abs(sum / (R.size() - R.size() / 2) /
                               (10 * column("Mass (kg)").back()) -
                             1),
                    0.01);
}

/** Statics in one step: the work of the prescribed displacement u is R u/2. */
void
test_work_of_first_step()
{
  test::run_scene<2>(
    "Grid/Subdivisions = 4, 4\nMaterial/Young modulus = 1e5\n"
    "Boundary conditions/Displacement = bottom: x = 0, y = 0; "
    "top: y = -0.001*t\nPostprocess/Reactions = top\n"
    "Postprocess/Write energies = always\nTime/Step size = 1\n");
  test::check_error("work of the first step",
                    std::abs(column("External work (J)")[0] /
                               (-0.0005 * column("Reaction y on top (N)")[0]) -
                             1),
                    1e-10);
}

/** Metal and soil that never yield do no plastic work, also where the
 * stabilisation stores some; and beside an elastic body that they are tied to
 * (u: in u-p the tie is part of the pressure equation, too). */
void
test_no_plastic_work()
{
  for (
    const std::string material :
    {"Material/Model = J2\nMaterial/J2/Yield stress = 1e12\n",
     "Material/Model = Mohr-Coulomb\nMaterial/Mohr-Coulomb/Cohesion = 1e12\n",
     "Formulation/Type = u\n"
     "Material points/Materials in zones = 2: x < 0.5\n"
     "Material/Model = J2\nMaterial/J2/Yield stress = 1e12\n"
     "Material 2/Young modulus = 3e7\nMaterial 2/Density = 1000\n"})
    {
      test::run_scene<2>(
        "Grid/Subdivisions = 4, 4\nMaterial points/Region = y < 0.76\n"
        "Quadrature/Type = CPDI\nMaterial/Young modulus = 1e7\n"
        "Material/Density = 1000\nBoundary conditions/Gravity = 0, -10*t\n"
        "Boundary conditions/Displacement = bottom: y=0; left: x=0; right: x=0\n"
        "Postprocess/Write energies = always\nTime/Step size = 0.1\n" +
        material);
      test::check_error("no plastic work",
                        std::abs(column("Plastic work (J)").back() /
                                 column("Strain energy (J)").back()),
                        3e-4);
    }
}

/** The external work, step by step: the mean of the reactions in @p name times
 * the @p way of a step. */
void
check_work(const std::string &what, const std::string &name, const double way)
{
  const std::vector<double> work  = column("External work (J)"),
                            force = column(name);
  double sum = 0, worst = 0;
  for (unsigned int n = 0; n < work.size(); ++n)
    {
      sum += (force[n] + (n > 0 ? force[n - 1] : 0.)) / 2 * way;
      worst = std::max(worst, std::abs(work[n] / sum - 1));
    }
  test::check_error(what, worst, 1e-6);
}

/** On a grid that is another one in each step: the work of a boundary that is
 * moved is the mean of its reactions times its way, step by step. */
void
test_work_on_changing_grid()
{
  test::run_scene<2>(
    "Grid/Type = adaptive\nGrid/Upper corner = 2, 1\n"
    "Grid/Subdivisions = 8, 4\nAdaptive grid/Maximum level = 2\n"
    "Adaptive grid/Cell size = 0.05 + abs(x - 0.2 - 0.8*t)*0.5\n"
    "Material points/Region = x < 1\nMaterial/Young modulus = 3e6\n"
    "Cut cells/Extension = never\n" // ties change with the grid (2e-5)
    "Boundary conditions/Displacement = left: x=0; bottom: y=0; "
    "top: y=-0.05*t\nPostprocess/Reactions = top\n"
    "Postprocess/Write energies = always\nTime/Step size = 0.1\n");
  check_work("work on a grid that changes", "Reaction y on top (N)", -0.005);
}

/** The same where the grid is stretched with the boundary that moves, and tied
 * nodes at the body's corners are near to where it was. */
void
test_work_on_stretched_grid()
{
  test::run_scene<2>(
    "Grid/Type = adaptive\nGrid/Lower corner = 0, -0.2\n"
    "Grid/Upper corner = 1, 1.2\nGrid/Subdivisions = 10, 14\n"
    "Grid/Stretch = x: 0 -> 0, 1 -> 0.5*t\nAdaptive grid/Maximum level = 5\n"
    "Adaptive grid/Target number of leaves = 400\n"
    "Material points/Region = y > 0 && y < 1\nQuadrature/Type = CPDI\n"
    "Formulation/Type = u-p\nFormulation/Stabilisation = PPP\n"
    "Material/Young modulus = 1e6\nMaterial/Poisson ratio = 0.3\n"
    "Boundary conditions/Displacement = left: x=0, y=0; right: x=0.5*t, y=0\n"
    "Postprocess/Reactions = right\nPostprocess/Write energies = always\n"
    "Time/Step size = 0.1\n");
  check_work("work on a grid that changes and is stretched",
             "Reaction x on right (N)",
             0.05);
}

/** The smooth box again, without weight, between walls that move by @p u(t)
 * from rest with the acceleration @p a(t): the body moves with them, so that
 * the walls exert its mass times a. */
void
test_walls(const std::string                         &u,
           const std::function<double(const double)> &a,
           const double                               tolerance)
{
  const double dt = 0.01;
  test::run_scene<2>(
    "Grid/Subdivisions = 4, 4\nMaterial points/Points per cell = 4\n"
    "Material/Young modulus = 1e7\nMaterial/Poisson ratio = 0.5\n"
    "Dynamics/Inertia = true\nNewton/Tolerance = 1e-12\n"
    "Boundary conditions/Displacement = left: x = " +
    u + "; right: x = " + u +
    "; bottom: y = 0; top: y = 0\nFormulation/Stabilisation = none\n"
    "Postprocess/Reactions = left, right\n"
    "Grid reset/Steps between resets = 0\n"
    "Time/End time = 0.2\nTime/Step size = 0.01\n");
  const auto &left  = columns()["Reaction x on left (N)"];
  const auto &right = columns()["Reaction x on right (N)"];
  double      error = 0, jump = 0;
  // what the walls give the body at once is an impulse in the first step
  const auto force = [&](const unsigned int i) {
    return (left[i] + right[i]) / 1000;
  };
  for (unsigned int i = 1; i < left.size(); ++i)
    test::add_error(error, std::abs(force(i) - a((i + 1) * dt)));
  for (unsigned int i = 2; i + 1 < left.size(); ++i)
    test::add_error(jump, std::abs(force(i + 1) - 2 * force(i) + force(i - 1)));
  test::check_error("walls move by " + u, error, tolerance);
  test::check_error("walls move by " + u + ", no ringing", jump, 1e-3);
}

/** A beam is let go under gravity and bends through several cells: points that
 * change cells lose energy, about which there is a warning, CPDI and a grid
 * that is kept don't. */
void
test_losses(const std::string &what,
            const std::string &settings,
            const double       least,
            const double       most)
{
  const auto problem = test::run_scene<2>(
    "Grid/Lower corner = 0, -0.8\nGrid/Upper corner = 1.2, 0.4\n"
    "Grid/Subdivisions = 48, 48\nMaterial points/Points per cell = 4\n"
    "Material points/Region = x < 1 && abs(y) < 0.05\n"
    "Material/Young modulus = 1e7\nMaterial/Poisson ratio = 0.49\n"
    "Material/Density = 1000\nDynamics/Inertia = true\n"
    "Boundary conditions/Displacement = left: x = 0, y = 0\n"
    "Boundary conditions/Gravity = 0, -10\n"
    "Time/End time = 0.2\nTime/Step size = 0.005\n" +
    settings);
  double largest = 0;
  for (const double E : total_energy())
    largest = std::max(largest, E);
  const double lost =
    columns()["Energy lost by the scheme (J)"].back() / largest;
  test::check("beam, " + what + ", energy lost",
              lost > least && lost < most,
              std::to_string(lost));
  std::string warning;
  for (const auto &w : test::all_warnings(*problem).all())
    if (w.subject == "energy balance")
      warning = test::one_line(w.text);
  const bool names_remedy =
    warning.find("lost by the scheme") != std::string::npos &&
    warning.find("<Quadrature/Type = CPDI>") != std::string::npos;
  test::check("beam, " + what + ", warning",
              least > 0.01 ? names_remedy : warning.empty(),
              '"' + warning + '"');
}

/** The tutorial's bar of rubber with 16 points per cell swings for 1.05 s, 1.4
 * cycles. In the acceleration that a step starts with, the part of the points'
 * pressures that the nodes of its grid can't have must not act: with it, the
 * bar gains 6 % of its energy, with 9 points per cell of half the size 20
 * times its energy within 1 s. */
void
test_pressures_that_no_node_feels()
{
  const auto problem =
    test::run_scene<2>("Quadrature/Type = CPDI\n"
                       "Grid/Lower corner = 0, -0.5\n"
                       "Grid/Upper corner = 1.1, 0.2\n"
                       "Grid/Subdivisions = 44, 28\n"
                       "Material points/Region = x < 1 && y > 0 && y < 0.1\n"
                       "Material points/Points per cell = 16\n"
                       "Material/Young modulus = 5e6\n"
                       "Material/Poisson ratio = 0.499\n"
                       "Dynamics/Inertia = true\n"
                       "Boundary conditions/Displacement = left: x=0, y=0\n"
                       "Boundary conditions/Gravity = 0, -9.81\n"
                       "Time/End time = 1.05\nTime/Step size = 0.01\n");
  double largest = 0;
  for (const double E : total_energy())
    largest = std::max(largest, E);
  test::check_error("bar of rubber, energy lost or gained",
                    std::abs(column("Energy lost by the scheme (J)").back()) /
                      largest,
                    0.01);
  test::check("bar of rubber, no warning",
              test::all_warnings(*problem).all().empty(),
              test::all_warnings(*problem).summary());
}

/** A rigid mass meets a block and is thrown back: its energy counts. */
void
test_free_rigid_mass()
{
  const auto problem = test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Lower corner = -0.6, 0\n"
    "Grid/Upper corner = 1.6, 1.6\n"
    "Grid/Subdivisions = 22, 16\n"
    "Material points/Region = x > 0 && x < 1 && y < 1\n"
    "Material/Young modulus = 1e5\nMaterial/Poisson ratio = 0.45\n"
    "Material/Density = 100\nDynamics/Inertia = true\n"
    "Boundary conditions/Displacement = bottom: x=0, y=0\n"
    "Rigid body: disc/Shape = circle\n"
    "Rigid body: disc/Centre = 0.6, 1.32\n"
    "Rigid body: disc/Radius = 0.3\n"
    "Rigid body: disc/Free = y, rotation\n"
    "Rigid body: disc/Mass = 100\n"
    "Rigid body: disc/Moment of inertia = 2\n"
    "Rigid body: disc/Initial velocity = y=-1, rotation=2\n"
    "Interaction: body - disc/Law = unilateral\n"
    "Time/End time = 0.16\nTime/Step size = 0.001\n");
  const auto  &of_disc = column("Kinetic energy of rigid bodies (J)");
  const auto  &u       = column("Translation y of rigid body disc (m)");
  const double v       = (u.back() - u[u.size() - 2]) / 0.001;
  test::check_error("rigid mass, its energy",
                    std::abs(of_disc.front() - (100. / 2 + 2. / 2 * 4)) +
                      std::abs(of_disc.back() - (50 * v * v + 4)),
                    1e-3);
  test::check("rigid mass, it is thrown back", v > 0.95, std::to_string(v));
  const double lost = column("Energy lost by the scheme (J)").back() / 54;
  test::check("rigid mass, energy lost",
              lost > -1e-3 && lost < 0.01,
              std::to_string(lost));
  test::check("rigid mass, no warning",
              test::all_warnings(*problem).all().empty(),
              test::all_warnings(*problem).summary());
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test::record_columns({"Kinetic energy (J)",
                        "Strain energy (J)",
                        "Plastic work (J)",
                        "External work (J)",
                        "Energy lost by the scheme (J)",
                        "Momentum x (kg m/s)",
                        "Momentum y (kg m/s)",
                        "Angular momentum z (kg m^2/s)",
                        "Mass (kg)",
                        "Reaction y on top (N)",
                        "Reaction x on left (N)",
                        "Reaction x on right (N)",
                        "Reaction y on bottom (N)",
                        "Force y on body by boundary bottom (N)",
                        "Kinetic energy of rigid bodies (J)",
                        "Translation y of rigid body disc (m)"});
  // warnings are looked at by the tests, they are not part of the output
  std::ostringstream    printed;
  std::streambuf *const terminal = std::cerr.rdbuf(printed.rdbuf());
  for (const std::string resets : {"0", "1"})
    test_spins(resets);
  test_box<2>("points", "none");
  for (const std::string quadrature : {"points", "CPDI"})
    test_box<2>(quadrature, "OSS");
  test_box<3>("CPDI", "OSS");
  const std::string block = "x >= 0 && x <= 1 && y >= 0 && y <= 1";
  test_free_fall("growing gravity", block, "-10*t", "0, 0");
  test_free_fall("two bodies",
                 block + " || x >= -0.75 && x <= -0.25 && y >= -2 && y <= -1.5",
                 "-10",
                 "0, if(x < 0, 1, 0)");
  test_resting();
  test_work_of_first_step();
  test_no_plastic_work();
  test_work_on_changing_grid();
  test_work_on_stretched_grid();
  test_walls(
    "0.1*t", [](const double) { return 0.; }, 1e-6);
  test_walls(
    "t^2/2", [](const double) { return 1.; }, 1e-6);
  // the forces are those of some time within the step
  test_walls(
    "1-cos(t)", [](const double t) { return std::cos(t); }, 0.2 * 0.01);
  for (const std::string quadrature : {"points", "CPDI"})
    test_spin(quadrature, "u");
  test_spin("CPDI", "u-p");
  test_losses("CPDI", "Quadrature/Type = CPDI\n", -0.002, 0.003);
  for (const std::string quadrature : {"points"})
    test_losses("kept grid, " + quadrature,
                "Quadrature/Type = " + quadrature +
                  "\nGrid reset/Steps between resets = 0\n",
                -0.002,
                0.003);
  test_pressures_that_no_node_feels();
  test_free_rigid_mass();
  std::cerr.rdbuf(terminal);
  return 0;
}
