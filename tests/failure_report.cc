/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What a run that can't go on tells and leaves behind: a limit load is told
// from a bad step and from a scene that was never in equilibrium, the last good
// state and the residual are written, and of points that left the grid it says
// through which boundary, and why the grid was put back.

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::string directory = "failure_report";
  std::string       warnings; ///< of the last scene

  /** The error of a scene in one line. */
  template <int dim = 2>
  std::string
  failure(const std::string &settings)
  {
    std::filesystem::remove_all(directory);
    std::filesystem::create_directory(directory);
    std::ostringstream    errors;
    std::streambuf *const original = std::cerr.rdbuf(errors.rdbuf());
    std::string           message;
    try
      {
        test::run_scene<dim>("Output/Directory = " + directory + "\n" +
                             settings);
      }
    catch (const std::exception &exc)
      {
        message = exc.what();
      }
    std::cerr.rdbuf(original);
    warnings = test::one_line(errors.str());
    return test::one_line(message);
  }

  void
  expect(const std::string              &what,
         const std::string              &message,
         const std::vector<std::string> &words)
  {
    std::string missing;
    for (const std::string &word : words)
      if (message.find(word) == std::string::npos)
        missing += " <" + word + ">";
    test::check(what, missing.empty(), "missing" + missing + ": " + message);
  }

  std::string
  contents(const std::string &file)
  {
    std::ifstream stream(directory + "/" + file);
    return {std::istreambuf_iterator<char>(stream),
            std::istreambuf_iterator<char>()};
  }

  void
  expect_files(const std::string &what, const bool with_grid)
  {
    const std::string points = contents("failure-points-00001.0000.vtu"),
                      grid   = contents("failure-grid-00001.0000.vtu");
    test::check(what + ": files",
                points.find("deformation_gradient") != std::string::npos &&
                  (!with_grid ||
                   (grid.find("residual_force") != std::string::npos &&
                    grid.find("displacement_increment") != std::string::npos)),
                std::to_string(points.size()) + " and " +
                  std::to_string(grid.size()) + " bytes");
  }

  /** A block on a smooth floor in uniform tension: in plane strain a Tresca
   * material bears 2 c, here at t = 0.5, a Mohr-Coulomb one
   * 2 c cos φ/(1 + sin φ). It yields everywhere at once, so that the steps
   * before tell nothing. */
  const std::string block =
    "Grid/Upper corner = 1, 1.25\nGrid/Subdivisions = 4, 5\n"
    "Material points/Region = y < 1\n"
    "Material/Model = Mohr-Coulomb\nMaterial/Young modulus = 1e6\n"
    "Material/Poisson ratio = 0.49\nMaterial/Mohr-Coulomb/Cohesion = 1000\n"
    "Boundary conditions/Displacement = bottom: y = 0; left: x = 0\n"
    "Boundary conditions/Surfaces of body = top: y > 0.99\n"
    "Boundary conditions/Traction on body = top: 0, 4000*t\n"
    "Time/Step size = 0.04\nTime/Minimum step size = 0.0025\n";

  double
  number_after(const std::string &words, const std::string &text)
  {
    const auto place = text.find(words);
    return place == std::string::npos ?
             0. :
             std::stod(text.substr(place + words.size()));
  }

  void
  test_limit_load(const std::string &what,
                  const std::string &settings,
                  const double       lowest,
                  const double       highest)
  {
    const std::string message = failure(settings);
    expect(what,
           message,
           {"No equilibrium found: limit load ",
            "displacement per load",
            "% of the volume has yielded",
            "can't be cut back further",
            "largest residual force",
            "failure-grid.pvd",
            "failure-points.pvd"});
    expect_files(what, true);
    const double t = number_after("limit load near t = ", message);
    test::check(what + ": its time",
                t > lowest && t < highest,
                std::to_string(t));
  }

  /** A block that is pulled up by its own weight yields bit by bit: it gives
   * way, of which one is warned, and is followed for a while. */
  void
  test_limit_load_after_warning()
  {
    const std::string message =
      failure(block + "Boundary conditions/Traction on body =\n"
                      "Boundary conditions/Surfaces of body =\n"
                      "Boundary conditions/Gravity = 0, 4*t\n"
                      "Time/Step size = 0.01\n"
                      "Time/Minimum step size = 0.0003\n");
    expect("weight",
           message,
           {"No equilibrium found: limit load between t = 0.",
            "the last equilibrium that was found",
            "% of the volume has yielded"});
    expect_files("weight", true);
    const double first = number_after("limit load between t = ", message),
                 last  = number_after("and t = ", message);
    test::check("weight: its time",
                first > 0.5 && first < last && last < 1,
                std::to_string(first) + " to " + std::to_string(last));
    test::check("weight: warning and error say the same",
                number_after("since t = ", warnings) == first,
                warnings);
  }

  /** A layer of soil, here in the first second of "time", and a strip load of
   * the width 1 m beside its axis, from then on: @p loads. */
  std::string
  staged(const std::string &material,
         const std::string &load,
         const std::string &cells = "16, 9")
  {
    return "Grid/Upper corner = 4, 2.25\nGrid/Subdivisions = " + cells +
           "\n"
           "Material points/Region = y < 2\nMaterial/Density = 2000\n"
           "Material/Young modulus = 1e7\nMaterial/Poisson ratio = 0.499\n"
           "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: "
           "x=0, y=0\n"
           "Boundary conditions/Gravity = 0, -10*min(t,1)\n"
           "Boundary conditions/Surfaces of body = pad: y > 1.99 && x < 0.5\n"
           "Boundary conditions/Traction on body = pad: 0, -" +
           load + "*max(t-1,0)\nTime/End time = 2\nTime/Step size = 0.05\n" +
           material;
  }

  /** Weight beside held sides is much stiffer than a load on a part of the
   * surface, which is a loading of its own: its limit is (2 + π) c, here at
   * t = 1 + 0.643. */
  void
  test_stages()
  {
    const std::string message =
      failure(staged("Material/Model = Mohr-Coulomb\n"
                     "Material/Mohr-Coulomb/Cohesion = 1e4\n",
                     "8e4",
                     "32, 18"));
    expect("a strip load after weight",
           message,
           {"No equilibrium found: limit load between t = 1.",
            "stiffest step of this loading"});
    const double first = number_after("limit load between t = ", message),
                 last  = number_after("and t = ", message);
    const double exact = 1 + (2 + test::pi) * 1e4 / 8e4;
    test::check("a strip load after weight: the limit load is between",
                first > 1.5 && first < exact && exact < last,
                std::to_string(first) + " to " + std::to_string(last) +
                  ", not " + std::to_string(exact));
    for (const std::string material :
         {"Material/Model = Neo-Hookean\n",
          "Material/Model = Mohr-Coulomb\n"
          "Material/Mohr-Coulomb/Cohesion = 1e5\n"})
      {
        const std::string error = failure(staged(material, "5e4"));
        test::check("a strip load far below its limit, " +
                      material.substr(17, 3),
                    error.empty() && warnings.empty(),
                    error + warnings);
      }
  }

  void
  test_limit_loads()
  {
    // down to the smallest step, and what elasticity narrows the block by
    test_limit_load("Tresca", block, 0.493, 0.5);
    test_limit_load("Mohr-Coulomb",
                    block + "Material/Mohr-Coulomb/Friction angle = 20\n"
                            "Material/Mohr-Coulomb/Dilation angle = 0\n",
                    0.343,
                    0.3502);
    test_limit_load_after_warning();
  }

  void
  test_others()
  {
    expect("first step",
           failure(block +
                   "Boundary conditions/Traction on body = top: 0, 9000\n"),
           {"very first step", "Young modulus", "Minimum step size"});
    expect_files("first step", true);
    expect("a closed volume",
           failure("Grid/Subdivisions = 4, 4\nMaterial/Poisson ratio = 0.5\n"
                   "Time/Minimum step size = 0.25\n"
                   "Boundary conditions/Displacement = left: x=0; right: x=0; "
                   "bottom: y=0; top: y=-0.01*t\n"),
           {"the whole surface of the body is constrained", "0.4999"});
    // a block that hangs upside down; an elastic one has no plastic limit load
    const std::string hanging =
      "Grid/Upper corner = 3, 6\nGrid/Subdivisions = 12, 24\n"
      "Material points/Region = x < 1 && y < 1\n"
      "Material/Young modulus = 1e6\n"
      "Material/Poisson ratio = 0.3\nMaterial/Density = 1\n"
      "Quadrature/Type = points\n"
      // with the default it ends where points leave the grid
      "Newton/Maximum iterations = 15\nNewton/Maximum backtracks = 4\n"
      "Boundary conditions/Displacement = bottom: y = 0; left: x = 0\n"
      "Boundary conditions/Gravity = 0, 1e6*t\n"
      "Time/Step size = 0.04\nTime/Minimum step size = 0.0025\n";
    expect("elastic",
           failure(hanging),
           {"the material is elastic", "Quadrature/Type = CPDI"});
    expect("far from yielding",
           failure(hanging + "Material/Model = J2\n"
                             "Material/J2/Yield stress = 1e12\n"),
           {"no material point has yielded yet",
            "it buckles or snaps",
            "Quadrature/Type = CPDI"});
    expect("bad step",
           failure("Grid/Subdivisions = 4, 4\n"
                   "Boundary conditions/Displacement = bottom: y = 0; left: x "
                   "= 0; top: y = if(t < 0.1, -0.1*t, -3)\n"
                   "Time/Step size = 0.04\nTime/Minimum step size = 0.01\n"),
           {"Only displacements are prescribed", "Minimum step size"});
    const std::string rests =
      failure(staged("Material/Model = Mohr-Coulomb\n"
                     "Material/Mohr-Coulomb/Cohesion = 1e5\n"
                     "Time/Minimum step size = 0.02\n",
                     "0") +
              "Boundary conditions/Displacement = left: x=if(t < 1.12, 0, 3); "
              "right: x=0; bottom: x=0, y=0\n");
    expect("bad step while loads rest",
           rests,
           {"No load changes in this step", "Minimum step size"});
    test::check("... is no limit load, and has displacements prescribed",
                rests.find("limit load near") == std::string::npos &&
                  rests.find("instead of loads") == std::string::npos,
                rests);
    expect("points that leave the grid",
           failure("Grid/Subdivisions = 2, 2\nBoundary conditions/Displacement "
                   "= everywhere: x = 0, y = 2*t\nTime/Step size = 0.5\n"),
           {"24 material points left the background grid, 24 through <top>",
            "<top> holds the material",
            "Enlarge",
            "failure-points.pvd"});
    expect_files("points that leave the grid", false);
    const std::string points = contents("failure-points-00001.0000.vtu");
    test::check("they are among those written",
                points.find("NumberOfPoints=\"24\"") != std::string::npos,
                points.substr(0, 400));
  }

  /** What may have put points outside, besides what they are told above. */
  void
  test_reset()
  {
    const std::string block =
      "Grid/Subdivisions = 4, 4\nMaterial/Young modulus = 1e4\n"
      "Time/Step size = 0.25\n"
      "Boundary conditions/Displacement = bottom: x = 0, y = 0; top: x = 0, y "
      "= ";
    expect("a grid put back for its quality",
           failure(block + "0.8*t\nGrid reset/Steps between resets = 0\n"
                           "Grid reset/Smallest element quality = 0.95\n"),
           {"through <top>",
            "the quality of a cell, 0.8",
            "<Grid reset/Smallest element quality> = 0.95",
            "With 0 there it goes on moving"});
    expect("a grid put back after some steps",
           failure(block + "0.4*t\nGrid reset/Steps between resets = 2\n"),
           {"reset before, since <Grid reset/Steps between resets> = 2"});
  }

  /** A moment on a rigid body, and a periodic cell that moves. */
  void
  test_sides()
  {
    expect("points that leave a periodic cell",
           failure("Grid/Subdivisions = 4, 4\nTime/Step size = 0.25\n"
                   "Boundary conditions/Displacement = bottom: x = 2*t, y = 0; "
                   "top: x = 2*t, y = 0\n"
                   "Boundary conditions/Periodic sides = left: right\n"),
           {"through <right>",
            "Points do not pass from one of <Boundary conditions/Periodic "
            "sides> to the other",
            "<Grid reset/Steps between resets = 0>"});
    // a column that is twisted by a moment, beyond what it bears
    const std::string twisted = failure<3>(
      "Grid/Subdivisions = 2, 2, 2\nMaterial/Young modulus = 1e6\n"
      "Material/Poisson ratio = 0.49\nMaterial/Model = Mohr-Coulomb\n"
      "Material/Mohr-Coulomb/Cohesion = 1000\n"
      "Grid reset/Steps between resets = 0\n"
      "Grid reset/Smallest element quality = 0\n"
      "Boundary conditions/Displacement = bottom: x = 0, y = 0, z = 0\n"
      "Quadrature/Type = CPDI\n"
      "Rigid body: top/Shape = half plane\nRigid body: top/Point = 0.5, 1, "
      "0.5\nRigid body: top/Free = ry\nRigid body: top/Moment = ry=1e4*t\n"
      "Boundary conditions/Surfaces of body = end: y > 0.99\n"
      "Interaction: end - top/Law = tie\n"
      "Time/Step size = 0.02\nTime/Minimum step size = 0.002\n");
    expect("the moment of a rigid body is a load",
           twisted,
           {"can't be cut back further", "No equilibrium found: limit load"});
    test::check("... and not only displacements",
                twisted.find("Only displacements") == std::string::npos,
                twisted);
  }

  /** A rigid body that is in the body at t = 0, where contact can't push it
   * out; one that is in it by less is pushed out. Friction that no longer
   * holds, at t = 0.47, is no bad step. */
  void
  test_contact()
  {
    const std::string wide =
      "Quadrature/Type = CPDI\nGrid/Lower corner = -2, -0.5\n"
      "Grid/Upper corner = 2, 2\nGrid/Subdivisions = 16, 10\n"
      "Material points/Region = abs(x) < 1 && y > 0 && y < 1\n"
      "Material/Young modulus = 1000\n"
      "Boundary conditions/Surfaces of body = floor: y < 1e-6\n";
    const std::string pressed =
      wide + "Interaction: floor - place/Displacement = x=0, y=0\n"
             "Rigid body: tool/Shape = circle\nRigid body: tool/Radius = 0.5\n"
             "Interaction: body - tool/Law = unilateral\n"
             "Rigid body: tool/Centre = 0, ";
    expect("a rigid body within the body",
           failure(pressed + "0.8\n"),
           {"<tool> is ", " m deep in <body>", "the very first step"});
    const std::string shallow = failure(pressed + "1.45\n");
    test::check("... by little", shallow.empty(), shallow);
    expect("friction that no longer holds",
           failure(wide +
                   "Rigid body: ground/Shape = half plane\n"
                   "Rigid body: ground/Normal = 0, 1\n"
                   "Interaction: body - ground/Law = Coulomb\n"
                   "Interaction: body - ground/Friction coefficient = 0.47\n"
                   "Material/Density = 1\n"
                   "Boundary conditions/Gravity = 10*t, -10\n"
                   "Time/Step size = 0.1\nTime/Minimum step size = 0.01\n"),
           {"from t = 0.46", "friction that holds it, can carry"});
  }

  /** A disk without room, as far as a program can tell. */
  void
  test_full_disk()
  {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlim_t unlimited = limit.rlim_cur;
    std::cout << std::flush;
    limit.rlim_cur = 100;
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string statistics =
      failure(block + "Boundary conditions/Traction on body = top: 0, 100\n");
    const std::string fields =
      failure(block + "Boundary conditions/Traction on body = top: 0, 9000\n");
    limit.rlim_cur = unlimited;
    setrlimit(RLIMIT_FSIZE, &limit);
    expect("full disk", statistics, {"statistics.txt", "Is the disk full"});
    expect("full disk, failed step",
           fields,
           {"very first step", "failure-grid", "Is the disk full"});
  }
} // namespace



