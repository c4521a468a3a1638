/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The command line and the parameter file in front of a stub program.

#include <deal.II/base/mpi.h>

#include <isochor/base/edit_distance.h>
#include <isochor/base/file_names.h>
#include <isochor/program/command_line.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "command_line_stub.h"

using namespace isochor;

namespace
{
  /** With one blank for several, by which ParameterHandler aligns. */
  std::string
  squeezed(const std::string &text)
  {
    std::string result;
    for (const char c : text)
      if (c != ' ' || (!result.empty() && result.back() != ' '))
        result += c;
    return result;
  }


  void
  test_edit_distance()
  {
    // the textbook examples
    const bool ok = edit_distance("kitten", "sitting") == 3 &&
                    edit_distance("saturday", "sunday") == 3 &&
                    edit_distance("", "abc") == 3 &&
                    edit_distance("abc", "") == 3 &&
                    edit_distance("Poisson", "poisson") == 0;
    check("edit distance", ok, "");
  }



  void
  test_unknown_names()
  {
    write("name.prm", "subsection Material\n  set Poison ratio = 0.2\nend\n");
    check_error("misspelt parameter",
                {"name.prm"},
                "name.prm:2: unknown parameter <Material/Poison ratio>; did "
                "you mean <Material/Poisson ratio>?");
    write("section.prm", "\nsubsection Newton\n set Poisson ratio = 0.2\nend");
    check_error("parameter of another subsection",
                {"section.prm"},
                "section.prm:3: unknown parameter <Newton/Poisson ratio>; did "
                "you mean <Material/Poisson ratio>?");
    write("nosection.prm", "set Maximum cut = 3");
    check_error("parameter without its subsections",
                {"nosection.prm"},
                "nosection.prm:1: unknown parameter <Maximum cut>; did you "
                "mean <Newton/Line search/Maximum cuts>?");
    write("subsection.prm", "subsection Newtom\nend\n");
    check_error("misspelt subsection",
                {"subsection.prm"},
                "subsection.prm:1: unknown subsection <Newtom>; did you mean "
                "<Newton>?");
    write("kind.prm", "set Newton = 3\n");
    check_error("subsection taken for a parameter",
                {"kind.prm"},
                "kind.prm:1: <Newton> is a subsection, not a parameter");
    write("kind2.prm", "subsection Dimension\nend\n");
    check_error("parameter taken for a subsection",
                {"kind2.prm"},
                "kind2.prm:1: <Dimension> is a parameter, not a subsection");
  }



  void
  test_values()
  {
    write("value.prm", "subsection Material\n  set Poisson ratio = 0.7\nend");
    check_error("value out of its range",
                {"value.prm"},
                "value.prm:2: the value <0.7> of the parameter "
                "<Material/Poisson ratio> is not allowed; allowed is "
                "[Double -1...0.5 (inclusive)]");
    check_parameter("a value that is replaced need not be allowed",
                    {"value.prm", "--set=Material/Poisson ratio=0.4"},
                    "set Poisson ratio = 0.4");
    write("dim.prm", "set Dimension = 4\nset Nonsense = 1");
    check_error("illegal dimension",
                {"dim.prm"},
                "dim.prm:1: the value <4> of the parameter <Dimension> is not "
                "allowed; allowed is [Selection 2|3 ]");
  }



  void
  test_syntax()
  {
    write("syntax.prm", "sett Dimension = 3");
    check_error("no statement",
                {"syntax.prm"},
                "syntax.prm:1: cannot understand <sett Dimension = 3>; legal "
                "lines are 'set Entry = value', 'subsection Name', 'end', "
                "'include file.prm' and comments after '#'");
    write("equals.prm", "set Dimension 3");
    check_error("no equals sign",
                {"equals.prm"},
                "equals.prm:1: expected 'set Entry = value', got "
                "<set Dimension 3>");
    write("open.prm", "subsection Material\nsubsection Newton\nend\n# no end");
    check_error("subsection that isn't left",
                {"open.prm"},
                "open.prm:1: the subsection <Material> has no 'end' in this "
                "file");
    write("end.prm", "subsection Material\nend\nend\n");
    check_error("end too many",
                {"end.prm"},
                "end.prm:3: 'end' without a subsection in this file");
    write("continued.prm", "\nset Dimension = \\\n");
    check_error("continued by nothing",
                {"continued.prm"},
                "continued.prm:2: the file ends in a line to be continued");
    write("layout.prm",
          "# comment\n\tSUBSECTION  Material # so\r\n set Poisson ratio "
          "=\\\n 0.\\\n25 # = 1/4\nEND\n");
    check_parameter("comments, blanks, joined lines",
                    {"layout.prm"},
                    "set Poisson ratio = 0.25");
  }



