/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What a user is told of scenes that can't be meant: the warnings and errors
// name the parameter, the numbers and the remedy. Formulas with commas and
// without blanks, meshes that can't be read, physical groups.

#include <filesystem>
#include <fstream>

#include "hoarder.h"
#include "scene_messages.h"

using namespace isochor;

namespace
{
  void
  test_overflow()
  {
    expect(
      "too many history variables",
      messages<2>(good + "Material/Model = Hoarder\n"),
      {"ERROR", "Hoarder", "Material/Model", "17 history variables", "16"});
    expect("too many materials",
           messages<2>(good, true, 257),
           {"ERROR", "256 materials", "<Material 256>"});
  }

  void
  test_touch()
  {
    const std::string low = good + "Material points/Region = y < 0.5\n";
    expect("displacement where no material is",
           messages<2>(low + "Boundary conditions/Displacement = bottom: x = "
                             "0, y = 0; top: y = 0\n"),
           {"WARNING",
            "<top>",
            "Boundary conditions/Displacement",
            "[0, 1] x [0, 0.5]",
            "[0, 1] x [1, 1]",
            "reaches it later",
            "check its place"});
    expect("traction where no material is",
           messages<2>(low + "Boundary conditions/Traction = top: 0, -1\n"),
           {"ERROR", "<top>", "Boundary conditions/Traction"});
    expect("reaction where no material is",
           messages<2>(low + "Postprocess/Reactions = bottom, top\n"),
           {"WARNING", "<top>", "Postprocess/Reactions"});
    expect("surface without a condition",
           messages<2>(good +
                       "Boundary conditions/Surfaces of body = roof: y > "
                       "0.9\n"),
           {"WARNING no effect of <", "roof>", "Traction on body"});
    expect("no mistake", messages<2>(good), {});
    expect("no mistake, in a run", messages<2>(good, false), {});
  }

  void
  test_supports()
  {
    const std::string no_load = "Grid/Subdivisions = 4, 4\n";
    expect("a body that nothing holds",
           messages<2>(no_load),
           {"WARNING",
            "without support: a body",
            "translation in x, translation in y, rotation",
            "Boundary conditions/Displacement",
            "Dynamics/Inertia"});
    expect("... in u",
           messages<2>(no_load + "Formulation/Type = u\n"),
           {"translation in x, translation in y, rotation"});
    const std::string enclosed =
      no_load + "Material/Poisson ratio = 0.5\nMaterial/Density = 1\n"
                "Boundary conditions/Gravity = 0, -t\n"
                "Boundary conditions/Displacement = left: x=0, y=0; right: "
                "x=0, y=0; bottom: x=0, y=0; top: x=0, y=0\n";
    expect("a pressure that nothing determines",
           messages<2>(enclosed),
           {"WARNING", "up to a constant", "Poisson ratio"});
    expect("... but not if the roof may let go",
           messages<2>(enclosed + "Boundary conditions/Displacement = left: "
                                  "x=0; right: x=0; bottom: y=0\n"
                                  "Boundary conditions/Walls = top: n>=0\n"
                                  "Quadrature/Type = CPDI\n"),
           {});
    expect("... but the compressible one is",
           messages<2>(enclosed + "Material/Poisson ratio = 0.4999\n"),
           {});
    expect("a rigid body that nothing holds",
           messages<2>(no_load + "Quadrature/Type = CPDI\n"
                                 "Rigid body: a/Free = x, y, rotation\n"
                                 "Interaction: body - a/Law = tie\n"),
           {"free in translation in x, translation in y, rotation"});
    expect("... may move in dynamics",
           messages<2>(no_load + "Dynamics/Inertia = true\n"),
           {});
    const std::string held =
      no_load + "Boundary conditions/Displacement = bottom: ";
    expect("free to slide",
           messages<2>(held + "y = 0\n"),
           {"free in translation in x (the one"});
    expect("free to slide under a pressure that follows one of its sides",
           messages<2>("Grid/Subdivisions = 4, 4\nQuadrature/Type = CPDI\n"
                       "Material points/Region = x > 0.25 && x < 0.75\n"
                       "Boundary conditions/Displacement = bottom: y = 0\n"
                       "Boundary conditions/Surfaces of body = side: x > 0.74\n"
                       "Boundary conditions/Pressure on body = side: 1e4*t\n"
                       "Time/Step size = 0.1\n"),
           {"free in translation in x (the one"});
    expect("free to slide behind a one-sided wall",
           messages<2>(no_load +
                       "Quadrature/Type = CPDI\n"
                       "Boundary conditions/Walls = bottom: n >= 0\n"),
           {"free in translation in x (the one"});
    expect("free to turn about a node",
           messages<2>("Grid/Subdivisions = 1, 1\n"
                       "Material points/Region = y > x\n"
                       "Boundary conditions/Displacement = bottom: x = 0, y = "
                       "0\n"),
           {"free in rotation about (0, 0) (the one"});
    expect("one of two bodies",
           messages<2>(held + "x = 0, y = 0\n"
                              "Material points/Region = (y-0.25)*(y-0.75) > "
                              "0\n"),
           {"without support: a body",
            "rotation (the one around (0.5, 0.875)"});
    expect("held by an interaction",
           messages<2>(no_load +
                       "Boundary conditions/Surfaces of body = foot: bottom\n"
                       "Interaction: foot - place/Displacement = x = 0, y = "
                       "0.01*t\n"),
           {});
    expect("far away and small",
           messages<2>("Grid/Lower corner = 1e4, 1e4\n"
                       "Grid/Upper corner = 10000.01, 10000.01\n"
                       "Boundary conditions/Displacement = bottom: y = 0\n"),
           {"free in translation in x (the one"});
    expect("CPDI, cut cells",
           messages<2>(held + "y = 0\nQuadrature/Type = CPDI\n"
                              "Material points/Points per cell = 4\n"
                              "Material points/Region = y < 0.625\n"),
           {"free in translation in x (the one"});
    expect("in 3D",
           messages<3>("Grid/Subdivisions = 2, 2, 2\n"
                       "Boundary conditions/Displacement = bottom: y = 0\n"),
           {"free in translation in x, translation in z, rotation about an "
            "axis in y (the one"});
    const std::string end =
      messages<2>(no_load + "Boundary conditions/Gravity = 0, -1\n", false);
    test::check("loaded and not held: the run ends in the first step",
                end.find("very first step") != std::string::npos &&
                  end.find("without support: a body") != std::string::npos,
                end);
  }

