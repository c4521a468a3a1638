/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of InertiaTerm that look for the acceleration at a start.
#include <deal.II/base/mpi.h>

#include <isochor/dynamics/inertia_term.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  template <int dim>
  void
  InertiaTerm<dim>::start_trial(
    const StepContext<dim>                                     &step,
    const TrialStep                                            &trial_step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    Assert(is_active(), ExcMessage("There is no inertia."));
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
    Assert(is_active(), ExcMessage("There is no inertia."));
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



  template <int dim>
  bool
  InertiaTerm<dim>::steps_over_waves(const StepContext<dim> &step) const
  {
    Assert(step.step_size() > 0, ExcInternalError());
    // of each body: the largest speed of shear waves and of x, -x
    constexpr unsigned int n_entries = 1 + 2 * dim;
    std::vector<double>    most(step.grid.n_layers() * n_entries,
                             -std::numeric_limits<double>::max());
    for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
      for (unsigned int q = step.points.cell_start[k];
           q < step.points.cell_start[k + 1];
           ++q)
        {
          double *const of_body =
            &most[step.grid.layer_of_cell(step.points.cell[k]) * n_entries];
          const auto &material =
            *step.kernel.materials[step.points.material[q]];
          const Point<dim> x = step.points.location(step.grid.geometry(), k, q);
          of_body[0] =
            std::max(of_body[0],
                     std::sqrt(material.shear_modulus() / material.density()));
          for (unsigned int d = 0; d < dim; ++d)
            {
              of_body[1 + 2 * d] = std::max(of_body[1 + 2 * d], x[d]);
              of_body[2 + 2 * d] = std::max(of_body[2 + 2 * d], -x[d]);
            }
        }
    Utilities::MPI::max(most, step.grid.communicator(), most);
    for (std::size_t i = 0; i < most.size(); i += n_entries)
      {
        double extent = std::numeric_limits<double>::max();
        for (unsigned int d = 0; d < dim; ++d)
          extent = std::min(extent, most[i + 1 + 2 * d] + most[i + 2 + 2 * d]);
        if (most[i] >= 0 && most[i] * step.step_size() <= extent / 2)
          return false;
      }
    return true;
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
  template bool
  InertiaTerm<2>::steps_over_waves(const StepContext<2> &) const;
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
  template bool
  InertiaTerm<3>::steps_over_waves(const StepContext<3> &) const;
} // namespace isochor
