/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A run that is interrupted and resumed must equal the uninterrupted one bit by
// bit: statistics, all that the points carry, and the files of fields. Broken
// checkpoints and those of other problems must not be taken.


#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "../doc/plugins/elastic_bed.cc"
#include "checkpoint_scene.h"

using namespace isochor;

namespace
{

  /** Ends a run in the middle, after the outputs of a step and before its
   * checkpoint. */
  unsigned int crash_after_step = numbers::invalid_unsigned_int;

  template <int dim>
  class Crash : public Postprocessor<dim>
  {
  public:
    void
    evaluate_points(const StepResult<dim> &result, Statistics &) override
    {
      AssertThrow(result.time.step != crash_after_step, ExcMessage("crash"));
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Crash, "Z: after all others")

  /** Knows nothing, but has the first of all names. */
  template <int dim>
  class Newcomer : public Postprocessor<dim>
  {};

  template <int dim>
  class OtherNewcomer : public BoundaryCondition<dim>
  {};

  std::string
  contents(const std::string &file_name)
  {
    std::ifstream file(file_name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file),
            std::istreambuf_iterator<char>()};
  }



  void
  write(const std::string &file_name, const std::string &data)
  {
    std::ofstream(file_name, std::ios::binary) << data;
  }



  void
  report(const std::string &name, const bool success, const std::string &why)
  {
    const bool everywhere =
      Utilities::MPI::min(static_cast<unsigned int>(success), MPI_COMM_WORLD) ==
      1;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << name << ": " << (everywhere ? "OK" : "FAILED " + why)
                << std::endl;
  }



  void
  compare(const std::string &name,
          const Result      &result,
          const std::string &directory,
          const Result      &reference,
          const std::string &reference_directory)
  {
    std::string why = result.error;
    if (!(result.points == reference.points))
      why += " points differ;";
    for (const char *file :
         {"statistics.txt", "points-00004.0000.vtu", "grid-00004.0000.vtu"})
      {
        const std::string expected = contents(reference_directory + "/" + file);
        if (expected.empty() || contents(directory + "/" + file) != expected)
          why += std::string(" ") + file + " differs;";
      }
    report(name, why.empty(), why);
  }



  void
  expect_error(const std::string &name,
               const Result      &result,
               const std::string &part)
  {
    report(name,
           result.error.find(part) != std::string::npos,
           "<" + result.error + ">");
  }



  /** The checkpoint file of this rank. */
  std::string
  checkpoint(const std::string &directory, const unsigned int slot)
  {
    return directory + "/checkpoint-" + std::to_string(slot) + "." +
           Utilities::int_to_string(
             Utilities::MPI::this_mpi_process(MPI_COMM_WORLD), 4) +
           ".bin";
  }
} // namespace



/** Interrupted and resumed in the middle of an interval in which the grid is
 * kept: it is put back before the steps 1, 4 and 7, the checkpoint is that
 * after step 4. */
void
test_kept_grid(const MPI_Comm comm)
{
  for (const std::string type : {"CPDI"})
    {
      const std::vector<std::pair<std::string, std::string>> lazy = {
        {"Grid reset/Steps between resets", "3"},
        {"Grid reset/Smallest element quality", "0"},
        {"Quadrature/Type", type},
        {"Material points/Points per cell", "4"},
        {"Boundary conditions/Surfaces of body", "all: 1"},
        {"Boundary conditions/Traction on body", "all: 500, 0"},
        {"Boundary conditions/Pressure on body", "all: 200*t"}};
      const std::string a = "checkpoint-kept-a", b = "checkpoint-kept-b";
      const Result      whole = run(comm, a, lazy);
      report("kept grid, uninterrupted, " + type,
             whole.error.empty(),
             whole.error);
      crash_after_step = 5;
      expect_error("kept grid, interrupted, " + type,
                   run(comm, b, lazy),
                   "crash");
      crash_after_step = numbers::invalid_unsigned_int;
      auto again       = lazy;
      again.emplace_back("Checkpoint/Resume", "true");
      compare("kept grid, resumed, " + type, run(comm, b, again), b, whole, a);
    }
}



/** Walls, a rigid body and periodic sides remember where they are, and a bed of
 * springs which nodes it has, on a grid that is put back every third step. */