  void
  test_loads()
  {
    expect("weight without density",
           messages<2>(good + "Material/Density = 0\n"),
           {"ERROR", "Boundary conditions/Gravity", "<Material/Density> is 0"});
    expect("nothing loads the scene",
           messages<2>(good + "Boundary conditions/Gravity = 0, 0\n", false),
           {"WARNING", "no iteration", "Boundary conditions", "begin later"});
    expect("body much smaller than a cell",
           messages<2>("Grid/Upper corner = 10, 10\nGrid/Subdivisions = 4, 4\n"
                       "Material points/Lattice spacing = 0.02\n"
                       "Material points/Region = x < 0.06 && y < 0.06\n"
                       "Boundary conditions/Displacement = bottom: x = 0, y = "
                       "0\n"),
           {"WARNING", "smaller than a cell", "0.0036", "Grid/Subdivisions"});
    expect("material without points",
           messages<2>(good, true, 2),
           {"WARNING", "<Material 2>", "Materials in zones"});
    expect("gravity that depends on the place",
           messages<2>(good + "Boundary conditions/Gravity = 0, -9.81*x\n"),
           {"ERROR", "-9.81*x", "Boundary conditions/Gravity", "depends on x"});
    expect("region with one equals sign",
           messages<2>(good + "Material points/Region = x=1\n"),
           {"ERROR", "x=1", "Material points/Region", "'=='"});
    expect("region with two comparisons in a row",
           messages<2>(good + "Material points/Region = 0<x<1\n"),
           {"ERROR", "0<x<1", "Material points/Region", "a < b && b < c"});
    expect("comparisons that are right",
           messages<2>(
             good +
             "Material points/Region = (0<x)*(x<=1) && y>0 && y<2 && x!=3\n"),
           {});
    expect("region that depends on time",
           messages<2>(good + "Material points/Region = y < t\n"),
           {"ERROR", "Material points/Region", "depends on t"});
    expect("stretch that depends on the place",
           messages<2>(good + "Grid/Stretch = y: 0 -> 0, 1 -> 0.1*x\n"),
           {"ERROR", "Grid/Stretch", "depends on x"});
    expect("initial velocity that depends on time",
           messages<2>(good + "Dynamics/Inertia = true\n"
                              "Dynamics/Initial velocity = t, 0\n"),
           {"ERROR", "Dynamics/Initial velocity", "depends on t"});
    expect("PPP of a body with inertia and weight",
           messages<2>(good + "Formulation/Stabilisation = PPP\n"
                              "Dynamics/Inertia = true\n"
                              "Boundary conditions/Gravity = 0, -10\n"),
           {"ERROR", "Stabilisation = PPP", "Stabilisation = OSS"});
    expect("what only looks like a variable",
           messages<2>(good + "Boundary conditions/Gravity = 0, "
                              "-max(1e-3, exp(t))\n"),
           {});
  }

