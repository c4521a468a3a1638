/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A body that would go through a one-sided wall within a step doesn't: the step
// is cut, until the wall acts. Before, the force was zero, and nothing said so.

#include <array>
#include <fstream>

#include "run_scene.h"

using namespace isochor;

namespace
{
  constexpr double E = 1000;

  /** The axial stress on the cross-section at t = 0, if the sides are held and
   * Poisson's ratio is 0: dW/dλ with K = E/3, G = E/2. */
  double
  nominal_stress(const double stretch)
  {
    return E / 3 *
           (stretch - 1 + std::cbrt(stretch) - std::pow(stretch, -5. / 3));
  }

  const std::string reaction = "Reaction y on bottom (N)";

  /** A column of 0.4 x 0.8 m (x 0.2 m) between smooth sides, 0.3 m above the
   * ground, in cells of 0.1 m. */
  template <int dim>
  std::string
  column(const std::string &lower, const std::string &settings)
  {
    const bool        solid = (dim == 3);
    const std::string held =
      "Boundary conditions/Displacement = left: x=0; "
      "right: x=0; " +
      std::string(solid ? "front: z=0; back: z=0; " : "");
    return std::string("Grid/Lower corner = 0, ") + lower +
           (solid ? ", 0\nGrid/Upper corner = 0.4, 1.1, 0.2\n"
                    "Grid/Subdivisions = 4, " :
                    "\nGrid/Upper corner = 0.4, 1.1\nGrid/Subdivisions = 4, ") +
           std::to_string(
             static_cast<int>(std::lround((1.1 - std::stod(lower)) / 0.1))) +
           (solid ? ", 2\n" : "\n") +
           "Material points/Region = y > 0.3\n"
           "Material points/Points per cell = " +
           (solid ? "8" : "4") +
           "\nMaterial/Young modulus = " + std::to_string(E) +
           "\nMaterial/Poisson ratio = 0\nMaterial/Density = 1\n"
           "Formulation/Type = u\nPostprocess/Reactions = bottom\n" +
           held + settings;
  }

  const std::string cpdi = "Quadrature/Type = CPDI\n",
                    kept = "Grid reset/Steps between resets = 0\n";

  /** Loads on the lower face would lengthen the column by half if nothing was
   * there; at the ground it is longer by 0.3 m. */
  template <int dim>
  void
  test_lengthened(const std::string &what,
                  const double       width,
                  const std::string &ground,
                  const std::string &settings,
                  const double       tolerance)
  {
    const double       load = nominal_stress(1.5);
    std::ostringstream traction;
    traction << "Boundary conditions/Surfaces of body = end: y < 0.301\n"
             << "Boundary conditions/Traction on body = end: 0, -" << load
             << "*t" << (dim == 3 ? ", 0" : "") << "\n";
    const auto problem = test::run_scene<dim>(
      column<dim>("0",
                  "top: y=0; " + ground + "\n" + traction.str() + settings));
    test::check_error(what,
                      test::relative(test::get(*problem, reaction),
                                     (load - nominal_stress(1.375)) * width),
                      tolerance);
  }

  /** The column is let down by 0.4 m, and pressed together by 0.1 m. */
  void
  test_let_down(const std::string &what,
                const std::string &settings,
                const double       tolerance)
  {
    const auto problem = test::run_scene<2>(column<2>(
      "0",
      "top: y=-0.4*t; bottom: y>=0\nGrid/Stretch = y: 0 -> 0, 1.1 -> -0.4*t\n" +
        settings));
    test::check_error(what,
                      test::relative(test::get(*problem, reaction),
                                     -nominal_stress(0.875) * 0.4),
                      tolerance);
  }

  /** What the run ends with. */
  template <int dim>
  std::string
  error_of(const std::string &settings)
  {
    try
      {
        test::run_scene<dim>(settings);
      }
    catch (const std::exception &exc)
      {
        return test::one_line(exc.what());
      }
    return "";
  }

  /** Where nobody looks for contact the run ends with an error, not without a
   * force. */
  void
  test_kept()
  {
    const std::string error =
      error_of<2>(column<2>("0",
                            "top: y=-0.4*t; bottom: y>=0\n"
                            "Grid/Stretch = y: 0 -> 0, 1.1 -> -0.4*t\n" +
                              kept + cpdi));
    test::check("a grid that is stretched and kept ends with an error",
                error.find("goes through the one-sided wall <bottom>") !=
                  std::string::npos,
                error);
  }