void
test_linear_equations(const MPI_Comm comm)
{
  std::vector<std::pair<std::string, std::string>> scene = {
    {"Grid/Lower corner", "1.2, 1"},
    {"Grid/Upper corner", "2.2, 2.4"},
    {"Grid/Subdivisions", "5, 7"},
    {"Material/Young modulus", "1e6"},
    {"Dynamics/Initial velocity", "0.1*(y-1), 0"},
    {"Grid reset/Steps between resets", "3"},
    {"Boundary conditions/Displacement", ""},
    // the bed forgets its forces after each step, which makes energy
    {"Postprocess/Write energies", "never"},
    {"Quadrature/Type", "CPDI"},
    {"Boundary conditions/Walls", "bottom: n >= -0.005"},
    {"Boundary conditions/Elastic bed/Boundary", "left"},
    {"Boundary conditions/Elastic bed/Stiffness", "1e4"},
    {"Quadrature/Type", "CPDI"},
    {"Rigid body: lid/Shape", "half plane"},
    {"Rigid body: lid/Point", "1.7, 2.4"},
    {"Rigid body: lid/Free", "y, rotation"},
    {"Rigid body: lid/Mass", "10"},
    {"Rigid body: lid/Moment of inertia", "1"},
    {"Rigid body: lid/Force", "y = -200*t"},
    {"Rigid body: lid/Moment", "rotation = 20*t"},
    {"Boundary conditions/Surfaces of body", "top: y > 2.39"},
    {"Interaction: top - lid/Law", "tie"}};
  for (const std::string periodic : {"", "left: right"})
    {
      scene.emplace_back("Boundary conditions/Periodic sides", periodic);
      const std::string a = "checkpoint-linear-a", b = "checkpoint-linear-b",
                        name =
                          "linear equations" +
                          std::string(periodic.empty() ? "" : ", periodic");
      const Result whole = run(comm, a, scene);
      report(name + ", uninterrupted", whole.error.empty(), whole.error);
      crash_after_step = 5;
      expect_error(name + ", interrupted", run(comm, b, scene), "crash");
      crash_after_step = numbers::invalid_unsigned_int;
      auto again       = scene;
      again.emplace_back("Checkpoint/Resume", "true");
      compare(name + ", resumed", run(comm, b, again), b, whole, a);
    }
}



/** A body falls on a wall below it and touches it, one side after the other,
 * before and after the interruption: distances and contact must go on. */
void
test_contact(const MPI_Comm comm)
{
  const std::vector<std::pair<std::string, std::string>> falling = {
    {"Material points/Region", "y < 1"},
    // further from the wall, which lies below the grid, than three per cell
    {"Material points/Points per cell", "4"},
    {"Postprocess/Point probes", "low: 1.7, 0.1"},
    {"Dynamics/Initial velocity", "0, -0.1"},
    {"Postprocess/Point probes", "centre: 1.7, 0.7"},
    {"Boundary conditions/Displacement", "left: x=0; right: x=0"},
    {"Quadrature/Type", "CPDI"},
    {"Boundary conditions/Walls", "bottom: n >= -0.005*(1+x)"}};
  const std::string a = "checkpoint-contact-a", b = "checkpoint-contact-b";
  const Result      whole = run(comm, a, falling);
  report("contact, uninterrupted", whole.error.empty(), whole.error);
  crash_after_step = 5;
  expect_error("contact, interrupted", run(comm, b, falling), "crash");
  crash_after_step = numbers::invalid_unsigned_int;
  auto again       = falling;
  again.emplace_back("Checkpoint/Resume", "true");
  compare("contact, resumed", run(comm, b, again), b, whole, a);
}



/** Points are split at first, and again, after the interruption, as the cells
 * become smaller: the new ones must get the same numbers. */
void
test_split_points(const MPI_Comm comm)
{
  const std::vector<std::pair<std::string, std::string>> shrinking = {
    {"Quadrature/Type", "CPDI"},
    {"Material points/Points per cell", "4"},
    {"Material points/Split at share of cell", "0.3"},
    {"Grid/Stretch", "y: 0 -> 0, 4 -> -6*t"}};
  const std::string a = "checkpoint-split-a", b = "checkpoint-split-b";
  const Result      whole = run(comm, a, shrinking);
  const auto        n     = [&](const Result &result) {
    return Utilities::MPI::sum(result.points.size(), comm);
  };
  report("split points, uninterrupted", whole.error.empty(), whole.error);
  crash_after_step     = 5;
  const Result crashed = run(comm, b, shrinking);
  expect_error("split points, interrupted", crashed, "crash");
  report("more are split after the interruption",
         n(whole) > n(crashed),
         std::to_string(n(whole)));
  crash_after_step = numbers::invalid_unsigned_int;
  auto again       = shrinking;
  again.emplace_back("Checkpoint/Resume", "true");
  compare("split points, resumed", run(comm, b, again), b, whole, a);
}



