/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_test_command_line_stub_h
#define isochor_test_command_line_stub_h

// A stub program behind the command line, and what comes of it.

#include <deal.II/base/mpi.h>

#include <isochor/program/command_line.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace isochor;

inline bool
is_root()
{
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}



inline void
check(const std::string &name, const bool ok, const std::string &details)
{
  const bool all_ok = Utilities::MPI::min(ok ? 1 : 0, MPI_COMM_WORLD) == 1;
  if (!ok)
    std::cout << name << ": FAILED, " << details << std::endl;
  else if (all_ok && is_root())
    std::cout << name << ": OK" << std::endl;
}



inline void
write(const std::string &file, const std::string &text)
{
  if (is_root())
    {
      std::filesystem::create_directories(
        std::filesystem::path("./" + file).parent_path());
      std::ofstream(file) << text;
    }
  MPI_Barrier(MPI_COMM_WORLD);
}



inline void
declare(ParameterHandler                      &prm,
        const unsigned int                     dim,
        const std::vector<ParameterStatement> &statements)
{
  const unsigned int n_materials =
    n_numbered_subsections(statements, "Material");
  for (unsigned int m = 1; m <= n_materials; ++m)
    {
      prm.enter_subsection(m == 1 ? "Material" :
                                    "Material " + std::to_string(m));
      prm.declare_entry("Model", "Hencky", Patterns::Selection("Hencky|J2"));
      prm.declare_entry("Poisson ratio",
                        "0.3",
                        Patterns::Double(-1, 0.5),
                        "Ratio of the transverse contraction.");
      prm.leave_subsection();
    }
  for (const NamedSection &body :
       named_subsections(statements, "Rigid body", false))
    {
      prm.enter_subsection(body.section);
      prm.declare_entry("Shape", "circle", Patterns::Anything());
      prm.leave_subsection();
    }
  prm.enter_subsection("Newton");
  prm.declare_entry("Tolerance", "1e-8", Patterns::Double(0));
  prm.enter_subsection("Line search");
  prm.declare_entry("Maximum cuts", "5", Patterns::Integer(0));
  prm.leave_subsection();
  prm.leave_subsection();
  prm.enter_subsection("Output");
  prm.declare_entry("Directory", "output", Patterns::DirectoryName());
  if (dim == 3)
    prm.declare_entry("Slice normal", "0,0,1", Patterns::Anything());
  prm.leave_subsection();
  prm.enter_subsection("Grid");
  prm.declare_entry("File", "", Patterns::FileName());
  prm.leave_subsection();
  prm.enter_subsection("Checkpoint");
  prm.declare_entry("Resume", "false", Patterns::Bool());
  prm.leave_subsection();
}



/** What came of a command line, on this rank. */
struct Result
{
  int          status;
  std::string  out, err;
  unsigned int n_executions  = 0;
  unsigned int dim           = 0;
  bool         validate_only = false;
  std::string  parameters; ///< as the stub got them, without documentation
};



inline Result
run(
  const std::vector<std::string> &arguments,
  const std::function<void()>    &body = []() {})
{
  Result  result;
  Program program;
  program.declare = declare;
  program.execute = [&](auto &prm, const auto dim, const bool validate_only) {
    ++result.n_executions;
    result.dim           = dim;
    result.validate_only = validate_only;
    std::ostringstream text;
    prm.print_parameters(text, ParameterHandler::ShortPRM);
    result.parameters = text.str();
    if (is_root())
      std::cout << "running" << std::endl;
    body();
  };

  std::vector<const char *> argv = {"isochor"};
  for (const std::string &argument : arguments)
    argv.push_back(argument.c_str());
  std::ostringstream out, err;
  auto *const        out_buffer = std::cout.rdbuf(out.rdbuf());
  auto *const        err_buffer = std::cerr.rdbuf(err.rdbuf());
  result.status = run_command_line(argv.size(), argv.data(), program);
  std::cout.rdbuf(out_buffer);
  std::cerr.rdbuf(err_buffer);
  result.out = out.str();
  result.err = err.str();
  return result;
}



inline std::string
describe(const Result &r)
{
  return "status " + std::to_string(r.status) + "\nstdout: " + r.out +
         "\nstderr: " + r.err + "\nparameters: " + r.parameters;
}



inline bool
contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}



/** The command line fails, with the message on rank 0 only, before the
 * program is executed. */
inline void
check_error(const std::string              &name,
            const std::vector<std::string> &arguments,
            const std::string              &message,
            const int                       status = 1)
{
  const Result      r = run(arguments);
  const std::string expected =
    is_root() ?
      "isochor: error: " + message +
        (status == 2 ? "\nTry 'isochor --help' for the options.\n" : "\n") :
      "";
  check(name,
        r.status == status && r.err == expected && r.out.empty() &&
          r.n_executions == 0,
        "expected: " + expected + "\n" + describe(r));
}



/** The command line works, and the program gets the line @p parameter. */
inline void
check_parameter(const std::string              &name,
                const std::vector<std::string> &arguments,
                const std::string              &parameter)
{
  const Result r = run(arguments);
  check(name,
        r.status == 0 && r.err.empty() && r.n_executions == 1 &&
          contains(r.parameters, parameter + "\n"),
        "expected: " + parameter + "\n" + describe(r));
}

#endif
