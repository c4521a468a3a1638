/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/file_names.h>
#include <isochor/program/command_line.h>
#include <isochor/step/material_point_method.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace
{
  using namespace isochor;

  /** The problem is left in @p owner, see Program::execute. */
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
    if (validate_only)
      {
        problem->validate();
        return;
      }

    prm.enter_subsection("Output");
    const std::string directory = prm.get("Directory");
    prm.leave_subsection();
    make_file_names_absolute(prm);
    write_effective_parameters(prm, directory);
    problem->run();
  }

  /** Without a launcher there is one process, which needs neither Open MPI's
   * network drivers nor its daemon; starting them takes as long as a small
   * scene. Nor does it need their directory below /tmp, which processes
   * without a daemon would share: the first to end removes it while others
   * start. Who sets these variables is not overruled; other MPIs don't read
   * them. */
  void
  keep_a_single_process_simple()
  {
    for (const char *launched : {"OMPI_COMM_WORLD_SIZE",
                                 "PMIX_RANK",
                                 "PMI_RANK",
                                 "PMI_SIZE",
                                 "SLURM_PROCID"})
      if (std::getenv(launched) != nullptr)
        return;
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_btl", "self", 0);
    setenv("OMPI_MCA_osc", "^ucx", 0);
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
} // namespace



int
main(int argc, char **argv)
{
  using namespace isochor;

  keep_a_single_process_simple();

  // The libraries that deal.II initialises don't get to see our options:
  // PETSc would answer --help and --version itself.
  int                              mpi_argc = 1;
  char                           **mpi_argv = argv;
  Utilities::MPI::MPI_InitFinalize mpi(mpi_argc, mpi_argv, 1);

  std::shared_ptr<void> problem; // gone before MPI is finalised
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
  return run_command_line(argc, argv, program);
}
