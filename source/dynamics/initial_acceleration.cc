/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of InertiaTerm that look for the acceleration at a start.
#include <isochor/dynamics/inertia_term.h>

namespace isochor
{
  template <int dim>
  void
  InertiaTerm<dim>::start_trial(
    const StepContext<dim>                                     &step,
    const TrialStep                                            &trial_step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    if (trial_step.size > 0) // the first of two
      prescribed = false;
    trial                   = trial_step;
    StepContext<dim> motion = step;
    motion.time             = end_of_motion(step);
    for (auto *const condition : with_role<ActsByAssembly<dim>>(conditions))
      condition->set_trial(motion, trial.size, smooth_start(step.step_size()));
  }



  template <int dim>
  void
  InertiaTerm<dim>::end_trial(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    trial = {};
    for (auto *const condition : with_role<ActsByAssembly<dim>>(conditions))
      condition->set_trial(step, 0., {});
  }



  template <int dim>
  void
  InertiaTerm<dim>::finish_trial(const StepContext<dim> &step,
                                 const NodalField       &unknowns,
                                 PointArrays<dim>       &points)
  {
    starts_with_impulse = trial.with_velocity;
    const double sign   = trial.is_past ? -1 : 1;
    finish_step(step, unknowns);
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const Tensor<1, dim> a =
            point(step,
                  points.stencil(step.grid.geometry(), k, q),
                  points.velocity[q])
              .second;
          points.acceleration[q] += sign / 2 * a;
          if (trial.with_velocity)
            points.velocity[q] += sign * trial.size / 4 * a;
        }
  }



  template void
  InertiaTerm<2>::start_trial(
    const StepContext<2> &,
    const TrialStep &,
    const std::vector<std::unique_ptr<BoundaryCondition<2>>> &);
  template void
  InertiaTerm<2>::end_trial(
    const StepContext<2> &,
    const std::vector<std::unique_ptr<BoundaryCondition<2>>> &);
  template void
  InertiaTerm<2>::finish_trial(const StepContext<2> &,
                               const NodalField &,
                               PointArrays<2> &);
  template void
  InertiaTerm<3>::start_trial(
    const StepContext<3> &,
    const TrialStep &,
    const std::vector<std::unique_ptr<BoundaryCondition<3>>> &);
  template void
  InertiaTerm<3>::end_trial(
    const StepContext<3> &,
    const std::vector<std::unique_ptr<BoundaryCondition<3>>> &);
  template void
  InertiaTerm<3>::finish_trial(const StepContext<3> &,
                               const NodalField &,
                               PointArrays<3> &);
} // namespace isochor
