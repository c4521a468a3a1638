/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** The direct solver has taken over. */
  template <int dim>
  class IterativeSolver : public Diagnosis<dim>
  {
  public:
    void
    step_converged(const ConvergedStep<dim> &step) override
    {
      if (!step.failure_of_iterations.empty())
        this->warn(step.failure_of_iterations +
                   " MUMPS takes over; if often, set <Linear solver/Solver = "
                   "MUMPS>, or raise <Block FGMRES/Maximum iterations>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    IterativeSolver,
    "the iterative linear solver failed",
    ISOCHOR_ADVICE,
    "block FGMRES did not reach the accuracy in `Block FGMRES/Maximum "
    "iterations`, or the matrix is indefinite or singular; MUMPS takes over"
    " as long as the pattern of the matrix stays, and results are the same",
    "nothing, if it stays rare; else `Linear solver/Solver = MUMPS`, or "
    "more iterations ([solvers.md](solvers.md))")
} // namespace isochor