/** Bodies that are as stiff as ever, but faster than at first. */
namespace
{
  void
  test_false_alarms()
  {
    const std::string elastic =
      "Grid/Subdivisions = 4, 4\nMaterial/Young modulus = 1e6\n"
      "Material/Poisson ratio = 0.3\nTime/Step size = 0.05\n"
      "Boundary conditions/Displacement = bottom: x = 0, y = 0";
    const auto expect_quiet = [](const std::string &what) {
      test::check(what,
                  warnings.find("limit load") == std::string::npos,
                  warnings);
    };
    const auto run = [&](const std::string &what, const std::string &settings) {
      const std::string message = failure(elastic + settings);
      test::check(what + ": to the end", message.empty(), message);
      expect_quiet(what);
    };
    run("a body at rest but for rounding",
        "; top: y = if(t < 0.3, 1e-17*t, 1e-17)\n"
        "Boundary conditions/Surfaces of body = side: right\n"
        "Boundary conditions/Traction on body = side: if(t < 0.49, 1e-13*t, "
        "10*t), 0\n");
    run("a smooth motion of a boundary", "; top: y = -0.01*t^3\n");
    run("a smooth motion of a surface of the body",
        "\nBoundary conditions/Surfaces of body = roof: top\n"
        "Quadrature/Type = CPDI\n"
        "Interaction: roof - place/Displacement = x=0, y=-0.01*t^3\n");
    run("a smooth motion of a rigid body",
        "\nBoundary conditions/Surfaces of body = roof: y > 0.99\n"
        "Quadrature/Type = CPDI\nRigid body: top/Shape = half plane\n"
        "Rigid body: top/Motion = y=-0.01*t^3\n"
        "Interaction: roof - top/Law = tie\n");
    run("a load that grows as t^2",
        "\nBoundary conditions/Traction = top: 0, -1e4*t^2\n");
    run("a weight that grows as t^3",
        "\nBoundary conditions/Gravity = 0, -10*t^3\n"
        "Material/Density = 1000\n");
    run("a pressure that grows as t^2",
        "\nBoundary conditions/Surfaces of body = roof: top\n"
        "Boundary conditions/Pressure on body = roof: 1e4*t^2\n");
    // what flows is found, however its load grows
    failure(block + "Boundary conditions/Traction on body =\n"
                    "Boundary conditions/Surfaces of body =\n"
                    "Boundary conditions/Gravity = 0, 4*t^2\n"
                    "Time/Step size = 0.01\n"
                    "Time/Minimum step size = 0.0003\n");
    const double since = number_after("since t = ", warnings);
    test::check("a weight that grows as t^2 beyond the limit load",
                since * since > 0.5 && since * since < 1 &&
                  warnings.find("displacement per load") != std::string::npos,
                warnings);
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_limit_loads();
  test_stages();
  test_false_alarms();
  test_others();
  test_reset();
  test_sides();
  test_contact();
  test_full_disk();
  return 0;
}
