/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_newton_solver_h
#define isochor_newton_solver_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/linear_solver/linear_solver.h>
#include <isochor/nonlinear_solver/newton_report.h>
#include <isochor/nonlinear_solver/residual_gauge.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Newton's method with backtracking, on callables: it knows neither grid nor
   * material.
   */
  class NewtonSolver
  {
  public:
    struct Problem
    {
      /** Residual at the present iterate; with the matrix if asked. */
      std::function<ResidualNorms(const bool with_matrix)> assemble;
      /** Solve for the correction, with the matrix last assembled or, if not
       * @p factorise, with the one factorised before, as accurately as said.
       * Returns the number of linear iterations. Throws
       * ExcLinearSolverFailed. */
      std::function<unsigned int(const bool              factorise,
                                 const SolutionAccuracy &accuracy)>
        solve;
      /** Whether solve() makes use of the accuracy. Then a new matrix costs
       * little, and none is used again. */
      std::function<bool()> is_iterative = []() { return false; };
      /** Whether there is a factorisation of a matrix of the present pattern.
       */
      std::function<bool()> has_factorisation;
      /** Set the iterate to (the one at the last solve) + s (correction). */
      std::function<void(const double s)> advance;
      /** Whether there is another start should this one fail. Then one that
       * leads nowhere is given up at the third correction in a row that has to
       * be shortened and leaves most of the residual: the strip footing on an
       * adaptive grid spent a third of its assemblies and a sixth of its
       * factorisations on such ones. */
      bool has_other_start = false;
    };

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** The parameters, by path, that a resumed run may set anew. */
    static std::vector<std::string>
    changeable_parameters()
    {
      return {"Newton/"};
    }

    /** Solve. If @p log is given, print the convergence table to it. */
    NewtonReport
    solve(const Problem &problem, std::ostream *log);

    /** Relative tolerance of both residuals. */
    double tolerance = 1e-8;

    /** Whether a step starts from the motion of the last one. For the owner of
     * the iterate; the solver starts wherever it is. */
    bool extrapolate = true;

  private:
    struct Iterate;

    /** What a line search has found. */
    struct LineSearch
    {
      double best      = 0; ///< step length of least merit
      double last      = 1; ///< step length of the iterate it has left
      double merit     = 0; ///< at @p best
      double reduction = 0; ///< merit to the one before
      bool   failed    = false;
    };

    /** How accurate the next correction has to be. @p reduction: merit to the
     * one before, or 0 if there is none. */
    SolutionAccuracy
    accuracy(const ResidualGauge &gauge,
             const ResidualNorms &norms,
             const double         reduction) const;

    /** Whether the iteration ends here; @p report then says how. */
    bool
    finished(const ResidualGauge &gauge,
             const ResidualNorms &norms,
             NewtonReport        &report) const;

    /** Halve the correction until the residual falls or, if it @p may_grow,
     * can be evaluated. @p norms becomes that of the last iterate tried; its
     * matrix is assembled for the full step only, if asked. */
    LineSearch
    backtrack(const Problem       &problem,
              const ResidualGauge &gauge,
              const bool           may_grow,
              const unsigned int   n_backtracks,
              const bool           with_matrix,
              ResidualNorms       &norms) const;

    /** From one iterate to the next. If there is none, @p report says why. */
    void
    correct(const Problem &problem,
            Iterate       &now,
            NewtonReport  &report,
            std::ostream  *log);

    /** The best iterate of the line search is the present one. */
    void
    accept(const Problem    &problem,
           const LineSearch &search,
           const bool        may_grow,
           Iterate          &now) const;

    /** Whether one correction after the other is shortened and changes
     * little. */
    bool
    leads_nowhere(const LineSearch &search, Iterate &now) const;

    static void
    add_row(const Iterate     &now,
            const double       length,
            const unsigned int n_linear,
            NewtonReport      &report,
            std::ostream      *log);

    unsigned int max_iterations = 40;
    /** Keep a factorisation as long as it reduces the residual by this factor
     * per iteration; 0: always factorise. */
    double       reuse_ratio    = 0.2;
    unsigned int max_backtracks = 8;
    /** Whether an iterative solver may solve less accurately far from the
     * solution. */
    bool inexact = true;

    /** By the number of iterations done: whether the last solution went on with
     * the matrix there. Where factorisations are kept the next one mostly does
     * the same; it decides what is assembled, not what comes out. */
    std::vector<bool> needed_matrix;
  };
} // namespace isochor

#endif