  void
  test_include()
  {
    write("base/base.prm", "set Dimension = 3\ninclude parts/newton.prm\n");
    write("base/parts/newton.prm",
          "subsection Newton\n  set Tolerance = 1e-4\n"
          "  include ../cuts.prm\nend\n");
    write("base/cuts.prm",
          "subsection Line search\n  set Maximum cuts = 7\nend\n");
    write("scene/scene.prm",
          "include ../base/base.prm\nsubsection Newton\n"
          "  set Tolerance = 1e-5\nend\n");
    check_parameter("include relative to the file, in a subsection",
                    {"scene/scene.prm"},
                    "set Maximum cuts = 7");
    check_parameter("the last value wins",
                    {"scene/scene.prm"},
                    "set Tolerance = 1e-5");
    const Result r = run({"scene/scene.prm"});
    check("included dimension", r.dim == 3, describe(r));

    write("twice.prm",
          "include base/base.prm\nsubsection Newton\n  set Tolerance = 1e-5\n"
          "end\nsubsection Newton\n  set Tolerance = 1e-6\nend\n");
    check_error("a parameter that is set twice in one file",
                {"twice.prm"},
                "twice.prm:6: the parameter <Newton/Tolerance> is set for the "
                "second time in this file, after twice.prm:3; leave one of the "
                "two out");

    write("base/bad.prm", "\nset Dimensoin = 2\n");
    write("scene/bad.prm", "include ../base/bad.prm\n");
    check_error("error in an included file",
                {"scene/bad.prm"},
                "base/bad.prm:2: unknown parameter <Dimensoin>; did you mean "
                "<Dimension>?");
    write("a.prm", "# cyclic\ninclude base/b.prm\n");
    write("base/b.prm", "include ../a.prm\n");
    check_error("cyclic include",
                {"a.prm"},
                "base/b.prm:1: cyclic include, the file <a.prm> is being read "
                "already");
    write("lost.prm", "\ninclude nowhere.prm\n");
    check_error("missing included file",
                {"lost.prm"},
                "lost.prm:2: the parameter file <nowhere.prm> does not exist");
    write("unbalanced.prm", "subsection Newton\ninclude base/end.prm\nend\n");
    write("base/end.prm", "end\n");
    check_error("included file leaves a subsection",
                {"unbalanced.prm"},
                "base/end.prm:1: 'end' without a subsection in this file");
    check_error("missing file",
                {"nothing.prm"},
                "the parameter file <nothing.prm> does not exist");
    check_error("directory for a file",
                {"base"},
                "the parameter file <base> is a directory");
  }



  void
  test_overrides()
  {
    write("good.prm", "subsection Material\n  set Poisson ratio = 0.2\nend\n");
    check_parameter("scene", {"good.prm"}, "set Poisson ratio = 0.2");
    check_parameter("override",
                    {"good.prm", "--set", "Material/Poisson ratio=0.499"},
                    "set Poisson ratio = 0.499");
    check_parameter("override in one word, with blanks",
                    {"--set= Material / Poisson ratio = 0.4 ", "good.prm"},
                    "set Poisson ratio = 0.4");
    check_parameter("the last override wins",
                    {"--set=Newton/Line search/Maximum cuts=8",
                     "--set=Newton/Line search/Maximum cuts=9",
                     "good.prm"},
                    "set Maximum cuts = 9");
    check_parameter("output directory",
                    {"--output-directory", "runs/a=b", "good.prm"},
                    "set Directory = runs/a=b");
    check_parameter("restart", {"good.prm", "--restart"}, "set Resume = true");
    check_parameter("parameter of 3D only",
                    {"good.prm",
                     "--set=Output/Slice normal=1,0,0",
                     "--set=Dimension=3"},
                    "set Slice normal = 1,0,0");
    check_error("parameter of 3D in 2D",
                {"good.prm", "--set=Output/Slice normal=1,0,0"},
                "option --set: unknown parameter <Output/Slice normal>; did "
                "you mean <Output/Directory>?");
    check_error("misspelt override",
                {"good.prm", "--set=Materials/poison ratio=0.4"},
                "option --set: unknown parameter <Materials/poison ratio>; did "
                "you mean <Material/Poisson ratio>?");
    check_error("bad value of an override",
                {"good.prm", "--restart", "--set=Checkpoint/Resume=perhaps"},
                "option --set: the value <perhaps> of the parameter "
                "<Checkpoint/Resume> is not allowed; allowed is [Bool]");
    check_error("override without value",
                {"good.prm", "--set", "Dimension"},
                "option --set: expected 'Section/Entry=value', got <Dimension>",
                2);
    check_error("override with an empty name",
                {"good.prm", "--set=Material//Model=J2"},
                "option --set: empty name in the path <Material//Model>",
                2);
  }