  /** A wall that stands in the grid is told of, and doesn't let a body through
   * in silence; at the grid's boundary it acts. */
  void
  test_inside()
  {
    const std::string load = "Boundary conditions/Gravity = 0, -1600*t\n" +
                             cpdi + "Time/Step size = 0.1\n",
                      inside =
                        column<2>("-0.2", "top: y=0; bottom: y>=0.2\n" + load);
    const std::string error = error_of<2>(inside);
    test::check("a wall inside of the grid ends with an error",
                error.find("stands 0.2 m, 2 cells, inside of the grid") !=
                  std::string::npos,
                error);
    const auto before = test::run_scene<2>(inside + "Time/End time = 0.2\n");
    bool       told = false, pushes = false;
    for (const auto &warning : test::all_warnings(*before).all())
      {
        told =
          told || (warning.subject == "a wall inside of the grid" &&
                   warning.text.find("0.2 m, 2 cells") != std::string::npos);
        pushes =
          pushes || warning.subject == "a boundary that leaves the body behind";
      }
    test::check("it is told of at the start, and not said to push",
                told && !pushes,
                test::all_warnings(*before).summary());
    const auto problem =
      test::run_scene<2>(column<2>("0", "top: y=0; bottom: y>=0\n" + load));
    told = false;
    for (const auto &warning : test::all_warnings(*problem).all())
      told = told || warning.subject == "a wall inside of the grid";
    test::check("not one at the boundary of the grid",
                !told && test::get(*problem, reaction) > 0,
                test::all_warnings(*problem).summary());
  }

  /** A column that falls has the ground in its way, however large the step. */
  void
  test_fall()
  {
    const std::string scene =
      column<2>("0",
                "bottom: y>=0\nDynamics/Inertia = true\n"
                "Boundary conditions/Gravity = 0, -1000*t\n"
                "Time/End time = 0.2\nTime/Step size = 0.2\n" +
                  cpdi);
    const auto problem = test::run_scene<2>(scene);
    test::check("a column that falls meets the ground",
                test::recorded().times.size() > 1 &&
                  test::get(*problem, reaction) > 0,
                std::to_string(test::recorded().times.size()) + " steps, " +
                  std::to_string(test::get(*problem, reaction)) + " N");
  }

  /** The subjects of the warnings that a run has given. */
  template <int dim>
  std::string
  subjects(const MaterialPointMethod<dim> &problem)
  {
    std::string all;
    for (const auto &warning : test::all_warnings(problem).all())
      all += warning.subject + "; ";
    return all;
  }

  /** A block falls by 0.9 m in steps that are as long as it takes it to hit the
   * ground and leave again. Each step of another size would let it bounce with
   * more energy, and the last one does. */
  void
  test_impact()
  {
    const auto problem = test::run_scene<2>(
      "Grid/Lower corner = 0, 0\nGrid/Upper corner = 1, 2\n"
      "Grid/Subdivisions = 10, 20\nMaterial points/Region = x > 0.2 && x < 0.8 "
      "&& y > 0.9 && y < 1.5\nMaterial points/Points per cell = 4\n"
      "Material/Young modulus = 1e6\nMaterial/Density = 1000\n"
      "Formulation/Type = u\nDynamics/Inertia = true\n"
      "Boundary conditions/Displacement = bottom: y>=0\n"
      "Boundary conditions/Gravity = 0, -10\n"
      "Time/Step size = 0.15\nTime/End time = 0.7\n" +
      cpdi);
    const std::vector<double> &times = test::recorded().times;
    bool                       grows = times.size() < 8;
    for (unsigned int n = 4; n < times.size(); ++n)
      grows =
        grows || times[n] - times[n - 1] > 1.01 * (times[n - 1] - times[n - 2]);
    test::check("steps don't grow behind an impact",
                !grows,
                std::to_string(times.size()) + " steps");
    test::check("energy that an impact creates is told of",
                subjects(*problem).find("energy created at the start") !=
                  std::string::npos,
                subjects(*problem));
  }

  /** A block that flies past a periodic side before it comes to the ground has
   * it in its way. Points don't change sides: it may end there. */
  void
  test_periodic()
  {
    const std::string block =
      "Grid/Lower corner = 0, 0\nGrid/Upper corner = 1, 2\n"
      "Grid/Subdivisions = 10, 20\nMaterial points/Region = x > 0.3 && x < 0.7 "
      "&& y > 0.5 && y < 1.1\nMaterial points/Points per cell = 4\n"
      "Material/Young modulus = 1e6\nMaterial/Density = 1000\n"
      "Formulation/Type = u\nDynamics/Inertia = true\n"
      "Dynamics/Initial velocity = 8, -4\n"
      "Boundary conditions/Displacement = bottom: y>=0\n"
      "Boundary conditions/Periodic sides = left: right\n"
      "Time/Step size = 0.2\nTime/End time = 0.2\n";
    const std::string error = error_of<2>(block + cpdi);
    const auto       &times = test::recorded().times;
    test::check("nothing passes beside a wall on a periodic grid",
                !times.empty() && times.front() < 0.19,
                error + ", " + std::to_string(times.size()) + " steps");
  }

