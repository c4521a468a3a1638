/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What users with a mistake are told: the program ends with a status other
// than zero, names the parameter or file, and says what is allowed.

#include <isochor/program/command_line.h>

#include <fstream>

#include "scene.h"

using namespace isochor;

/** As in main.cc, the problem is left in @p owner. */
template <int dim>
void
execute(ParameterHandler      &prm,
        const bool             validate_only,
        std::shared_ptr<void> &owner)
{
  const auto problem =
    std::make_shared<MaterialPointMethod<dim>>(MPI_COMM_WORLD);
  owner = problem;
  problem->parse_parameters(prm);
  if (!validate_only)
    problem->run();
}

/** A scene without a mistake, but for what @p lines change. */
std::string
scene(const std::string &lines)
{
  std::ofstream("base.prm")
    << "set Dimension = 2\n"
       "subsection Grid\nset Subdivisions = 2, 2\nend\n"
       "subsection Boundary conditions\nset Displacement = bottom: x = 0, "
       "y = 0\nend\n"
       "subsection Output\nset Directory = .\nset Terminal = quiet\nend\n";
  return "include base.prm\n" + lines;
}

/** Run the program on @p text and check that it ends with @p status and that
 * the message has all of @p words. */
void
test_scene(const std::string              &what,
           const std::string              &text,
           const int                       status,
           const std::vector<std::string> &words)
{
  std::ofstream("scene.prm") << text;
  std::shared_ptr<void> problem;
  Program               program;
  program.declare = [](auto &prm, const auto dim, const auto &statements) {
    const auto sections = SceneSections::find(statements);
    if (dim == 2)
      MaterialPointMethod<2>::declare_parameters(prm, sections);
    else
      MaterialPointMethod<3>::declare_parameters(prm, sections);
  };
  program.execute = [&](auto &prm, const auto dim, const bool validate_only) {
    if (dim == 2)
      execute<2>(prm, validate_only, problem);
    else
      execute<3>(prm, validate_only, problem);
  };
  const std::array<const char *, 2> argv = {{"isochor", "scene.prm"}};
  std::ostringstream                messages;
  std::streambuf *const original = std::cerr.rdbuf(messages.rdbuf());
  const int result = run_command_line(argv.size(), argv.data(), program);
  std::cerr.rdbuf(original);

  const std::string message = test::one_line(messages.str());
  std::string       missing;
  for (const std::string &word : words)
    if (message.find(word) == std::string::npos)
      missing += " <" + word + ">";
  const bool noisy = message.find("Stacktrace") != std::string::npos ||
                     message.find("violated") != std::string::npos;
  test::check(what,
              result == status && missing.empty() && !noisy,
              "status " + std::to_string(result) + ", missing" + missing +
                (noisy ? ", for programmers" : "") + ": " + message);
}

void
test_entry(const std::string              &what,
           const std::string              &subsection,
           const std::string              &entry,
           const std::vector<std::string> &words)
{
  test_scene(what,
             scene("subsection " + subsection + "\nset " + entry + "\nend\n"),
             1,
             words);
}