  void
  test_file_names()
  {
    for (const std::string file : {"a.msh", "files/a.msh"}) // of an earlier run
      std::filesystem::remove(file);
    write("files/scene.prm", "subsection Grid\n  set File = a.msh\nend\n");
    write("includes.prm", "include files/scene.prm\n");
    check_parameter("a file relative to the parameter file that names it",
                    {"includes.prm"},
                    "set File = files/a.msh");
    check_parameter("a file of an override",
                    {"includes.prm", "--set=Grid/File=b/../a.msh"},
                    "set File = b/../a.msh");

    write("a.msh", "");
    const std::string which =
      ". To say which: --set \"Grid/File=a.msh\", relative to the working "
      "directory, or an absolute path";
    check_error("a file in the working directory",
                {"files/scene.prm"},
                "files/scene.prm:2: the file <a.msh> of the parameter "
                "<Grid/File> is relative to the parameter file: "
                "<files/a.msh>, which does not exist, but there is one in the "
                "working directory" +
                  which);
    write("files/a.msh", "");
    check_error("a file in both places",
                {"files/scene.prm"},
                "files/scene.prm:2: the file <a.msh> of the parameter "
                "<Grid/File> is relative to the parameter file: "
                "<files/a.msh>, but there is one in the working directory, "
                "too" +
                  which);
    write("scene.prm", "subsection Grid\n  set File = a.msh\nend\n");
    check_parameter("a parameter file in the working directory",
                    {"scene.prm"},
                    "set File = a.msh");

    ParameterHandler prm;
    declare(prm, 2, {});
    apply_parameters({parse_override("Grid/File=a.msh", "test")}, prm);
    make_file_names_absolute(prm);
    prm.enter_subsection("Grid");
    const std::string absolute = prm.get("File");
    check("absolute names of files",
          absolute == std::filesystem::absolute("a.msh").string(),
          absolute);
  }



  void
  test_materials()
  {
    write("materials.prm",
          "subsection Material 3\n  set Poisson ratio = 0.1\nend\n"
          "subsection Material 2\nend\n");
    check_parameter("numbered materials",
                    {"materials.prm"},
                    "set Poisson ratio = 0.1");
    const Result r = run({"materials.prm", "--set=Material 4/Model=J2"});
    check("an override adds a material",
          r.status == 0 && contains(r.parameters, "subsection Material 4\n") &&
            !contains(r.parameters, "subsection Material 5\n"),
          describe(r));
    write("gap.prm", "\nsubsection Material 3\nend\n");
    check_error("gap in the numbers",
                {"gap.prm"},
                "gap.prm:2: there is a subsection <Material 3> but no "
                "<Material 2>; number them without gaps");
    write("one.prm", "subsection Material 1\nend\n");
    check_error("the first has no number",
                {"one.prm"},
                "one.prm:1: unknown subsection <Material 1>; did you mean "
                "<Material>?");
  }



