/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_command_line_h
#define isochor_command_line_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <isochor/base/parameter_file.h>

#include <functional>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** What the command line is a front end to. */
  struct Program
  {
    /** Declare all parameters but `Dimension`, for a space dimension and what
     * the @p statements of the parameter file mention. */
    std::function<void(ParameterHandler                      &prm,
                       const unsigned int                     dim,
                       const std::vector<ParameterStatement> &statements)>
      declare;

    /** Construct the problem, parse its parameters and, unless
     * @p validate_only, run it. Collective over all ranks. If a rank can fail
     * alone, what it constructs should outlive run_command_line(): that aborts
     * MPI, whereas destructors may wait for the other ranks for ever. */
    std::function<void(ParameterHandler  &prm,
                       const unsigned int dim,
                       const bool         validate_only)>
      execute;
  };

  /**
   * Do what the command line asks for and return the exit status of the
   * program: 0, 1 for errors in the parameters or the run, 2 for errors in the
   * command line itself. An error is written to stderr once. If it happened on
   * some ranks only, while the others still wait for them, MPI is aborted:
   * otherwise mpirun would hang.
   *
   * MPI has to be initialised.
   */
  int
  run_command_line(const int          argc,
                   const char *const *argv,
                   const Program     &program,
                   const MPI_Comm    &comm = MPI_COMM_WORLD);
} // namespace isochor

#endif