  void
  test_idle()
  {
    const std::vector<std::array<std::string, 3>> cases = {
      {{"Formulation/PPP coefficient = 8",
        "Formulation/Type = u",
        "Formulation/PPP coefficient"}},
      {{"Formulation/PPP coefficient = 8",
        "Formulation/Stabilisation = none",
        "Formulation/PPP coefficient"}},
      {{"Grid/Depth = 2", "", "Grid/Depth"}},
      {{"Grid/File = a.msh", "", "Grid/File"}},
      {{"Grid reset/Smallest element quality = 0.1",
        "",
        "Grid reset/Smallest element quality"}},
      {{"Dynamics/Newmark gamma = 0.6", "", "Dynamics/Newmark gamma"}},
      {{"Material/J2/Yield stress = 1", "", "Material/J2/Yield stress"}},
      {{"Linear solver/Block FGMRES/Basis size = 50",
        "Linear solver/Solver = MUMPS",
        "Linear solver/Block FGMRES/Basis size"}},
      {{"Boundary conditions/Boundary points per face = 1",
        "",
        "Boundary conditions/Boundary points per face"}},
      {{"Material points/Points per cell = 4",
        "Material points/Lattice spacing = 0.125",
        "Material points/Points per cell"}},
      {{"Material points/Split at share of cell = 1",
        "Quadrature/Type = points",
        "Material points/Split at share of cell"}}};
    for (const auto &c : cases)
      {
        expect("without effect: " + c[0] + (c[1].empty() ? "" : ", ") + c[1],
               messages<2>(good + c[1] + "\n" + c[0] + "\n"),
               {"WARNING", "no effect", c[2]});
      }
    expect("the default in other words",
           messages<2>(good + "Formulation/Type = u\nFormulation/"
                              "PPP coefficient = 1.0\n"),
           {});
    expect("zones of a lattice",
           messages<2>(good + "Material points/Lattice spacing = 0.1\n"
                              "Material points/Points per cell in zones = 6: "
                              "1\n"),
           {"ERROR",
            "Material points/Points per cell in zones",
            "Material points/Lattice spacing"});
    expect("domains that don't fit together",
           messages<2>(
             good +
             "Material points/Points per cell in zones = 9: y > 0.5; 12: y > "
             "0.75\n"),
           {"WARNING",
            "4 points beside 9 at 4 faces, 9 points beside 12 at 4 faces",
            "<Material points/Points per cell in zones>",
            "4, 6 and 12"});
    expect("domains that fit together",
           messages<2>(
             good +
             "Material points/Points per cell in zones = 12: y > 0.5; 6: y > "
             "0.75\n"),
           {});
    expect("points without domains don't have to fit",
           messages<2>(good +
                       "Material points/Points per cell in zones = 9: y > "
                       "0.5\nQuadrature/Type = points\n"),
           {});
    expect("lattice and mesh",
           messages<2>(good + "Material points/Lattice spacing = 0.1\n"
                              "Material points/Body mesh = body.msh\n"),
           {"ERROR", "Material points/Body mesh"});
    expect("too fine a lattice",
           messages<2>(good + "Material points/Lattice spacing = 1e-6\n"),
           {"ERROR", "Material points/Lattice spacing", "1e+12"});
  }

