/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of Equilibrium that look for the acceleration at t = 0, and for
// the weight that the stabilisation leaves out, which depends on it.
#include <isochor/equations/connected_parts.h>
#include <isochor/step/equilibrium.h>

namespace isochor
{
  template <int dim>
  void
  Equilibrium<dim>::set_weight()
  {
    if (scene.leaves_out_weight)
      set_weight(scene.inertia.mean_acceleration(setup.context()));
  }



  template <int dim>
  void
  Equilibrium<dim>::set_weight(const Tensor<1, dim> &mean_acceleration)
  {
    // gravity at the time of the acceleration: in free fall they are the same
    const StepContext<dim> step = setup.context();
    const double   time = scene.has_inertia() && !scene.inertia.in_trial() ?
                            step.old_time :
                            step.time;
    Tensor<1, dim> gravity;
    for (const auto &condition : scene.boundary_conditions)
      gravity += condition->body_acceleration(time);
    // nothing without weight: an acceleration may be rounding over h². And
    // bodies apart from each other have no acceleration in common.
    if (gravity.norm() > 0 && scene.has_inertia() &&
        (setup.was_laid_out() || n_parts == 0))
      n_parts = number_of_parts(step, setup.all_elements());
    const bool has_weight =
      gravity.norm() > 0 && !(scene.has_inertia() && n_parts > 1);
    Tensor<1, dim> &weight = scene.kernel.hydrostatic_acceleration;
    weight = has_weight ? gravity - mean_acceleration : Tensor<1, dim>();
    if (scene.kernel.axisymmetric)
      weight[0] = 0.; // radial accelerations add up to none
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::find_initial_acceleration()
  {
    NewtonReport report;
    report.converged = true;
    if (!scene.has_inertia() || scene.time.step > 0)
      return report;
    InertiaTerm<dim> &inertia = scene.inertia;
    // a trial errs by O(h); two, one of them back in time, by O(h²)
    const StepContext<dim> step       = setup.context();
    const auto            &conditions = scene.boundary_conditions;
    for (const double trial : {step.step_size(), -step.step_size()})
      {
        inertia.start_trial(step, trial, conditions);
        start_again(inertia.do_walls_lead());
        at_start = true;
        report   = trial > 0 ? solve_first_trial(step) : find_root(false);
        if (report.converged && trial > 0)
          settle_weight(report);
        if (report.converged)
          inertia.finish_trial(setup.context(),
                               unknowns,
                               conditions,
                               setup.point_arrays());
        inertia.end_trial(step, conditions);
        if (!report.converged)
          break;
      }
    inertia.let_walls_lead(false);
    if (!report.converged)
      return report;
    inertia.start_step(setup.context(),
                       scene.boundary_conditions,
                       scene.points,
                       scene.time.step == 0);
    start_again();
    set_weight();
    return report;
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::solve_first_trial(const StepContext<dim> &step)
  {
    InertiaTerm<dim> &inertia    = scene.inertia;
    const bool        was_pushed = inertia.walls_start_smoothly(step);
    NewtonReport      report     = solve_with_contact();
    const bool        is_pushed  = inertia.walls_start_smoothly(step);
    if (report.converged && is_pushed)
      {
        inertia.let_walls_lead(true);
        start_again(true);
        report.continue_with(find_root(false));
      }
    if (report.converged || !(was_pushed || is_pushed))
      return report;
    // A wall that recedes and one that pushes may have nodes for which neither
    // is right: then all start with what the points bring.
    inertia.let_walls_follow();
    start_again();
    return solve_with_contact();
  }



  template <int dim>
  void
  Equilibrium<dim>::settle_weight(NewtonReport &report)
  {
    constexpr unsigned int max_repetitions = 3;
    constexpr double       accuracy        = 1e-10;
    for (unsigned int n = 0;
         n < max_repetitions && report.converged && scene.leaves_out_weight;
         ++n)
      {
        const Tensor<1, dim> before = scene.kernel.hydrostatic_acceleration,
                             mean   = scene.inertia.mean_trial_acceleration(
                               setup.context(), unknowns);
        set_weight(mean);
        const Tensor<1, dim> after = scene.kernel.hydrostatic_acceleration;
        if ((after - before).norm() <=
            accuracy * (after + mean).norm()) // of gravity
          return;
        report.continue_with(find_root(false));
      }
  }



  template NewtonReport
  Equilibrium<2>::find_initial_acceleration();
  template void
  Equilibrium<2>::set_weight();
  template NewtonReport
  Equilibrium<3>::find_initial_acceleration();
  template void
  Equilibrium<3>::set_weight();
} // namespace isochor
