/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_linear_solver_choice_h
#define isochor_linear_solver_choice_h

#include <isochor/linear_solver/linear_solver.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * The linear solver of a run: the one that the parameters name or, with
   * `auto`, for each matrix the direct or the iterative one, by the number of
   * equations. Where an iterative solver fails, the direct one takes over, as
   * long as the pattern of the matrix stays.
   */
  class LinearSolverChoice : public LinearSolver
  {
  public:
    /** The names of the solvers that may do the work if @p solver is the
     * parameter's value. */
    static std::vector<std::string>
    candidates(const std::string &solver);

    /** Those of all solvers, too. */
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm) override;

    /** Whether the one in use is. */
    bool
    is_iterative() const override;

    /** Whether an iterative one is in use, or would be, had it not failed. */
    bool
    prefers_iterations() const
    {
      return is_iterative() || failed_pattern != 0;
    }

    /** How an iterative solver has failed last, since forget_failure(). */
    const std::string &
    failure() const
    {
      return last_failure;
    }
    void
    forget_failure()
    {
      last_failure.clear();
    }

    void
    set_accuracy(const SolutionAccuracy &accuracy) override;

    LinearSolverReport
    factorise(const SparseSystem &A) override;

    LinearSolverReport
    factorise_and_free(SparseSystem &A) override;

    LinearSolverReport
    solve(const TrilinosWrappers::MPI::Vector &b,
          TrilinosWrappers::MPI::Vector       &x) override;

  private:
    /** The one that @p A calls for. */
    LinearSolver &
    choose(const SparseSystem &A) const;

    /** Factorise the matrix directly since @p failure befell the iterative
     * solver. */
    LinearSolverReport
    fall_back(const std::string &failure);

    /** The two that `auto` chooses from, or the one named and, if that is
     * iterative, the one to fall back to. */
    std::unique_ptr<LinearSolver> direct, iterative;
    std::string                   last_failure;
    bool                          automatic             = false;
    unsigned int                  largest_direct_system = 0;

    LinearSolver       *in_use = nullptr;
    const SparseSystem *matrix = nullptr;
    /** The same if its values may be freed, else null. */
    SparseSystem *freed_matrix = nullptr;
    /** The pattern that the iterative solver has failed with, 0: none. Nothing
     * else is remembered: a resumed run would not know. */
    unsigned long failed_pattern = 0;
  };
} // namespace isochor

#endif
