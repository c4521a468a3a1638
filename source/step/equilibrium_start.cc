/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of Equilibrium that look for the acceleration at a start, and for
// the weight that the stabilisation leaves out.
#include <deal.II/base/mpi.h>

#include <isochor/base/rounding.h>
#include <isochor/equations/connected_parts.h>
#include <isochor/step/equilibrium.h>

#include <cmath>
#include <vector>

namespace isochor
{
  template <int dim>
  bool
  Equilibrium<dim>::is_supported(const Tensor<1, dim> &gravity) const
  {
    AssertDimension(constraints.constrained.size(),
                    setup.active_nodes().n_local() * scene.n_components);
    const unsigned int n_components = scene.n_components;
    const auto         along = [&](const unsigned int entry, const double x) {
      const unsigned int d = entry % n_components;
      return d < dim ? x * gravity[d] : 0.;
    };
    bool supported = false;
    for (unsigned int i = 0; i < constraints.constrained.size(); ++i)
      supported = supported ||
                  (constraints.constrained[i] == NodalConstraints::prescribed &&
                   along(i, 1.) != 0.);
    // a relation between nodes adds up to nothing, a wall doesn't
    for (const NodalConstraints::Equation &equation : constraints.equations)
      {
        if (equation.precedence == Precedence::tie)
          continue;
        double sum = 0;
        for (std::size_t j = equation.first; j < equation.last; ++j)
          sum += along(constraints.entry[j], constraints.coefficient[j]);
        supported =
          supported || std::abs(sum) > rounding::accumulated * gravity.norm();
      }
    for (const auto *const condition :
         with_role<const ActsByAssembly<dim>>(scene.boundary_conditions))
      {
        const bool holds = condition->supports_body(gravity); // on all ranks
        supported        = supported || holds;
      }
    return Utilities::MPI::max(static_cast<int>(supported),
                               scene.grid.communicator()) == 1;
  }



  template <int dim>
  void
  Equilibrium<dim>::set_weight()
  {
    if (!scene.leaves_out_weight)
      return;
    const StepContext<dim> step = setup.context();
    Tensor<1, dim>         gravity;
    for (const auto &condition : scene.boundary_conditions)
      gravity += condition->body_acceleration(step.time);
    Tensor<1, dim> &weight = scene.kernel.hydrostatic_acceleration;
    weight                 = gravity;
    if (scene.has_inertia() && gravity.norm() > 0)
      {
        // In free fall there is no weight; of bodies apart from each other some
        // may fall. What depends on accelerations would feed them. They stay
        // with that when they meet: a pressure that is at rest under the weight
        // all at once knocks at what holds it.
        if (setup.was_laid_out() || n_parts == 0)
          n_parts = number_of_parts(step, setup.all_elements());
        bool &were_apart = last_motion.bodies_were_apart;
        were_apart       = were_apart || n_parts > 1;
        if (were_apart || !is_supported(gravity))
          weight = Tensor<1, dim>();
      }
    if (scene.kernel.axisymmetric)
      weight[0] = 0.; // radial accelerations add up to none
  }



  template <int dim>
  bool
  Equilibrium<dim>::carries_acceleration() const
  {
    if (!scene.inertia.is_from_stresses() || scene.time.step == 0)
      return true;
    return setup.was_disturbed() &&
           scene.inertia.steps_over_waves(setup.context());
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::try_step(const typename InertiaTerm<dim>::TrialStep &trial)
  {
    Assert(scene.has_inertia(),
           ExcMessage("Only dynamics start with trial steps."));
    InertiaTerm<dim>      &inertia    = scene.inertia;
    const StepContext<dim> step       = setup.context();
    const auto            &conditions = scene.boundary_conditions;
    inertia.start_trial(step, trial, conditions);
    start_again();
    at_start            = true;
    NewtonReport report = trial.size < 0 ? find_root() : solve_from_start();
    if (report.converged && trial.size > 0 && !trial.is_past)
      settle_weight(report);
    if (report.converged)
      inertia.finish_trial(setup.context(), unknowns, setup.point_arrays());
    inertia.end_trial(step, conditions);
    return report;
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::find_initial_acceleration()
  {
    NewtonReport        report;
    const LoadStepping &time = scene.time;
    report.converged         = true;
    terminal.work().count("searches for an acceleration",
                          scene.has_inertia() && time.starts_anew);
    if (!scene.has_inertia() || !time.starts_anew)
      return report;
    // a trial errs by O(h); two, one of them back in time, by O(h²)
    using TrialStep = typename InertiaTerm<dim>::TrialStep;
    const double h  = time.next_time() - time.time;
    const bool   moves =
      time.step > 0 || scene.motion_starts.any_moves(scene.grid, 0., h);
    std::vector<TrialStep> trials = {{h, false, h, moves},
                                     {-h, false, h, moves}};
    if (time.step > 0)
      trials.insert(trials.begin(),
                    {{h, true, time.last_size, moves},
                     {-h, true, time.last_size, moves}});
    for (const TrialStep &trial : trials)
      if (report.converged)
        report = try_step(trial);
    if (!report.converged)
      return report;
    scene.inertia.start_step(setup.context(),
                             scene.boundary_conditions,
                             scene.points,
                             carries_acceleration());
    start_again();
    set_weight();
    return report;
  }



  template <int dim>
  void
  Equilibrium<dim>::settle_weight(NewtonReport &report)
  {
    constexpr unsigned int max_repetitions = 3;
    for (unsigned int n = 0; n < max_repetitions && report.converged; ++n)
      {
        const Tensor<1, dim> before = scene.kernel.hydrostatic_acceleration;
        set_weight();
        if (scene.kernel.hydrostatic_acceleration == before)
          return;
        report.continue_with(find_root());
      }
  }



  template bool
  Equilibrium<2>::carries_acceleration() const;
  template bool
  Equilibrium<3>::carries_acceleration() const;
  template NewtonReport
  Equilibrium<2>::find_initial_acceleration();
  template void
  Equilibrium<2>::set_weight();
  template NewtonReport
  Equilibrium<3>::find_initial_acceleration();
  template void
  Equilibrium<3>::set_weight();
} // namespace isochor
