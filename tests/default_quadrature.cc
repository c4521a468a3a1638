/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What the default of <Quadrature/Type>, CPDI, has to be safe for: slivers,
// corners of the body that touch several nodes alone, mass matrices that are
// singular, surfaces that are moved suddenly.

#include <fstream>
#include <functional>
#include <map>

#include "run_scene.h"

using namespace isochor;

/** Columns of the statistics, a value per step, of the scene run last. */
std::map<std::string, std::vector<double>> &
columns()
{
  return test::recorded().columns;
}

const std::string cpdi = "Quadrature/Type = CPDI\n";

std::string
subjects(const MaterialPointMethod<2> &problem)
{
  std::string text;
  for (const auto &warning : test::all_warnings(problem).all())
    text += warning.subject + "; ";
  return text;
}

/** A square whose top stands above a line of the grid by less than a millionth
 * of a cell is the square that ends there. */
void
test_slivers()
{
  double exact = 0;
  for (const double d : {0., 1e-9, 1e-7, 1e-5})
    {
      std::ostringstream height;
      height.precision(15);
      height << 2 * (1 - d); // four cells are 1 - d high
      const auto problem = test::run_scene<2>(
        cpdi + "Formulation/Type = u\nGrid/Upper corner = 2, " + height.str() +
        "\nGrid/Subdivisions = 8, 8\nMaterial points/Body mesh = " SOURCE_DIR
        "/square.msh\nMaterial points/Points per cell = 4\n"
        "Boundary conditions/Displacement = bottom: x = 0, y = 0\n"
        "Boundary conditions/Gravity = 0, -10\n"
        "Postprocess/Point probes = P: 0.4, 0.9\n");
      const double u = columns()["Displacement y of P (m)"].back();
      if (d == 0)
        exact = u;
      std::ostringstream what;
      what << "sliver of " << d;
      test::check_error(what.str(), std::abs(u / exact - 1), 1e-6 + 5 * d);
      test::check(what.str() + ", no warning",
                  test::all_warnings(*problem).all().empty(),
                  subjects(*problem));
    }
}

/** The tip of a diamond lies in a cell two of whose nodes nothing else touches,
 * though a sixth of what they could have: the mean of both is all that counts.
 */
void
test_tip()
{
  std::ofstream("diamond.msh")
    << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 -1 0\n2 1 0 0\n"
       "3 0 1 0\n4 -1 0 0\n5 0 0 0\n$EndNodes\n$Elements\n4\n"
       "1 2 2 1 1 1 2 5\n2 2 2 1 1 2 3 5\n3 2 2 1 1 3 4 5\n4 2 2 1 1 4 1 5\n"
       "$EndElements\n";
  for (const std::string formulation : {"u", "u-p"})
    try
      {
        const auto problem = test::run_scene<2>(
          cpdi + "Formulation/Type = " + formulation +
          "\nGrid/Lower corner = -2.2, -1.25\nGrid/Upper corner = 1.8, 1.75\n"
          "Grid/Subdivisions = 8, 6\nMaterial points/Body mesh = diamond.msh\n"
          "Material points/Points per cell = 4\n"
          "Boundary conditions/Surfaces of body = foot: y < 0\n"
          "Interaction: foot - place/Displacement = x = 0, y = 0\n"
          "Boundary conditions/Gravity = 0, -10\n"
          "Postprocess/Point probes = P: 0, 0.5\n");
        const double n = columns()["Tied nodes"].back();
        test::check("tip of a diamond, " + formulation,
                    n >= 2,
                    std::to_string(n) + " nodes tied");
      }
    catch (const std::exception &exc)
      {
        test::check("tip of a diamond, " + formulation, false, exc.what());
      }
}

/** A free block without load, seeded so that some nodes are touched by one
 * domain only, moves on as it is. */
void
test_free_flight()
{
  test::run_scene<2>(
    cpdi + "Grid/Upper corner = 6, 6\nGrid/Subdivisions = 6, 6\n"
           "Material points/Points per cell = 4\nFormulation/Type = u\n"
           "Material points/Region = x>1.704&&x<3.504&&y>1.76&&y<3.24\n"
           "Material/Young modulus = 1e5\nDynamics/Inertia = true\n"
           "Dynamics/Initial velocity = 0.01, 0\n"
           "Time/Step size = 0.01\nTime/End time = 0.1\n");
  const auto &momentum = columns()["Momentum x (kg m/s)"];
  const auto &energy   = columns()["Kinetic energy (J)"];
  double      error    = 0;
  for (unsigned int i = 0; i < momentum.size(); ++i)
    {
      test::add_error(error, std::abs(momentum[i] / momentum[0] - 1));
      test::add_error(error, std::abs(energy[i] / energy[0] - 1));
    }
  test::check("free flight, steps",
              momentum.size() == 10,
              std::to_string(momentum.size()));
  test::check_error("free flight", error, 1e-9);
}