  /** An L of squares of 0.2 m, each of two triangles: a ledge at y = 1 for
   * x < 1, and a pit beside it down to y = 0, periodic above the ledge. */
  void
  write_pit()
  {
    if (test::this_rank() == 0)
      {
        constexpr unsigned int n = 5, width = 2 * n + 1;
        const auto node = [](const unsigned int i, const unsigned int j) {
          return std::to_string(1 + i + width * j);
        };
        std::ostringstream nodes, elements;
        unsigned int       n_elements = 0;
        const auto         add        = [&](const std::string &type_and_tags,
                             const std::string &corners) {
          elements << ++n_elements << ' ' << type_and_tags << corners << '\n';
        };
        for (unsigned int j = 0; j < width; ++j)
          for (unsigned int i = 0; i < width; ++i)
            if (i >= n || j >= n)
              nodes << node(i, j) << ' ' << 0.2 * i << ' ' << 0.2 * j << " 0\n";
        for (unsigned int k = 0; k < n; ++k)
          {
            // lines (type 1) of the physical groups ledge, floor, left, right
            add("1 2 1 1 ", node(k, n) + ' ' + node(k + 1, n));
            add("1 2 2 2 ", node(n + k, 0) + ' ' + node(n + k + 1, 0));
            add("1 2 3 3 ", node(0, n + k) + ' ' + node(0, n + k + 1));
            add("1 2 4 4 ", node(2 * n, n + k) + ' ' + node(2 * n, n + k + 1));
          }
        for (unsigned int j = 0; j < 2 * n; ++j)
          for (unsigned int i = 0; i < 2 * n; ++i)
            if (i >= n || j >= n)
              {
                const std::string low = node(i, j), high = node(i + 1, j + 1);
                add("2 2 5 5 ", low + ' ' + node(i + 1, j) + ' ' + high);
                add("2 2 5 5 ", low + ' ' + high + ' ' + node(i, j + 1));
              }
        std::ofstream("pit.msh")
          << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n"
             "1 1 \"ledge\"\n1 2 \"floor\"\n1 3 \"left\"\n1 4 \"right\"\n"
             "2 5 \"room\"\n$EndPhysicalNames\n$Nodes\n"
          << width * width - n * n << '\n'
          << nodes.str() << "$EndNodes\n$Elements\n"
          << n_elements << '\n'
          << elements.str() << "$EndElements\n";
      }
    test::wait_for_all_ranks();
  }

  /** A block falls into the pit beside a ledge, on a grid that is periodic: it
   * comes to nothing. */
  void
  test_ledge()
  {
    write_pit();
    const std::string error = error_of<2>(
      "Grid/Type = gmsh\nGrid/File = pit.msh\n"
      "Material points/Region = x > 1.3 && x < 1.7 && y > 1.2 && y < 1.6\n"
      "Material points/Points per cell = 4\nMaterial/Young modulus = 1e6\n"
      "Material/Density = 1000\nFormulation/Type = u\n"
      "Dynamics/Inertia = true\nBoundary conditions/Gravity = 0, -10\n"
      "Boundary conditions/Displacement = ledge: y>=0; floor: y>=0\n"
      "Boundary conditions/Periodic sides = left: right\n"
      "Time/Step size = 0.02\nTime/End time = 0.4\n" +
      cpdi);
    test::check("a ledge ends on a periodic grid, too",
                error.empty() && test::recorded().times.size() == 20,
                error);
  }

  /** A body on a single column of cells meets the ground wherever the grid is.
   * Places beside an edge of the wall by rounding were beside the wall: one
   * block bounced, the other did not. (With one point per cell rounding says
   * what nodes do beside corners, see test_long_domains() of
   * default_quadrature.) */
  void
  test_moved()
  {
    const std::vector<std::array<std::string, 2>> sides = {
      {{"0", "0.4"}},
      {{"0.1", "0.5"}},
      {{"0.3333333333333333", "0.7333333333333333"}},
      {{"1000", "1000.4"}}};
    double first = 0;
    for (const auto &x : sides)
      {
        const auto problem = test::run_scene<2>(
          "Grid/Lower corner = " + x[0] + ", 0\nGrid/Upper corner = " + x[1] +
          ", 2\nGrid/Subdivisions = 1, 5\n"
          "Material points/Region = y > 0.8 && y < 1.6\n"
          "Material points/Points per cell = 4\nMaterial/Young modulus = 1e6\n"
          "Material/Density = 1000\nFormulation/Type = u\n"
          "Dynamics/Inertia = true\nDynamics/Initial velocity = 0, -4.7\n"
          "Boundary conditions/Displacement = left: x=0; right: x=0; "
          "bottom: y>=0\nPostprocess/Write energies = always\n"
          "Time/Step size = 0.2\nTime/End time = 0.4\n" +
          cpdi);
        const double momentum = test::get(*problem, "Momentum y (kg m/s)");
        if (x[0] == "0")
          first = momentum;
        else
          test::check_error("an impact on one column, at x = " + x[0] + " m",
                            test::relative(momentum, first),
                            1e-9);
      }
  }

