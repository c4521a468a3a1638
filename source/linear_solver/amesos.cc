/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/plain_message.h>
#include <isochor/linear_solver/linear_solver.h>
#include <isochor/linear_solver/trilinos_export.h>

#include <Amesos.h>
#include <Epetra_LinearProblem.h>

#include <cmath>

namespace isochor
{
  /**
   * The direct solvers behind Trilinos' Amesos interface, for comparison. The
   * symbolic factorisation is kept while SparseSystem::pattern_id stays.
   */
  class AmesosSolver : public LinearSolver
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.enter_subsection("Amesos");
      prm.declare_entry("Solver type",
                        "Amesos_Klu",
                        Patterns::Anything(),
                        "The name Amesos has for the solver, for example "
                        "Amesos_Klu, Amesos_Mumps, Amesos_Lapack, whichever "
                        "Trilinos was built with.");
      prm.declare_entry("Residual tolerance",
                        "1e-6",
                        Patterns::Double(0.),
                        "A solution whose residual is larger, relative to the "
                        "right-hand side, is an error: most of the solvers "
                        "don't notice that a matrix is singular.");
      prm.leave_subsection();
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      prm.enter_subsection("Amesos");
      type               = prm.get("Solver type");
      residual_tolerance = prm.get_double("Residual tolerance");
      prm.leave_subsection();
      AssertThrow(Amesos().Query(type),
                  ExcMessage("The parameter <Linear solver/Amesos/Solver "
                             "type> is <" +
                             type +
                             ">, which this Trilinos was built without. "
                             "Allowed here are:" +
                             available_types() + "."));
    }

    LinearSolverReport
    factorise(const SparseSystem &A) override
    {
      LinearSolverReport report;
      factorised = false;
      assert_finite(A);
      if (!solver || pattern_id != A.pattern_id)
        {
          analyse(A);
          report.analysed = true;
        }
      else
        matrix->copy_values(A);
      check(solver->NumericFactorization(), "numeric factorisation");
      factorised        = true;
      report.factorised = true;
      return report;
    }

    LinearSolverReport
    solve(const TrilinosWrappers::MPI::Vector &b,
          TrilinosWrappers::MPI::Vector       &x) override
    {
      AssertThrow(factorised,
                  ExcMessage("Amesos: solve() needs a matrix that was "
                             "factorised successfully."));
      rhs = b;
      check(solver->Solve(), "solve");
      x = solution;

      TrilinosWrappers::MPI::Vector residual;
      residual.reinit(b, true);
      matrix->vmult(residual, x);
      residual -= b;
      const double norm = residual.l2_norm();
      AssertThrow(
        std::isfinite(norm) && norm <= residual_tolerance * b.l2_norm(),
        ExcLinearSolverFailed(type + ": the residual is " + rounded(norm) +
                              ", the right-hand side " + rounded(b.l2_norm()) +
                              ". The matrix is singular or nearly so."));
      return LinearSolverReport();
    }

  private:
    void
    analyse(const SparseSystem &A)
    {
      solver.reset();
      matrix.reset();
      equations = std::make_unique<EquationSubset>(A);
      matrix    = std::make_unique<TrilinosBlock>(A, *equations, *equations);
      // Some solvers look at the number of right-hand sides already when they
      // plan the factorisation.
      rhs.reinit(A.locally_owned, A.comm);
      solution.reinit(A.locally_owned, A.comm);
      problem.SetOperator(&matrix->matrix());
      problem.SetLHS(&solution.trilinos_vector());
      problem.SetRHS(&rhs.trilinos_vector());
      solver.reset(Amesos().Create(type, problem));
      AssertThrow(solver, ExcMessage("Amesos has no solver <" + type + ">."));
      check(solver->SymbolicFactorization(), "symbolic factorisation");
      pattern_id = A.pattern_id;
    }

    void
    check(const int error, const std::string &phase) const
    {
      AssertThrow(error == 0,
                  ExcLinearSolverFailed(type + ", " + phase + ": error " +
                                        std::to_string(error) +
                                        ". The matrix may be singular."));
    }

    static std::string
    available_types()
    {
      std::string list;
      for (const std::string name : {"Amesos_Klu",
                                     "Amesos_Lapack",
                                     "Amesos_Mumps",
                                     "Amesos_Umfpack",
                                     "Amesos_Superlu",
                                     "Amesos_Superludist",
                                     "Amesos_Pardiso"})
        if (Amesos().Query(name))
          list += " " + name;
      return list;
    }

    std::string type               = "Amesos_Klu";
    double      residual_tolerance = 1e-6;

    // In the order of dependence: the solver refers to the problem, and that
    // to the matrix.
    std::unique_ptr<EquationSubset>    equations;
    std::unique_ptr<TrilinosBlock>     matrix;
    TrilinosWrappers::MPI::Vector      rhs, solution;
    Epetra_LinearProblem               problem;
    std::unique_ptr<Amesos_BaseSolver> solver;
    unsigned long                      pattern_id = 0;
    bool                               factorised = false;
  };

  ISOCHOR_REGISTER(LinearSolver, AmesosSolver, "Amesos")
} // namespace isochor
