/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/threads.h>
#include <isochor/step/linear_step.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  LinearStep<dim>::LinearStep(MixedSystem<dim> &system, TimerOutput &timer)
    : system(system)
    , timer(timer)
  {}



  template <int dim>
  void
  LinearStep<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Linear solver");
    LinearSolverChoice::declare_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  void
  LinearStep<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Linear solver");
    linear_solver.parse_parameters(prm);
    prm.leave_subsection();
    use_one_thread_per_rank();
  }



  template <int dim>
  void
  LinearStep<dim>::start_step(const ActiveNodes<dim> &nodes,
                              const unsigned int      n_components)
  {
    linear_solver.forget_failure();
    nodes.initialize(base, n_components);
    nodes.initialize(correction, n_components);
    base.set_ghost_state(true); // ranks write all that they hold themselves
  }



  template <int dim>
  void
  LinearStep<dim>::factorise()
  {
    TimerOutput::Scope scope(timer, "factorisation");
    factorised_pattern = 0; // none, should this throw
    factorisation      = linear_solver.factorise_and_free(system.matrix());
    factorised_pattern = system.matrix().pattern_id;
  }



  template <int dim>
  long
  LinearStep<dim>::n_unstable_modes() const
  {
    if (!factorisation.knows_pivots || !has_factorisation())
      return -1;
    const SparseSystem &matrix      = system.matrix();
    long                n_pressures = 0;
    for (unsigned int i = 0; i < matrix.global_equation.size(); ++i)
      n_pressures += matrix.field[i] == SparseSystem::Field::pressure &&
                     matrix.locally_owned.is_element(matrix.global_equation[i]);
    n_pressures = Utilities::MPI::sum(n_pressures, matrix.comm);
    return std::max(0l,
                    static_cast<long>(factorisation.n_negative_pivots) -
                      n_pressures);
  }



  template <int dim>
  unsigned int
  LinearStep<dim>::solve(const NodalField       &unknowns,
                         const NodalConstraints &constraints,
                         const NodalField       &pending,
                         const bool              factorise,
                         const SolutionAccuracy &accuracy)
  {
    AssertDimension(unknowns.size(), base.size());
    AssertDimension(pending.size(), base.size());
    Assert(factorise || has_factorisation() || is_iterative(),
           ExcMessage("There is no factorisation."));
    linear_solver.set_accuracy(accuracy);
    system.right_hand_side(rhs);
    system.shape(solution);
    if (factorise)
      this->factorise();
    LinearSolverReport report;
    {
      TimerOutput::Scope scope(timer, "solution");
      report = linear_solver.solve(rhs, solution);
    }

    for (unsigned int i = 0; i < constraints.constrained.size(); ++i)
      {
        base.local_element(i) = unknowns.local_element(i);
        correction.local_element(i) =
          constraints.constrained[i] ? pending.local_element(i) : 0.;
      }
    system.to_nodes(solution, correction);
    return report.iterations;
  }



  template <int dim>
  void
  LinearStep<dim>::advance(const double s, NodalField &unknowns) const
  {
    AssertDimension(unknowns.locally_owned_size(), base.locally_owned_size());
    AssertDimension(correction.locally_owned_size(), base.locally_owned_size());
    const unsigned int n_entries =
      base.locally_owned_size() + base.get_partitioner()->n_ghost_indices();
    for (unsigned int i = 0; i < n_entries; ++i)
      unknowns.local_element(i) =
        base.local_element(i) + s * correction.local_element(i);
  }



  template <int dim>
  void
  LinearStep<dim>::set_statistics(const unsigned int n_linear_iterations,
                                  Statistics        &statistics) const
  {
    if (linear_solver.prefers_iterations())
      statistics.set("Linear iterations", n_linear_iterations);
    if (factorisation.knows_pivots)
      statistics.set("Negative pivots", factorisation.n_negative_pivots);
    if (factorisation.n_factor_entries > 0)
      statistics.set("Entries of the factors", factorisation.n_factor_entries);
  }



  template class LinearStep<2>;
  template class LinearStep<3>;
} // namespace isochor