  void
  test_options()
  {
    check_error("unknown option",
                {"--validat", "good.prm"},
                "unknown option <--validat>; did you mean --validate?",
                2);
    check_error("no scene", {"--quiet"}, "no parameter file given", 2);
    check_error("two scenes",
                {"good.prm", "a.prm"},
                "more than one parameter file given: <good.prm> and <a.prm>",
                2);
    check_error("option without its value",
                {"good.prm", "--output-directory"},
                "the option --output-directory needs a value",
                2);
    check_error("value for an option that has none",
                {"good.prm", "--quiet=1"},
                "the option --quiet takes no value, got <--quiet=1>",
                2);

    const Result validated = run({"--validate", "good.prm"});
    check("validate",
          validated.status == 0 && validated.validate_only &&
            validated.n_executions == 1 &&
            contains(validated.out, "good.prm: valid\n") == is_root(),
          describe(validated));
    const Result executed = run({"good.prm"});
    check("run",
          executed.status == 0 && !executed.validate_only &&
            executed.out == (is_root() ? "running\n" : ""),
          describe(executed));
    const Result quiet = run({"good.prm", "--quiet"});
    check("quiet",
          quiet.status == 0 && quiet.n_executions == 1 && quiet.out.empty(),
          describe(quiet));
    const Result help = run({"--help"});
    check("help",
          help.status == 0 && help.n_executions == 0 &&
            contains(help.out, "--print-parameters") == is_root(),
          describe(help));
    const Result version = run({"--version"});
    check("version",
          version.status == 0 &&
            contains(version.out,
                     "deal.II " + std::string(DEAL_II_PACKAGE_VERSION)) ==
              is_root() &&
            contains(version.out, "Isochor " ISOCHOR_VERSION "\n") == is_root(),
          describe(version));
  }



  void
  test_failing_runs()
  {
    const Result r = run({"good.prm"}, []() {
      AssertThrow(false, ExcMessage("the body left the grid"));
    });
    check("message of a run that fails",
          r.status == 1 &&
            r.err ==
              (is_root() ? "isochor: error: the body left the grid\n" : ""),
          describe(r));
    const Result defect =
      run({"good.prm"}, []() { AssertThrow(false, ExcIndexRange(5, 0, 3)); });
    check("a defect names its place",
          defect.status == 1 &&
            contains(defect.err, "command_line.cc") == is_root(),
          describe(defect));
  }

  void
  test_printed_parameters()
  {
    const Result defaults = run({"--print-parameters"});
    check("default parameters",
          defaults.status == 0 && defaults.n_executions == 0 &&
            contains(squeezed(defaults.out),
                     "# Ratio of the transverse contraction.\n"
                     " set Poisson ratio = 0.3\n") == is_root() &&
            contains(squeezed(defaults.out),
                     "# One of: Hencky, J2\n set Model = Hencky\n") ==
              is_root() &&
            contains(squeezed(defaults.out),
                     "# subsection Rigid body: <name>\n# set Shape = circle\n"
                     "# end\n") == is_root() &&
            !contains(defaults.out, "Slice normal"),
          describe(defaults));

    const Result in_3d =
      run({"--print-parameters", "--set=Dimension=3", "materials.prm"});
    write("printed.prm", in_3d.out);
    const Result original = run({"materials.prm", "--set=Dimension=3"});
    const Result again    = run({"printed.prm"});
    check("printed parameters can be run",
          in_3d.status == 0 && again.status == 0 && again.dim == 3 &&
            contains(again.parameters, "subsection Material 3\n") &&
            again.parameters == original.parameters,
          describe(in_3d) + describe(again));
  }

  void
  test_effective_parameters()
  {
    ParameterHandler prm;
    prm.declare_entry("Dimension", "2", Patterns::Selection("2|3"));
    declare(prm, 2, {});
    apply_parameters({parse_override("Newton/Tolerance=1e-3", "test")}, prm);
    write_effective_parameters(prm, "new/directory");
    check_parameter("effective parameters can be run",
                    {"new/directory/parameters.prm"},
                    "set Tolerance = 1e-3");

    const auto message_for = [&](const std::string &directory) {
      try
        {
          write_effective_parameters(prm, directory);
        }
      catch (const ParameterError &error)
        {
          return std::string(error.what());
        }
      return std::string("no error");
    };
    std::string message = message_for("good.prm/results");
    check("directory that can't be created",
          message.rfind("cannot create the output directory "
                        "<good.prm/results>: ",
                        0) == 0,
          message);
    message = message_for("good.prm");
    check("file in the place of the directory",
          message.rfind("cannot create the output directory <good.prm>: ", 0) ==
            0,
          message);
    write("full/parameters.prm/x", "");
    message = message_for("full");
    check("file that can't be written",
          message == "cannot write <full/parameters.prm>; is the output "
                     "directory writable?",
          message);
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_edit_distance();
  test_unknown_names();
  test_values();
  test_syntax();
  test_include();
  test_overrides();
  test_file_names();
  test_materials();
  test_options();
  test_failing_runs();
  test_printed_parameters();
  test_effective_parameters();
  return 0;
}