std::vector<double>
column(const std::string &directory, const std::string &name);

/** The grid changes before and after the interruption, which is in the middle
 * of an interval in which it is kept; points are split. */
void
test_adaptive_grid(const MPI_Comm comm)
{
  // the body ends in the middle of cells, and their levels don't suffice
  std::streambuf *const errors = std::cerr.rdbuf(nullptr);
  for (const std::string type : {"CPDI"})
    {
      const std::vector<std::pair<std::string, std::string>> adaptive = {
        {"Grid/Type", "adaptive"},
        {"Grid/Subdivisions", "10, 10"},
        {"Adaptive grid/Maximum level", "2"},
        {"Adaptive grid/Target of relative error", "0.2"},
        {"Adaptive grid/Cell size", "if(x - t > 2, 0.12, 1)"},
        {"Grid reset/Steps between resets", "2"},
        {"Grid reset/Smallest element quality", "0"},
        {"Quadrature/Type", type},
        {"Material points/Points per cell", "4"},
        // loads on adaptive grids need faces
        {"Boundary conditions/Surfaces of body",
         type == "CPDI" ? "all: 1" : ""},
        {"Boundary conditions/Traction on body",
         type == "CPDI" ? "all: 500, 0" : ""}};
      const std::string a = "checkpoint-adaptive-a",
                        b = "checkpoint-adaptive-b";
      const Result whole  = run(comm, a, adaptive);
      report("adaptive grid, uninterrupted, " + type,
             whole.error.empty(),
             whole.error);
      const auto changes = column(a, "Changes of grid");
      report("it changes before and after the interruption",
             changes.size() == 8 && changes[3] > 0 && changes[7] > changes[3],
             "");
      crash_after_step = 5;
      expect_error("adaptive grid, interrupted, " + type,
                   run(comm, b, adaptive),
                   "crash");
      crash_after_step = numbers::invalid_unsigned_int;
      auto again       = adaptive;
      again.emplace_back("Checkpoint/Interval", "2");
      again.emplace_back("Checkpoint/Resume", "true");
      compare(
        "adaptive grid, resumed, " + type, run(comm, b, again), b, whole, a);
    }
  std::cerr.rdbuf(errors);
}



/** The values of a column of the statistics; nan where there is none. */
std::vector<double>
column(const std::string &directory, const std::string &name)
{
  std::ifstream       file(directory + "/statistics.txt");
  std::string         line;
  unsigned int        index = 0, n_columns = 0;
  std::vector<double> values;
  while (std::getline(file, line))
    if (line[0] == '#')
      {
        if (line.substr(line.find(": ") + 2) == name)
          index = n_columns;
        ++n_columns;
      }
    else
      {
        std::istringstream row(line);
        std::string        word;
        for (unsigned int i = 0; i <= index; ++i)
          row >> word;
        values.push_back(std::strtod(word.c_str(), nullptr));
      }
  return values;
}



/** What says how to go on may change at a restart: the step size, the output
 * and the probes. */