  void
  test_formulas()
  {
    const auto top_reaction = [](const std::string &settings) {
      return test::get(*test::run_scene<2>(
                         good + "Postprocess/Reactions = bottom\n" + settings),
                       "Reaction y on bottom (N)");
    };
    // weight of the unit square
    test::check_error("commas in a load",
                      std::abs(top_reaction("Boundary conditions/Gravity = "
                                            "if(t>0.5,0,1),max(-1,-2)\n") -
                               1000),
                      1e-6);
    test::check_error(
      "commas in a prescribed displacement",
      std::abs(
        top_reaction("Boundary conditions/Displacement=bottom:x=min(0,1),"
                     "y=if(t>=0,if(x>2,1,0),1);top:y=min(-0.01*t,0)\n") /
          top_reaction("Boundary conditions/Displacement = bottom: x = 0, "
                       "y = 0; top: y = -0.01*t\n") -
        1),
      1e-12);
    const auto half =
      test::run_scene<2>(good + "Material points/Region=x<0.5&&y<0.5||x<0\n");
    test::check_error("conditions without blanks",
                      std::abs(test::get(*half, "Mass (kg)") - 250),
                      1e-9);
    expect("a stretch with commas, without blanks",
           messages<2>(good + "Grid/Stretch=y:0->0,1->if(t>0,-0.1*t,0)\n"),
           {});
    const auto parts =
      split_named_list("a:if(x>1;2;3),b(:);c: x ? 1 : 2 ;", "test");
    test::check("lists split outside of parentheses only",
                parts.size() == 2 && parts[0].first == "a" &&
                  parts[0].second == "if(x>1;2;3),b(:)" &&
                  parts[1].second == "x ? 1 : 2",
                std::to_string(parts.size()));
    expect("parentheses that don't match",
           messages<2>(good + "Boundary conditions/Gravity = 0, -(1\n"),
           {"ERROR", "Boundary conditions/Gravity", "parentheses"});
  }

  /** A square of two triangles with the middle of each edge. */
  const char *const second_order =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n1 0 0 0\n2 1 0 0\n"
    "3 1 1 0\n4 0 1 0\n5 0.5 0 0\n6 1 0.5 0\n7 0.5 1 0\n8 0 0.5 0\n"
    "9 0.5 0.5 0\n$EndNodes\n$Elements\n2\n1 9 2 1 1 1 2 3 5 6 9\n"
    "2 9 2 1 1 1 3 4 9 7 8\n$EndElements\n";

  void
  test_meshes()
  {
    std::ofstream("second.msh") << second_order;
    std::ofstream("binary.msh", std::ios::binary)
      << "$MeshFormat\n4.1 1 8\n"
      << std::string("\1\0\0\0", 4) << "\n$EndMeshFormat\n";
    std::ofstream("old.msh") << "$NOD\n1\n1 0 0 0\n$ENDNOD\n";
    std::ofstream("lines.msh")
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n2 1 0 0\n"
         "$EndNodes\n$Elements\n1\n1 1 2 1 1 1 2\n$EndElements\n";
    std::ofstream("quads.msh")
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n"
         "3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n1\n1 3 2 1 1 1 2 3 4\n"
         "$EndElements\n";
    const std::string grid = "Grid/Type = gmsh\nGrid/File = ";
    const std::vector<std::pair<std::string, std::string>> cases = {
      {"second.msh", "second or higher order"},
      {"binary.msh", "is binary"},
      {"old.msh", "format 1"},
      {"lines.msh", "no triangles"},
      {"quads.msh", "other cells than triangles"}};
    for (const auto &c : cases)
      {
        expect("grid from " + c.first,
               messages<2>(grid + c.first + "\n"),
               {"ERROR", c.first, "Grid/File", c.second});
        expect("body from " + c.first,
               messages<2>(good + "Material points/Body mesh = " + c.first +
                           "\n"),
               {"ERROR", c.first, "Material points/Body mesh", c.second});
      }
    expect("surfaces from binary.msh",
           messages<2>(good +
                       "Quadrature/Type = points\n"
                       "Boundary conditions/Surfaces of body = roof: y > 0.9\n"
                       "Boundary conditions/Traction on body = roof: 0, 1\n"
                       "Boundary conditions/Mesh of body surfaces = "
                       "binary.msh\n"),
           {"ERROR", "Mesh of body surfaces", "is binary"});

    const std::string footing = grid + SOURCE_DIR "/footing.msh\n"
                                                  "Formulation/Type = u\n"
                                                  "Quadrature/Type = CPDI\n"
                                                  "Boundary conditions/"
                                                  "Displacement = everywhere: "
                                                  "x = 0, y = 0\n"
                                                  "Boundary conditions/"
                                                  "Gravity = 0, -1\n";
    for (const std::string points : {"Lattice spacing = 0.125",
                                     "Lattice spacing = 0",
                                     "Body mesh = " SOURCE_DIR "/footing.msh"})
      {
        const auto problem = test::run_scene<2>(
          footing + "Material points/Physical groups = soil\nMaterial points/" +
          points + "\n");
        // soil is 12 m wide and 10 m high
        test::check_error("the groups of " + points.substr(0, points.find('/')),
                          std::abs(test::get(*problem, "Mass (kg)") / 1000 -
                                   120),
                          1e-6);
      }
    expect("unknown group",
           messages<2>(footing + "Material points/Physical groups = clay\n"),
           {"ERROR", "Material points/Physical groups", "clay", "soil"});
  }