/** Of two entries of one name one was ignored. */
void
test_names_given_twice(const std::string &loads)
{
  const std::string pressures =
    "Pressure on body = s: 1; s: 2\nset Surfaces of body = s: left";
  const std::vector<std::array<std::string, 3>> cases = {
    {{loads, "Surfaces of body = s: left; s: right", "<s>"}},
    {{loads, "Traction = left: 1, 0; left: 0, 1", "<left>"}},
    {{loads, pressures, "<s>"}},
    {{loads, "Walls = left: n = 0; left: n >= 0", "<left>"}},
    {{loads, "Periodic sides = left: right; left: right, x = t", "<right>"}},
    {{"Postprocess", "Exact stress = xx: 0; xx: x", "<xx>"}},
    {{"Postprocess", "Reactions = left, right, left", "<left>"}},
    {{"Adaptive grid",
      "Cell size at boundaries = left: 0.1; left: 0.2",
      "<left>"}}};
  for (const auto &c : cases)
    test_entry("a name given twice: " + c[1].substr(0, c[1].find('\n')),
               c[0],
               c[1],
               {c[0], c[2], "twice"});
  test_entry("a parameter that is gone",
             loads,
             "Rigid sides = top: x = 0",
             {"<" + loads + "/Rigid sides> is gone",
              "subsection Rigid body: ",
              "subsection Interaction: "});
  test_scene("a rigid body that nothing meets",
             scene("subsection Rigid body: ball\nset Shape = circle\nset "
                   "Centre = 0.5, 2\nset Radius = 0.4\nend\n"),
             1,
             {"<Rigid body: ball>", "that nothing meets"});
  std::ofstream("groups.msh") << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                                 "$PhysicalNames\n2\n1 1 \"base\"\n1 2 "
                                 "\"base\"\n$EndPhysicalNames\n$Nodes\n3\n"
                                 "1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
                                 "$Elements\n3\n1 1 2 1 1 1 2\n"
                                 "2 1 2 2 2 2 3\n3 2 2 0 1 1 2 3\n"
                                 "$EndElements\n";
  test_scene("two physical groups of one name",
             scene("subsection Grid\nset Type = gmsh\nset File = groups.msh\n"
                   "end\n"),
             1,
             {"groups.msh", "two physical groups <base>"});
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string loads = "Boundary conditions", points = "Material points";

  test_scene("no mistake", scene(""), 0, {});
  test_scene("an exception in the middle of a grid of p4est",
             scene("subsection Grid\nset Type = adaptive\nend\n"
                   "subsection Adaptive grid\nset Maximum level = 2\n"
                   "set Cell size = 0.1*(x-2)\nend\n"),
             1,
             {"<Adaptive grid/Cell size>", "sizes must be positive"});
  test_scene("the mark of UTF-8", "\xEF\xBB\xBF" + scene(""), 0, {});

  test_entry("unknown parameter",
             "Material",
             "Poissons ratio = 0.3",
             {"Poissons ratio", "Poisson ratio"});
  test_entry("unknown subsection", "Materiel", "Model = J2", {"Materiel"});
  test_entry("subsection of an earlier version",
             "Ghost penalty",
             "Use = never",
             {"Ghost penalty", "Cut cells/Extension"});
  test_entry("a quadrature of earlier versions",
             "Quadrature",
             "Type = cell-filled",
             {"is gone", "<Quadrature/Type = CPDI>"});
  test_entry("domains of earlier versions",
             "Material points",
             "Domains = always",
             {"<Material points/Domains> is gone", "leave it out"});
  test_entry("displacements of the body",
             "Boundary conditions",
             "Displacement of body = top: x=0, y=t; bottom: y=0",
             {"<Boundary conditions/Displacement of body> is gone",
              "subsection Interaction: top - place",
              "set Displacement = x=0, y=t",
              "subsection Interaction: bottom - place",
              "set Displacement = y=0"});
  test_entry("their penalty",
             "Boundary conditions",
             "Penalty of body displacement = 10",
             {"is gone: leave it out"});
  test_entry("the surface of an interaction",
             "Interaction: body - place",
             "Surface = y > 0.9",
             {"set Surfaces of body = NAME: y > 0.9",
              "<Interaction: NAME - place>"});
  test_entry("not a number", "Material", "Young modulus = soft", {"soft"});
  test_entry("too large Poisson ratio",
             "Material",
             "Poisson ratio = 0.51",
             {"Poisson ratio", "at most 0.5", "0.51"});
  test_entry("too small Poisson ratio",
             "Material",
             "Poisson ratio = -1",
             {"Poisson ratio", "greater than -1"});
  test_entry("no stiffness",
             "Material",
             "Young modulus = 0",
             {"Young modulus", "positive"});
  test_entry("negative density", "Material", "Density = -1", {"Density"});
  test_entry("unknown material", "Material", "Model = Hooke", {"Hooke", "J2"});
  test_scene("incompressible in the u form",
             scene("subsection Material\nset Poisson ratio = 0.5\nend\n"
                   "subsection Formulation\nset Type = u\nend\n"),
             1,
             {"Material/Poisson ratio", "0.5", "Formulation/Type = u-p"});

  test_scene("a parameter of earlier versions",
             scene("subsection Formulation\n"
                   "set Project volume change = true\nend\n"),
             1,
             {"Formulation/Project volume change", "is gone"});
  test_scene("levels in the wrong order",
             scene("subsection Adaptive grid\nset Minimum level = 3\n"
                   "set Maximum level = 2\nend\n"),
             1,
             {"Adaptive grid/Minimum level", "Adaptive grid/Maximum level"});
  test_scene("splitting without end",
             scene("subsection Material points\n"
                   "set Split at share of cell = 0.01\nend\n"),
             1,
             {"Material points/Split at share of cell", "0.1"});

  test_scene("missing mesh",
             scene("subsection Grid\nset Type = gmsh\nset File = none.msh\n"
                   "end\n"),
             1,
             {"none.msh", "Grid/File"});
  std::ofstream("broken.msh") << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                                 "$Nodes\n3\n1 0 0 0\n";
  test_scene("broken mesh",
             scene("subsection Grid\nset Type = gmsh\nset File = broken.msh\n"
                   "end\n"),
             1,
             {"broken.msh", "Grid/File", "gmsh"});
  std::ofstream("text.msh") << "This is no mesh.\n";
  test_scene("no mesh",
             scene("subsection Grid\nset Type = gmsh\nset File = text.msh\n"
                   "end\n"),
             1,
             {"text.msh", "Grid/File", "gmsh"});
  test_entry("box turned inside out",
             "Grid",
             "Upper corner = 0, 1",
             {"Grid/Upper corner", "Grid/Lower corner"});

  test_entry("no points", points, "Region = x > 2", {points, "Grid"});
  test_entry("no such rule",
             points,
             "Points per cell = 5",
             {"Points per cell", "into 5 equal parts", "Choose 1, 3, 4, 6, 9"});
  const std::string five = "subsection Material points\n"
                           "set Points per cell = 5\nend\n";
  test_scene("an adaptive grid without subdomains",
             scene("subsection Grid\nset Type = adaptive\nend\n"
                   "subsection Quadrature\nset Type = points\nend\n"),
             1,
             {"Quadrature/Type = points", "CPDI", "Grid/Type"});
  test_scene("no such rule for points without domains",
             scene(five + "subsection Quadrature\nset Type = points\nend\n"),
             1,
             {"5 material points", "Points per cell", "Choose 1, 3, 4, 6, 7"});
  test_entry("no such rule in a zone",
             points,
             "Points per cell in zones = 7: x > 0.5",
             {"per cell in zones", "into 7 equal parts", "Choose 1, 3, 4, 6"});
  test_entry("missing body mesh",
             points,
             "Body mesh = none.msh",
             {"none.msh", "Material points/Body mesh"});
  test_entry("wrong formula",
             points,
             "Region = x > ",
             {"Material points/Region", "x >"});
  for (const std::string separator : {",", ";"})
    test_entry("conditions separated by '" + separator + "'",
               points,
               "Region = x < 1" + separator + " y < 0.5",
               {"Material points/Region", "'" + separator + "'", "'&&'"});
  test_entry("a grid that is elsewhere at the start",
             "Grid",
             "Stretch = y: 0 -> 0, 1 -> 1 - 0.1*t",
             {"Grid/Stretch", "is 1 m at t = 0"});

  test_entry("unknown boundary",
             loads,
             "Displacement = botom: x = 0",
             {"botom", "bottom", "left", "Boundary conditions/Displacement"});
  test_entry("unknown boundary of a load",
             loads,
             "Traction = roof: 0, 1",
             {"roof", "top", "Boundary conditions/Traction"});
  test_entry("unknown boundary of a surface of the body",
             loads,
             "Surfaces of body = s: botom\nset Pressure on body = s: 1",
             {"Surfaces of body", "<botom>", "bottom, left, right, top"});
  test_entry("unknown boundary of a reaction",
             "Postprocess",
             "Reactions = roof",
             {"roof", "top", "Postprocess/Reactions"});
  test_names_given_twice(loads);
  test_scene("a wall without subdomains",
             scene("subsection Quadrature\nset Type = points\nend\n"
                   "subsection Boundary conditions\nset Walls = top: n >= 0\n"
                   "end\n"),
             1,
             {"<top: n >= ...>", "<Quadrature/Type = CPDI>"});
  test_entry("wrong component",
             loads,
             "Displacement = bottom: z = 0",
             {"z = 0", "Boundary conditions/Displacement"});
  test_entry("wrong number of components",
             loads,
             "Gravity = 1",
             {"Boundary conditions/Gravity", "2 components"});

  test_entry("absurd load",
             loads,
             "Gravity = 0, -1e9",
             {"can't be cut back further", "Minimum step size"});
  test_scene("inverted points",
             scene("subsection Boundary conditions\nset Displacement = "
                   "bottom: x = 0, y = 0; top: x = 0, y = -1.5*t\nend\n"
                   "subsection Time\nset Minimum step size = 1\nend\n"),
             1,
             {"can't be cut back further", "inside out"});
  test_entry("a number with a unit",
             "Material",
             "Young modulus = 1e6 Pa",
             {"Young modulus", "without a unit"});
  test_entry("a decimal comma",
             "Material",
             "Young modulus = 1,5e6",
             {"Young modulus", "decimals are written with a point"});
  test_scene("body that nothing holds",
             scene("subsection Boundary conditions\nset Displacement = \n"
                   "set Gravity = 0, -1\nend\n"),
             1,
             {"singular", "hold"});
  test_scene("body that leaves the grid",
             scene("subsection Boundary conditions\n"
                   "set Displacement = everywhere: x = 0, y = 2*t\nend\n"
                   "subsection Time\nset Step size = 0.5\nend\n"),
             1,
             {"left the background grid", "Enlarge"});
  return 0;
}
