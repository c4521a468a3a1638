/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/nonlinear_solver/newton_solver.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <utility>

namespace isochor
{
  void
  NewtonSolver::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Newton");
    prm.declare_entry("Tolerance",
                      "1e-8",
                      Patterns::Double(0, 1),
                      "A step is converged if the residual forces fall below "
                      "this fraction of the external forces and reactions, and "
                      "the residual of the pressure equation below this "
                      "fraction of its largest value in the step. At most "
                      "0.01.");
    prm.declare_entry(
      "Predictor",
      "extrapolation",
      Patterns::Selection("none|extrapolation"),
      "Where Newton's method starts in a step: from zero increments, or "
      "with those of the last step, in proportion to the size of the steps. "
      "If it fails from there, it starts again from zero.");
    prm.declare_entry(
      "Maximum iterations",
      "40",
      Patterns::Integer(1),
      "A step that needs more iterations (those with a new factorisation "
      "count) has failed and is cut back. Where perfectly plastic material "
      "flows past an edge, some take 40.");
    prm.declare_entry(
      "Reuse factorisation",
      "0.1",
      Patterns::Double(0, 1),
      "A factorisation is kept over iterations and steps as "
      "long as each iteration reduces the residual to this "
      "fraction or less, at most <Maximum iterations> times in a step. This "
      "changes the way to the solution, not the solution. 0: a new "
      "factorisation for each iteration, Newton's method proper. Iterative "
      "linear solvers always get the present matrix.");
    prm.declare_entry(
      "Maximum backtracks",
      "8",
      Patterns::Integer(0),
      "How many times a correction may be halved that enlarges the residual "
      "or turns a point inside out (the line search).");
    prm.declare_entry("Inexact",
                      "true",
                      Patterns::Bool(),
                      "Let iterative linear solvers solve each iteration only "
                      "as accurately as Newton's method can make use of. "
                      "Direct solvers are not concerned, nor is the tolerance "
                      "of the step.");
    prm.leave_subsection();
  }



  void
  NewtonSolver::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Newton");
    tolerance      = prm.get_double("Tolerance");
    extrapolate    = prm.get("Predictor") == "extrapolation";
    max_iterations = prm.get_integer("Maximum iterations");
    reuse_ratio    = prm.get_double("Reuse factorisation");
    max_backtracks = prm.get_integer("Maximum backtracks");
    inexact        = prm.get_bool("Inexact");
    prm.leave_subsection();
    constexpr double most = 0.01;
    AssertThrow(tolerance <= most,
                ExcMessage(
                  "<Newton/Tolerance> is " + rounded(tolerance) +
                  ", but must be at most " + rounded(most) +
                  ": it is the part of the forces by which a step may be out "
                  "of equilibrium. With so much a body may not even feel its "
                  "loads. The default is 1e-8; if a step does not converge, "
                  "smaller steps help, a larger tolerance hides it."));
  }



  /** Where the iteration is. */
  struct NewtonSolver::Iterate
  {
    ResidualGauge gauge;
    ResidualNorms norms;
    bool          matrix_is_current = false; ///< it is of this iterate
    bool          expect_need       = true;  ///< of a matrix, in the next one
    /** Merit to the one before, 0 before there is one: then the factorisation
     * of the last step is tried; 1 where an old matrix led astray. */
    double last_ratio = 0.;
    double reduction  = 0.; ///< merit to the one before, 0 if there is none
    unsigned int n_shortened = 0; ///< corrections in a row
    /** As needed_matrix, of the last solution. */
    std::vector<bool> needed_before;
    /** Whether the matrix of the given iterate will be needed, as it was then,
     * or @p otherwise if there was no such iterate. */
    bool
    expects_need(const unsigned int iteration, const bool otherwise) const
    {
      return iteration < needed_before.size() ? needed_before[iteration] :
                                                otherwise;
    }
  };



  namespace
  {
    std::string
    describe(const EvaluationStatus status)
    {
      switch (status)
        {
          case EvaluationStatus::inverted_point:
            return "a material point was turned inside out (det F <= 0)";
          case EvaluationStatus::return_map_failed:
            return "the stress of a material point could not be found";
          default:
            return "the residual is not a number";
        }
    }

    void
    print_row(std::ostream          *log,
              const unsigned int     k,
              const NewtonIteration &row)
    {
      if (log == nullptr)
        return;
      char line[100];
      std::snprintf(line,
                    sizeof(line),
                    "    %3u   %10.3e   %10.3e   %6.3f\n",
                    k,
                    row.displacement,
                    row.pressure,
                    row.step_length);
      *log << line << std::flush;
    }
  } // namespace



  SolutionAccuracy
  NewtonSolver::accuracy(const ResidualGauge &gauge,
                         const ResidualNorms &norms,
                         const double         reduction) const
  {
    if (!inexact)
      return SolutionAccuracy();
    // Eisenstat & Walker, SIAM J. Sci. Comput. 17 (1996) 16-32, choice 2 with
    // exponent 2. The cap is also the first forcing term; their safeguard
    // against terms that fall too fast acts on terms above 1/3 only.
    const double     gamma = 0.9, cap = 1e-2, part_of_tolerance = 0.1;
    SolutionAccuracy a;
    a.relative =
      reduction > 0 ? std::min(cap, gamma * reduction * reduction) : cap;
    if (!norms.pending)
      {
        // a residual that ends up just above the tolerance takes an iteration
        // more, a digit in this one a few products of matrix and vector
        constexpr double aim = 0.5, most = 10;
        const double     foreseen = a.relative * gauge.merit(norms) / tolerance;
        if (foreseen > aim && foreseen < most)
          a.relative *= aim / foreseen;
        // what is left over may be part of the end result's residual
        a.displacement =
          part_of_tolerance * gauge.displacement_bound(norms, tolerance);
        a.pressure = part_of_tolerance * gauge.pressure_bound(norms, tolerance);
      }
    return a;
  }



  bool
  NewtonSolver::finished(const ResidualGauge &gauge,
                         const ResidualNorms &norms,
                         NewtonReport        &report) const
  {
    if (!std::isfinite(gauge.merit(norms)))
      report.failure = describe(norms.status);
    else if (!std::isfinite(norms.force_scale))
      report.failure = "a reaction is not a number";
    else if (gauge.converged(norms, tolerance))
      {
        report.converged   = true;
        report.force_scale = gauge.force_scale();
      }
    else if (report.n_factorisations >= max_iterations ||
             report.n_iterations() >= 4 * max_iterations)
      report.failure = "Newton's method did not converge in " +
                       std::to_string(max_iterations) + " iterations";
    return report.converged || !report.failure.empty();
  }



  NewtonSolver::LineSearch
  NewtonSolver::backtrack(const Problem       &problem,
                          const ResidualGauge &gauge,
                          const bool           may_grow,
                          const unsigned int   n_backtracks,
                          const bool           with_matrix,
                          ResidualNorms       &norms) const
  {
    const ResidualNorms start = norms;
    const double        old   = gauge.merit(start);
    LineSearch          search;
    for (unsigned int k = 0;; ++k, search.last /= 2)
      {
        problem.advance(search.last);
        norms              = problem.assemble(k == 0 && with_matrix);
        const double merit = gauge.merit(norms);
        search.failed =
          may_grow ? !std::isfinite(merit) : !gauge.is_progress(norms, start);
        if (k == 0 || merit < search.merit || !search.failed)
          {
            search.merit = merit;
            search.best  = search.last;
          }
        if (!search.failed || k == n_backtracks ||
            gauge.converged(norms, tolerance))
          break;
      }
    search.reduction = search.merit / old;
    return search;
  }



  NewtonReport
  NewtonSolver::solve(const Problem &problem, std::ostream *log)
  {
    Assert(problem.assemble && problem.solve && problem.advance,
           ExcInternalError());
    if (log != nullptr)
      *log << "     it     forces       volume     length\n";
    NewtonReport            report;
    Iterate                 now;
    const std::vector<bool> before = std::exchange(needed_matrix, {});
    if (reuse_ratio > 0 && !problem.is_iterative())
      now.needed_before = before;
    // Assembling the matrix costs as much again as the residual: it is left
    // away where the next iterate will need none.
    now.matrix_is_current = now.expects_need(0, true);
    now.norms             = problem.assemble(now.matrix_is_current);
    now.gauge.take(now.norms);
    add_row(now, 0, 0, report, log);
    while (report.failure.empty() && !finished(now.gauge, now.norms, report))
      correct(problem, now, report, log);
    return report;
  }



  void
  NewtonSolver::correct(const Problem &problem,
                        Iterate       &now,
                        NewtonReport  &report,
                        std::ostream  *log)
  {
    Assert(report.failure.empty() && !report.converged,
           ExcMessage("There is nothing to correct."));
    // an old matrix is worth a try if the last iteration converged so fast
    // that it, or quadratic convergence, can be expected to be enough
    const bool reuse =
      reuse_ratio > 0 && now.last_ratio <= reuse_ratio &&
      !problem.is_iterative() && problem.has_factorisation() &&
      report.n_iterations() < report.n_factorisations + max_iterations;
    const bool need = !reuse || now.norms.pending;
    if (!now.matrix_is_current && need)
      now.norms = problem.assemble(true);
    needed_matrix.resize(report.n_iterations() + 1);
    needed_matrix.back()  = need;
    unsigned int n_linear = 0;
    try
      {
        n_linear =
          problem.solve(!reuse, accuracy(now.gauge, now.norms, now.reduction));
        report.n_factorisations += reuse ? 0 : 1;
      }
    catch (const ExcLinearSolverFailed &exc)
      {
        report.failure = plain_message(exc);
        return;
      }

    // While prescribed increments come in, the residual has to grow; only
    // points that turn over shorten such a correction.
    const bool may_grow = now.norms.pending || report.n_iterations() == 0;
    now.expect_need =
      now.expects_need(report.n_iterations() + 1, now.expect_need);
    const LineSearch search = backtrack(problem,
                                        now.gauge,
                                        may_grow,
                                        reuse ? 0 : max_backtracks,
                                        now.expect_need,
                                        now.norms);
    now.matrix_is_current   = now.expect_need && search.last == 1.;
    if (reuse && search.failed)
      {
        // the old matrix led astray: back, and take the right one
        problem.advance(0.);
        now.norms             = problem.assemble(true);
        now.matrix_is_current = now.expect_need = true;
        now.last_ratio                          = 1.;
        return;
      }
    accept(problem, search, may_grow, now);
    add_row(now, search.best, n_linear, report, log);
    if (problem.has_other_start && leads_nowhere(search, now))
      report.failure =
        "three corrections in a row had to be shortened and changed little";
  }



  void
  NewtonSolver::accept(const Problem    &problem,
                       const LineSearch &search,
                       const bool        may_grow,
                       Iterate          &now) const
  {
    Assert(search.best >= 0 && search.best <= 1, ExcInternalError());
    if (search.best != search.last)
      problem.advance(search.best);
    if (search.last != 1.) // the last trial was without a matrix
      {
        now.norms             = problem.assemble(true);
        now.matrix_is_current = true;
      }
    now.last_ratio = may_grow ? 0. : search.reduction;
    now.reduction  = now.last_ratio;
    // none is needed for a correction by an old matrix, nor at the end, which
    // quadratic convergence lets foresee
    const bool   iterative = problem.is_iterative();
    const double foreseen =
      search.merit * (iterative ?
                        accuracy(now.gauge, now.norms, now.reduction).relative :
                        now.last_ratio * now.last_ratio);
    now.expect_need =
      may_grow ||
      (!(reuse_ratio > 0 && now.last_ratio <= reuse_ratio && !iterative) &&
       foreseen > tolerance);
    now.gauge.take(now.norms);
  }



  bool
  NewtonSolver::leads_nowhere(const LineSearch &search, Iterate &now) const
  {
    constexpr unsigned int most_shortened = 3;
    constexpr double       little         = 0.75; // left of the residual
    now.n_shortened =
      search.best < 1. && search.reduction > little ? now.n_shortened + 1 : 0;
    return now.n_shortened == most_shortened &&
           now.gauge.is_far(now.norms, tolerance);
  }



  void
  NewtonSolver::add_row(const Iterate     &now,
                        const double       length,
                        const unsigned int n_linear,
                        NewtonReport      &report,
                        std::ostream      *log)
  {
    report.iterations.push_back({now.gauge.displacement_ratio(now.norms),
                                 now.gauge.pressure_ratio(now.norms),
                                 length,
                                 n_linear});
    print_row(log, report.iterations.size() - 1, report.iterations.back());
  }
} // namespace isochor