  void
  test_small_mistakes()
  {
    expect("a wall by its component",
           messages<2>("Grid/Subdivisions = 4, 4\n"
                       "Boundary conditions/Displacement = left: x = 0; "
                       "bottom: y >= 0\n"),
           {"ERROR", "<bottom: y >= 0>", "Walls = bottom: n >= formula"});
    expect("two probes of one name",
           messages<2>(good + "Postprocess/Point probes = P: 0.1, 0.1; "
                              "P: 0.2, 0.2\n"),
           {"ERROR", "Postprocess/Point probes", "<P> twice"});
    expect("no time",
           messages<2>(good + "Time/End time = 0\n"),
           {"ERROR", "Time/End time", "positive"});
    expect("a comparison without a value",
           messages<2>(good + "Material points/Region = sqrt(x-0.5) < 1\n"),
           {"ERROR", "Material points/Region", "no finite value"});
    expect("a comparison that is guarded",
           messages<2>(good +
                       "Material points/Region = x>0.5 && sqrt(x-0.5) < 1\n"),
           {});
  }

  /** What a run says of itself. */
  void
  test_runs()
  {
    const std::string bar =
      "Grid/Upper corner = 2, 1\nGrid/Subdivisions = 8, 4\n"
      "Material points/Region = x < 1\nBoundary conditions/Displacement = "
      "left: x = 0; bottom: y = 0; top: y = -0.2*t\nTime/Step size = 0.1\n"
      "Grid/Stretch = y: 0 -> 0, 1 -> -0.2*t\n"
      "Material points/Points per cell = 4\n";
    expect("domains that change cells", messages<2>(bar, false), {});

    const std::string block =
      "Grid/Subdivisions = 4, 4\nQuadrature/Type = points\n";
    expect("a constant that is too large",
           messages<2>(block + "Boundary conditions/Displacement = bottom: "
                               "x=0, y=0; top: y = -1.5\n",
                       false),
           {"ERROR", "the very first step", "let it grow with t"});
  }

  void
  test_validation()
  {
    std::filesystem::remove_all("scene_checks");
    std::filesystem::create_directory("scene_checks");
    std::ofstream("scene_checks/statistics.txt") << "kept\n";
    messages<2>(good + "Checkpoint/Interval = 1\n");
    std::string line;
    std::getline(std::ifstream("scene_checks/statistics.txt") >> std::ws, line);
    test::check("validation writes nothing",
                line == "kept" &&
                  std::distance(std::filesystem::directory_iterator(
                                  "scene_checks"),
                                std::filesystem::directory_iterator()) == 1,
                line);
    std::filesystem::remove_all("scene_checks");
    std::filesystem::create_directory("scene_checks");
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  std::filesystem::create_directory("scene_checks");
  test_validation();
  test_overflow();
  test_touch();
  test_supports();
  test_loads();
  test_idle();
  test_formulas();
  test_meshes();
  test_small_mistakes();
  test_runs();
  return 0;
}