void
test_changed_settings(const MPI_Comm comm)
{
  const std::string a = "checkpoint-set-a", b = "checkpoint-set-b";
  const std::pair<std::string, std::string> probes = {
    "Postprocess/Point probes", "new: 1.9, 2; centre: 1.7, 1.7"};
  const std::string name  = "Displacement y of new (m)";
  const Result      whole = run(comm, a, {probes});
  crash_after_step        = 5;
  expect_error("settings, interrupted", run(comm, b), "crash");
  crash_after_step     = numbers::invalid_unsigned_int;
  const Result resumed = run(comm,
                             b,
                             {{"Checkpoint/Resume", "true"},
                              {"Time/Step size", "0.01"},
                              {"Time/Output interval", "0.02"},
                              {"Newton/Tolerance", "1e-9"},
                              {"Postprocess/Write grid", "false"},
                              probes});
  // the checkpoint is that after step 4, t = 0.08
  const auto sizes = column(b, "Step size (s)");
  bool       right = sizes.size() == 4 + 8;
  for (unsigned int i = 0; i < sizes.size(); ++i)
    right = right && std::abs(sizes[i] - (i < 4 ? 0.02 : 0.01)) < 1e-12;
  report("another step size", resumed.error.empty() && right, resumed.error);
  // outputs at 0.04, 0.08 and from then on each 0.02
  report("other outputs",
         contents(b + "/points.pvd").find("points-00006.pvtu") !=
             std::string::npos &&
           contents(b + "/points.pvd").find("points-00007.pvtu") ==
             std::string::npos &&
           contents(b + "/grid.pvd").find("grid-00003.pvtu") ==
             std::string::npos,
         contents(b + "/points.pvd"));
  const auto   values   = column(b, name);
  const double expected = column(a, name).back();
  report("another probe: nan before",
         values.size() == 12 && std::isnan(values[3]) && !std::isnan(values[4]),
         std::to_string(values.size()));
  report("another probe: where it would have been",
         !values.empty() && std::abs(values.back() / expected - 1) < 0.02,
         std::to_string(values.back()) + " instead of " +
           std::to_string(expected));
  report("the probe that stays",
         !std::isnan(column(b, "Displacement y of centre (m)")[0]),
         "nan");
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize          mpi(argc, argv, 1);
  const MPI_Comm                            comm   = MPI_COMM_WORLD;
  const std::string                         a      = "checkpoint-a";
  const std::string                         b      = "checkpoint-b";
  const std::pair<std::string, std::string> resume = {"Checkpoint/Resume",
                                                      "true"};

  // eight steps, checkpoints after 2, 4, 6, 8 in the slots 0, 1, 0, 1
  const Result whole = run(comm, a);
  report("uninterrupted", whole.error.empty(), whole.error);
  {
    const Result again = run(comm, b);
    compare("repeated", again, b, whole, a);
  }

  crash_after_step = 5;
  expect_error("interrupted", run(comm, b), "crash");
  crash_after_step            = numbers::invalid_unsigned_int;
  const std::string step_2    = contents(checkpoint(b, 0));
  const std::string step_4    = contents(checkpoint(b, 1));
  const std::string old_stats = contents(b + "/statistics.txt");
  const auto        put_back  = [&](const std::string &slot_0,
                            const std::string &slot_1) {
    write(checkpoint(b, 0), slot_0);
    write(checkpoint(b, 1), slot_1);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      write(b + "/statistics.txt", old_stats);
    MPI_Barrier(comm);
  };
  compare("resumed", run(comm, b, {resume}), b, whole, a);

  put_back(step_2, step_4.substr(0, step_4.size() / 2));
  compare("truncated file: older one", run(comm, b, {resume}), b, whole, a);

  std::string flipped = step_4;
  flipped[flipped.size() / 2] ^= 1;
  put_back(step_2, flipped);
  compare("damaged file: older one", run(comm, b, {resume}), b, whole, a);

  // killed while it wrote: the last rank has step 4 in place of step 0 already
  const bool last = Utilities::MPI::this_mpi_process(comm) + 1 ==
                    Utilities::MPI::n_mpi_processes(comm);
  put_back(step_2, last ? step_4.substr(0, 10) : step_4);
  compare("set not complete: older one", run(comm, b, {resume}), b, whole, a);

  put_back(flipped, step_4.substr(0, 10));
  expect_error("both damaged", run(comm, b, {resume}), "is damaged");

  put_back(step_2, step_4);
  expect_error("other grid",
               run(comm, b, {resume, {"Grid/Subdivisions", "10, 10"}}),
               "<Grid/Subdivisions>: '20, 20' then, '10, 10' now");
  put_back(step_2, step_4);
  expect_error("other material",
               run(comm, b, {resume, {"Material/Poisson ratio", "0.3"}}),
               "<Material/Poisson ratio>: '0.4' then, '0.3' now");
  put_back(step_2, step_4);
  expect_error("other formulation",
               run(comm, b, {resume, {"Formulation/Type", "u"}}),
               "<Formulation/Type>");
  expect_error("nothing to resume",
               run(comm, "checkpoint-c", {resume}),
               "There is no checkpoint to resume from");

  // plugins are told by their names, not by their places in the registry
  put_back(step_2, step_4);
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Newcomer, "0: first")
  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, OtherNewcomer, "0: first")
  compare("resumed by a program that knows more plugins",
          run(comm, b, {resume}),
          b,
          whole,
          a);

  test_changed_settings(comm);
  test_kept_grid(comm);
  test_contact(comm);
  test_linear_equations(comm);
  test_split_points(comm);
  test_adaptive_grid(comm);

  if (Utilities::MPI::n_mpi_processes(comm) > 1)
    {
      Result result;
      result.error = "2 processes. Resume";
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        result = run(MPI_COMM_SELF, b, {resume});
      expect_error("other number of processes", result, " processes. Resume");
    }
  return 0;
}
