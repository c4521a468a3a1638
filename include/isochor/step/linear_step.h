/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_linear_step_h
#define isochor_linear_step_h

#include <deal.II/base/timer.h>

#include <isochor/base/statistics.h>
#include <isochor/equations/mixed_system.h>
#include <isochor/linear_solver/linear_solver_choice.h>

namespace isochor
{
  /** The linear part of an iteration of Newton's method: factorises the
   * matrix, solves for the correction of the nodal unknowns, and moves them
   * along it. */
  template <int dim>
  class LinearStep
  {
  public:
    /** All arguments are kept by reference. */
    LinearStep(MixedSystem<dim> &system, TimerOutput &timer);

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Shape what is kept for the @p nodes of a step. */
    void
    start_step(const ActiveNodes<dim> &nodes, const unsigned int n_components);

    /** Whether there is a factorisation of a matrix of the present pattern. */
    bool
    has_factorisation() const
    {
      return factorised_pattern == system.matrix().pattern_id;
    }

    /**
     * Find the correction of @p unknowns: with the matrix last assembled, whose
     * values may be freed, or, if
     * not @p factorise, with the one factorised before, as accurately as asked
     * where the solver is_iterative(). Where @p constraints
     * prescribe an unknown its correction is what is @p pending. Returns the
     * number of linear iterations. Throws ExcLinearSolverFailed. Collective.
     */
    unsigned int
    solve(const NodalField       &unknowns,
          const NodalConstraints &constraints,
          const NodalField       &pending,
          const bool              factorise,
          const SolutionAccuracy &accuracy);

    /** Factorise the matrix last assembled, whose values may be freed. Throws
     * ExcLinearSolverFailed. Collective. */
    void
    factorise();

    /** How many negative pivots the last factorisation has beyond those of the
     * pressures, one for each equation of a pressure as in any saddle point. By
     * Sylvester's law of inertia it is the number of modes in which a body with
     * a potential is not stable. -1 if the solver doesn't know, or the
     * factorisation is of another pattern. Collective. */
    long
    n_unstable_modes() const;

    /** Whether the linear solver in use is. */
    bool
    is_iterative() const
    {
      return linear_solver.is_iterative();
    }

    /** How an iterative solver has failed in this step, if one has. */
    const std::string &
    failure() const
    {
      return linear_solver.failure();
    }

    /** Set @p unknowns to what solve() has got plus @p s times the correction.
     */
    void
    advance(const double s, NodalField &unknowns) const;

    /** What is known of the last factorisation. */
    const LinearSolverReport &
    report() const
    {
      return factorisation;
    }

    void
    set_statistics(const unsigned int n_linear_iterations,
                   Statistics        &statistics) const;

  private:
    MixedSystem<dim> &system;
    TimerOutput      &timer;

    LinearSolverChoice linear_solver;
    LinearSolverReport factorisation;
    /** The pattern of the matrix last factorised, 0 for none. */
    unsigned long factorised_pattern = 0;

    TrilinosWrappers::MPI::Vector rhs, solution;
    NodalField                    base, correction;
  };
} // namespace isochor

#endif