  /** On a grid that is kept, corners that come to the wall later are held in
   * part only. */
  void
  test_behind()
  {
    std::ostringstream traction;
    traction << "Boundary conditions/Surfaces of body = end: y < 0.301\n"
             << "Boundary conditions/Traction on body = end: 0, -"
             << nominal_stress(1.46) << "*t\nTime/Step size = 0.1\n";
    const std::string scene =
      column<2>("0", "top: y=0; bottom: y>=0\n" + traction.str() + cpdi);
    const double exact = 0.4 * (nominal_stress(1.46) - nominal_stress(1.375));
    const auto   kept_grid = test::run_scene<2>(scene + kept);
    test::check("a body behind a wall of a kept grid is told of",
                subjects(*kept_grid).find("a body behind a wall") !=
                  std::string::npos,
                subjects(*kept_grid));
    const auto put_back = test::run_scene<2>(scene);
    test::check_error("not behind it where the grid is put back",
                      test::relative(test::get(*put_back, reaction), exact),
                      0.01);
    test::check("and no word of it",
                subjects(*put_back).find("behind a wall") == std::string::npos,
                subjects(*put_back));
  }

  /** A wall that stands outside of the grid by less than a cell, on a grid that
   * is kept: the body doesn't fall through it in silence. */
  void
  test_outside()
  {
    const std::string error =
      error_of<2>(column<2>("0",
                            "bottom: y>=-0.04\nDynamics/Inertia = true\n"
                            "Dynamics/Initial velocity = 0, -4\n"
                            "Time/Step size = 0.02\nTime/End time = 0.2\n" +
                              kept + cpdi));
    test::check("nothing falls through a wall outside of a kept grid",
                error.find("<Grid reset/Steps between resets = 1>") !=
                  std::string::npos,
                error);
  }

  /** A wall that the body goes along, away from it, cuts nothing. */
  void
  test_along()
  {
    const auto problem = test::run_scene<2>(
      "Grid/Lower corner = 0, 0\nGrid/Upper corner = 1, 1\n"
      "Grid/Subdivisions = 10, 10\nMaterial points/Region = y > 0.6 && x < 0.4\n"
      "Material points/Points per cell = 4\nMaterial/Young modulus = 1000\n"
      "Formulation/Type = u\nPostprocess/Reactions = right\n"
      "Boundary conditions/Displacement = left: x=0; top: y=0; right: x<=0\n"
      "Boundary conditions/Gravity = 0, -10*t\nMaterial/Density = 1\n" +
      cpdi);
    test::check("nothing is cut where no wall is met",
                test::recorded().times.size() == 1 &&
                  test::get(*problem, "Reaction x on right (N)") == 0,
                std::to_string(test::recorded().times.size()) + " steps");
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const std::string steps : {"1", "0.5", "0.2"})
    {
      const std::string size = "Time/Step size = " + steps + "\n";
      test_lengthened<2>("lengthened, steps of " + steps,
                         0.4,
                         "bottom: y>=0",
                         cpdi + size,
                         0.03);
      test_let_down("let down, steps of " + steps, cpdi + size, 0.03);
    }
  test_lengthened<2>("lengthened, a wall along its normal",
                     0.4,
                     "\nBoundary conditions/Walls = bottom: n >= 0",
                     cpdi,
                     0.03);
  // the wall acts once a point is in its cells, half a spacing early
  test_lengthened<2>(
    "lengthened, points", 0.4, "bottom: y>=0", "Time/Step size = 1\n", 0.5);
  test_lengthened<3>("lengthened, 3D", 0.08, "bottom: y>=0", cpdi, 0.03);
  test_lengthened<2>(
    "lengthened, grid kept", 0.4, "bottom: y>=0", kept + cpdi, 0.03);
  test_kept();
  test_inside();
  test_fall();
  test_along();
  test_impact();
  test_periodic();
  test_ledge();
  test_moved();
  test_behind();
  test_outside();
}