/** In a rigid translation nothing does work, ties included. */
void
test_rigid_motion()
{
  const auto problem = test::run_scene<2>(
    cpdi + "Formulation/Type = u\nGrid/Lower corner = -0.5, -0.5\n"
           "Grid/Upper corner = 1.5, 1.5\nGrid/Subdivisions = 8, 8\n"
           "Material points/Points per cell = 4\n"
           "Material points/Region = x>0 && x<1&& y<0.5 && y>0\n"
           "Interaction: body - place/Displacement = x=0.001*t, y=0.001*t\n"
           "Time/Step size = 0.5\n");
  double share = 0;
  for (const double s : columns()["Share of ties in internal work"])
    test::add_error(share, s);
  test::check_error("work of ties in a rigid motion", share, 0.01);
  test::check("rigid motion, no warning",
              test::all_warnings(*problem).all().empty(),
              subjects(*problem));
}

/** A stiff block is moved by its surface. The impulse of the start acts at
 * once; what comes later is its mass times the acceleration of the motion. */
void
test_moved_surface(const std::string                         &u,
                   const std::function<double(const double)> &a,
                   const double                               tolerance)
{
  constexpr double mass = 250, dt = 0.005;
  test::run_scene<2>(cpdi +
                     "Formulation/Type = u\nGrid/Lower corner = -1, -1\n"
                     "Grid/Upper corner = 1, 1\nGrid/Subdivisions = 16, 16\n"
                     "Material points/Points per cell = 4\n"
                     "Material points/Region = abs(x)<0.25 && abs(y)<0.25\n"
                     "Material/Young modulus = 1e10\nDynamics/Inertia = true\n"
                     "Interaction: body - place/Displacement = x=0, y=" +
                     u + "\nTime/End time = 0.05\nTime/Step size = 0.005\n");
  const auto &force = columns()["Force y on body by place (N)"];
  double      error = 0;
  for (unsigned int i = 0; i < force.size(); ++i)
    test::add_error(error,
                    std::abs(std::abs(force[i]) -
                             std::abs(mass * a((i + 0.5) * dt))));
  test::check_error("surface moved by " + u, error, tolerance);
}

/** A bar is drawn through the grid. With four points per cell domains are half
 * as long as their cells at first; from a stretch of 2.4 on nodes between their
 * corners feel nothing. With one they have fewer corners than there are nodes,
 * once the bar has moved. */
void
test_long_domains()
{
  const auto warns = [](const std::string &stretch,
                        const std::string &points,
                        const std::string &settings = "") {
    const auto problem = test::run_scene<2>(
      "Quadrature/Type = CPDI\nFormulation/Type = u\n"
      "Grid/Upper corner = 3.2, 0.4\nGrid/Subdivisions = 16, 2\n"
      "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n"
      "Material points/Region = x < 1\nMaterial points/Points per cell = " +
      points +
      "\nBoundary conditions/Displacement = left: x=0; bottom: y=0; top: y=0\n"
      "Boundary conditions/Surfaces of body = end: x > 0.9999\n"
      "Interaction: end - place/Displacement = x = (" +
      stretch + " - 1)*t\nTime/Step size = 0.1\n" + settings);
    for (const auto &warning : test::all_warnings(*problem).all())
      if (warning.subject == "domains longer than the cells")
        return true;
    return false;
  };
  test::check("domains as long as cells are not warned of",
              !warns("2.3", "4"),
              "");
  test::check("longer ones are", warns("3", "4"), "");
  test::check("nor those of more points", !warns("3", "9"), "");
  // it rests in the second step, in which displacements are arbitrary
  test::check("one point per cell is",
              warns("1 + 0.015/max(t, 0.1)", "1", "Time/End time = 0.2\n"),
              "");
  test::check("not on a grid that is kept",
              !warns("1.05", "1", "Grid reset/Steps between resets = 0\n"),
              "");
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test::record_columns({"Displacement y of P (m)",
                        "Momentum x (kg m/s)",
                        "Kinetic energy (J)",
                        "Share of ties in internal work",
                        "Tied nodes",
                        "Force y on body by place (N)"});
  test_slivers();
  test_tip();
  test_free_flight();
  test_rigid_motion();
  // the impulse is 250 N s, 50 kN in a step
  test_moved_surface(
    "t", [](const double) { return 0.; }, 250);
  test_moved_surface(
    "5*t^2", [](const double) { return 10.; }, 50);
  test_long_domains();
  return 0;
}
