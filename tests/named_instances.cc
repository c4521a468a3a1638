/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// More than one boundary condition or post-processor of a kind, in subsections
// with names: what they do, what is written, restarts, and messages.

#include <isochor/base/parameter_file.h>

#include <filesystem>

#include "../doc/plugins/elastic_bed.cc"
#include "scene.h"

using namespace isochor;
using namespace isochor::test;

namespace
{
  const MPI_Comm comm = MPI_COMM_WORLD;

  /** A block under its weight, four steps. */
  const std::string block = R"(
    subsection Grid
      set Subdivisions = 4, 4
      set Diagonals    = alternating
    end
    subsection Time
      set Step size = 0.25
      set Output interval = 0.25
    end
    subsection Boundary conditions
      set Displacement = bottom: x = 0, y = 0
      set Gravity = 0, -1*t
    end
    subsection Postprocess
      set Reactions = bottom
      set Point probes = tip: 1, 1
      set Write material points = false
    end
    subsection Output
      set Terminal = quiet
    end
  )";

  std::unique_ptr<MaterialPointMethod<2>>
  make(const std::string &text, const std::string &directory)
  {
    const std::string name = directory + ".prm";
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      std::ofstream(name) << text;
    MPI_Barrier(comm);
    const auto       statements = read_parameter_file(name, comm);
    ParameterHandler prm;
    MaterialPointMethod<2>::declare_parameters(prm,
                                               SceneSections::find(statements));
    apply_parameters(statements, prm);
    prm.enter_subsection("Output");
    prm.set("Directory", directory);
    prm.leave_subsection();
    create_output_directory(directory, comm);
    auto problem = std::make_unique<MaterialPointMethod<2>>(comm);
    problem->parse_parameters(prm);
    return problem;
  }

  std::string
  message(const std::string &text)
  {
    try
      {
        make(text, "error")->run();
      }
    catch (const std::exception &exception)
      {
        return one_line(exception.what());
      }
    return "no error";
  }

  void
  expect(const std::string              &what,
         const std::string              &text,
         const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      if (text.find(part) == std::string::npos)
        return check(what, false, text);
    check(what, true, "");
  }

  unsigned int
  n_files(const std::string &directory, const std::string &start)
  {
    unsigned int n = 0;
    for (const auto &file : std::filesystem::directory_iterator(directory))
      if (file.path().filename().string().rfind(start, 0) == 0 &&
          file.path().extension() == ".pvtu")
        ++n;
    return n;
  }



  void
  test_objects()
  {
    // half of the weight, and another half; a probe; grids less often
    const auto whole = make(block, "whole");
    whole->run();
    const std::string more = R"(
      subsection Boundary conditions: second half
        set Type    = Gravity
        set Gravity = 0, -0.5*t
      end
      subsection Postprocess: corner
        set Type         = Point probes
        set Point probes = tip: 0, 1
      end
      subsection Postprocess: rare
        set Type = Write grid
        set Output times per grid = 3
      end
    )";
    std::string       text = block;
    text.replace(text.find("-1*t"), 4, "-0.5*t");
    const auto halves = make(text + more, "halves");
    halves->run();
    const auto get = [](const auto &problem, const std::string &column) {
      return problem->last_statistics().get(column);
    };
    const std::string reaction = "Reaction y on bottom (N)";
    check_error("two halves of a weight",
                std::abs(get(halves, reaction) / get(whole, reaction) - 1),
                1e-10);
    check_error("probes of two post-processors",
                std::abs(get(halves, "Displacement y of tip (m)") -
                         get(halves, "corner: Displacement y of tip (m)")) /
                  std::abs(get(whole, "Displacement y of tip (m)")),
                1e-10);
    check("every output, and every third and the last",
          n_files("halves", "grid-0") == 4 &&
            n_files("halves", "grid-rare-0") == 2,
          std::to_string(n_files("halves", "grid-0")) + " and " +
            std::to_string(n_files("halves", "grid-rare-0")));

    // the effective parameters are a scene again
    std::ostringstream file;
    file << std::ifstream("halves.prm").rdbuf();
    const auto       statements = read_parameter_file("halves.prm", comm);
    ParameterHandler prm;
    MaterialPointMethod<2>::declare_parameters(prm,
                                               SceneSections::find(statements));
    apply_parameters(statements, prm);
    write_effective_parameters(prm, "again", comm);
    const auto written  = read_parameter_file("again/parameters.prm", comm);
    const auto sections = SceneSections::find(written);
    check("parameters in effect",
          sections.boundary_conditions.size() == 1 &&
            sections.boundary_conditions[0].type == "Gravity" &&
            sections.postprocessors.size() == 2,
          std::to_string(sections.postprocessors.size()));
  }



  void
  test_restart()
  {
    const std::string text = block + R"(
      subsection Boundary conditions: punch
        set Type                 = Surfaces of body
        set Surfaces of body     = top: y > 1 - 1e-9
        set Pressure on body     = top: 0.01*t
      end
      subsection Postprocess: corner
        set Type         = Point probes
        set Point probes = tip: 0, 1
      end
    )";
    // after each checkpoint the solver begins afresh
    const std::string first = R"(
      subsection Checkpoint
        set Interval = 2
      end
    )";
    const auto        whole = make(text + first, "run");
    whole->run();
    std::string half = text + first;
    half.replace(half.find("Step size = 0.25"),
                 16,
                 "End time = 0.5\nset Step size = 0.25");
    make(half, "resumed")->run();
    const auto resumed = make(text + first + R"(
      subsection Checkpoint
        set Resume = true
      end
    )",
                              "resumed");
    resumed->run();
    double error = 0;
    for (const std::string column :
         {"corner: Displacement y of tip (m)", "punch: Load y on top (N)"})
      add_error(error,
                std::abs(resumed->last_statistics().get(column) /
                           whole->last_statistics().get(column) -
                         1));
    check_error("restart", error, 1e-12);
  }



  void
  test_messages()
  {
    expect("section without a type",
           message(block + "subsection Postprocess: a\nset Reactions = left\n"
                           "end\n"),
           {"error.prm:", "<Postprocess: a/Type>"});
    expect("section without a name",
           message(block + "subsection Postprocess:\nset Type = Reactions\n"
                           "end\n"),
           {"needs a name", "<Postprocess: name>"});
    expect("unknown type",
           message(block + "subsection Postprocess: a\nset Type = Reaction\n"
                           "end\n"),
           {"Postprocess: a/Type", "Reaction", "Point probes"});
    expect("parameter of another type",
           message(block + "subsection Postprocess: a\nset Type = Reactions\n"
                           "set Reactons = left\nend\n"),
           {"Postprocess: a/Reactons",
            "did you mean",
            "<Postprocess: a/Reactions>",
            "There are in <Postprocess: a>:",
            "<Reactions>"});
    expect("parameter of a subsection of the type",
           message(block + "subsection Boundary conditions: bed\nset Type = "
                           "Elastic bed\nset Boundary = bottom\nend\n"),
           {"did you mean <Boundary conditions: bed/Elastic bed/Boundary>?"});
    expect("message of the object",
           message(block + "subsection Postprocess: a\nset Type = Reactions\n"
                           "set Reactions = roof\nend\n"),
           {"<Postprocess: a/Reactions>", "roof"});
    const std::string section = "subsection Postprocess: a\n"
                                "set Type = Reactions\n"
                                "set Reactions = left\nend\n";
    expect("two sections of the same name",
           message(block + section +
                   "subsection Postprocess: a\nset Reactions on = left\nend\n"),
           {"error.prm:26: there is a subsection <Postprocess: a> already, see "
            "error.prm:22"});
    std::ofstream("included.prm") << block + section;
    expect("a section of an included file may be changed",
           message("include included.prm\nsubsection Postprocess: a\n"
                   "set Reactions = right\nend\n"),
           {"no error"});
    expect("message of a named displacement",
           message(block + "subsection Boundary conditions: side\n"
                           "set Type = Displacement\n"
                           "set Displacement = roof: x = 0\nend\n"),
           {"<Boundary conditions: side/Displacement>", "roof"});
    expect("two displacements that contradict each other",
           message(block + "subsection Boundary conditions: side\n"
                           "set Type = Displacement\n"
                           "set Displacement = left: y = 1\nend\n"),
           {"<Boundary conditions: side/Displacement> and <Boundary "
            "conditions/Displacement> prescribe 1 displacement components"});
    const auto walls =
      make(block + "subsection Boundary conditions\nset Walls = top: n = 0\n"
                   "end\nsubsection Boundary conditions: other\n"
                   "set Type = Walls\nset Walls = top: n = 0.01*t\nend\n",
           "walls");
    walls->run();
    std::string apart;
    for (const auto &warning : walls->all_warnings().all())
      apart += one_line(warning.text) + "\n";
    expect("two walls of two sections",
           apart,
           {"<Boundary conditions/Walls = top> and <Boundary conditions: "
            "other/Walls = top> determine the same 5"});
    const auto  idle = make(block + "subsection Boundary conditions: punch\n"
                                    "set Type = Surfaces of body\n"
                                    "set Boundary points per face = 2\n"
                                    "end\n",
                           "idle");
    std::string warnings;
    for (const auto &warning : idle->all_warnings().all())
      warnings += one_line(warning.text) + "\n";
    expect("no effect",
           warnings,
           {"<Boundary conditions: punch/Boundary points per face"});
    const auto  lid = make(block + "subsection Rigid body: lid\n"
                                   "set Shape = half plane\n"
                                   "set Point = 0, 1.5\n"
                                   "set Normal = 0, -1\n"
                                   "set Radius = 2\nset Mass = 3\nend\n"
                                   "subsection Interaction: body - lid\n"
                                   "set Law = unilateral\n"
                                   "set Friction coefficient = 0.3\n"
                                   "set Displacement = x = 0\nend\n",
                          "lid");
    std::string of_lid;
    for (const auto &warning : lid->all_warnings().all())
      of_lid += one_line(warning.text) + "\n";
    expect("no effect at a rigid body",
           of_lid,
           {"<Rigid body: lid/Mass = 3>",
            "<Rigid body: lid/Radius = 2>",
            "<Interaction: body - lid/Friction coefficient = 0.3>",
            "<Interaction: body - lid/Displacement = x = 0>"});
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_objects();
  test_restart();
  test_messages();
  return 0;
}
