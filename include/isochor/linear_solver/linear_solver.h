/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_linear_solver_h
#define isochor_linear_solver_h

#include <deal.II/lac/trilinos_vector.h>

#include <isochor/base/plugin_registry.h>
#include <isochor/linear_solver/sparse_system.h>

#include <string>
#include <vector>

namespace isochor
{
  /** What a solver tells of its work, for the statistics. */
  struct LinearSolverReport
  {
    bool         analysed          = false; ///< a symbolic analysis was made
    bool         factorised        = false; ///< a numeric factorisation too
    unsigned int iterations        = 0;     ///< 0 for direct solvers
    unsigned int n_negative_pivots = 0;     ///< if the solver knows
    bool         knows_pivots      = false; ///< whether it does
    /** Of the factors, over all ranks; 0: none or not known. */
    double n_factor_entries = 0;
    /** Held by this rank: for direct solvers by the factors and the workspace
     * of the factorisation, for iterative ones by the matrix, not counting the
     * preconditioner; 0: not known. */
    double memory_in_bytes = 0;
  };

  /**
   * When a solution is accurate enough: if its residual is below a part of the
   * right-hand side, or if it is below absolute bounds for both fields.
   * Iterative solvers may stop there; others don't need to know. All zero: as
   * accurate as the solver's own parameters say.
   */
  struct SolutionAccuracy
  {
    double relative     = 0;
    double displacement = 0; ///< residual force (N)
    double pressure     = 0; ///< of the pressure equation (m^dim)
  };

  /** Thrown when a system can't be solved; the step is then cut back. */
  DeclException1(ExcLinearSolverFailed,
                 std::string,
                 << "The linear solver failed: " << arg1);

  /**
   * Interface of the linear solvers. To add one, write
   * `source/linear_solver/<name>.cc` with the class and its registration. Its
   * parameters live in the subsection "Linear solver".
   */
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    virtual void
    parse_parameters(ParameterHandler &prm) = 0;

    /** The parameters, by path, that a resumed run may set anew. */
    static std::vector<std::string>
    changeable_parameters()
    {
      return {"Linear solver/"};
    }

    /** Whether solves take iterations. */
    virtual bool
    is_iterative() const
    {
      return false;
    }

    /** What is asked of the solves that follow. */
    virtual void
    set_accuracy(const SolutionAccuracy &)
    {}

    /**
     * Take the matrix @p A: analyse if its pattern_id is new, factorise or
     * build the preconditioner. A must outlive the solves that follow.
     */
    virtual LinearSolverReport
    factorise(const SparseSystem &A) = 0;

    /**
     * The same, of a matrix that nobody else needs any more: a solver with a
     * copy of its own may free the values of @p A, which are empty then, if
     * restore_values() gives them back.
     */
    virtual LinearSolverReport
    factorise_and_free(SparseSystem &A)
    {
      return factorise(A);
    }

    /** Give @p A, which has been handed over last, the values that it had, to
     * the last digit. */
    virtual void
    restore_values(SparseSystem & /*A*/) const
    {}

    /**
     * Solve A x = b with the last factorised A. Both vectors are distributed
     * as A.locally_owned. May be called repeatedly.
     */
    virtual LinearSolverReport
    solve(const TrilinosWrappers::MPI::Vector &b,
          TrilinosWrappers::MPI::Vector       &x) = 0;
  };

  /** Throw ExcLinearSolverFailed, on all ranks, if on any of them @p A has a
   * value that is infinite or not a number. */
  void
  assert_finite(const SparseSystem &A);
} // namespace isochor

#endif
