/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of InertiaTerm that look for the acceleration at t = 0.
#include <isochor/base/mpi_sums.h>
#include <isochor/dynamics/inertia_term.h>
#include <isochor/equations/connected_parts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

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
      {
        trial      = Trial();
        prescribed = false;
      }
    trial.size              = trial_step.size;
    trial.is_past           = trial_step.is_past;
    trial.step_size         = trial_step.step_size;
    StepContext<dim> motion = step;
    motion.time             = end_of_motion(step);
    for (const auto &condition : conditions)
      condition->set_trial(motion, trial.size, smooth_start(step.step_size()));
  }



  template <int dim>
  void
  InertiaTerm<dim>::end_trial(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    trial.size    = 0;
    trial.is_past = false;
    trial.settles = false;
    for (const auto &condition : conditions)
      condition->set_trial(step, 0., {});
  }



  template <int dim>
  void
  InertiaTerm<dim>::finish_trial(
    const StepContext<dim>                                     &step,
    const NodalField                                           &unknowns,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    PointArrays<dim>                                           &points)
  {
    // maybe to rest
    const bool   jumps   = step.old_time > 0;
    unsigned int by_body = jumps ? 1 : 0;
    for (const auto &condition : conditions)
      if (!jumps && condition->starts_suddenly(step, velocity))
        by_body = 1;
    const bool impulse =
      Utilities::MPI::max(by_body, step.grid.communicator()) != 0 ||
      starts_suddenly(step);
    starts_with_impulse = impulse;
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
          if (impulse)
            points.velocity[q] += sign * trial.size / 4 * a;
        }
  }



  template <int dim>
  bool
  InertiaTerm<dim>::steps_over_waves(const StepContext<dim> &step,
                                     const ElementNodes     &elements) const
  {
    // of each part of the body: the largest speed of shear waves and of x, -x
    using Extent = std::array<double, 1 + 2 * dim>;
    std::map<unsigned int, Extent>  parts;
    const std::vector<unsigned int> name = part_names(step, elements);
    const SimplexGeometry<dim>     &grid = step.grid.geometry();
    const auto part = [&](const unsigned int part_name) -> Extent & {
      const auto inserted = parts.emplace(part_name, Extent());
      if (inserted.second)
        inserted.first->second.fill(-std::numeric_limits<double>::max());
      return inserted.first->second;
    };
    for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
      for (unsigned int q = step.points.cell_start[k];
           q < step.points.cell_start[k + 1];
           ++q)
        {
          Extent &most = part(
            name[step.nodes.node(step.points.stencil(grid, k, q).vertex[0])]);
          const auto &material =
            *step.kernel.materials[step.points.material[q]];
          most[0] =
            std::max(most[0],
                     std::sqrt(material.shear_modulus() / material.density()));
          const Point<dim> x = step.points.location(grid, k, q);
          for (unsigned int d = 0; d < dim; ++d)
            {
              most[1 + 2 * d] = std::max(most[1 + 2 * d], x[d]);
              most[2 + 2 * d] = std::max(most[2 + 2 * d], -x[d]);
            }
        }

    std::vector<double> values;
    for (const auto &[part_name, most] : parts)
      {
        values.push_back(part_name);
        values.insert(values.end(), most.begin(), most.end());
      }
    for (const auto &of_rank :
         all_gather_arrays(step.grid.communicator(), values))
      for (auto v = of_rank.begin(); v != of_rank.end();)
        {
          Extent &most = part(static_cast<unsigned int>(*v++));
          for (double &value : most)
            value = std::max(value, *v++);
        }
    return std::all_of(parts.begin(), parts.end(), [&](const auto &one) {
      const Extent &most   = one.second;
      double        extent = std::numeric_limits<double>::max();
      for (unsigned int d = 0; d < dim; ++d)
        extent = std::min(extent, most[1 + 2 * d] + most[2 + 2 * d]);
      return most[0] * step.step_size() > extent / 2;
    });
  }



  template <int dim>
  void
  InertiaTerm<dim>::start_settling(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    MaterialPoints<dim>                                        &points)
  {
    trial = Trial();
    // such that the matrix is that of the step, where this starts
    trial.size      = std::sqrt(trial_integrator.stiffness(1.) /
                           integrator->stiffness(step.step_size()));
    trial.step_size = step.step_size();
    trial.settles   = true;
    prescribed      = false;
    // without what the scheme adds to the acceleration of the forces
    NodalField excess;
    collect_excess(step, points, excess);
    for (unsigned int i = 0; i < step.nodes.n_owned() * dim; ++i)
      force.local_element(i) -= excess.local_element(i);
    StepContext<dim> moment = step;
    moment.time             = step.old_time; // nothing moves
    for (const auto &condition : conditions)
      condition->set_trial(moment, trial.size, smooth_start(trial.step_size));
  }



  template <int dim>
  void
  InertiaTerm<dim>::finish_settling(const StepContext<dim> &step,
                                    const NodalField       &unknowns,
                                    PointArrays<dim>       &points)
  {
    NodalField change;
    step.nodes.initialize(change, dim);
    change.set_ghost_state(true); // ranks write all that they hold themselves
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        change.local_element(node * dim + d) =
          scheme().acceleration(unknowns.local_element(
                                  node * step.n_components + d),
                                0.,
                                0.,
                                trial.size);
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        points.acceleration[q] +=
          interpolate(step, points.stencil(step.grid.geometry(), k, q), change);
  }



  template <int dim>
  bool
  InertiaTerm<dim>::starts_suddenly(const StepContext<dim> &step) const
  {
    // the impulse on held nodes, against what would stop the body
    NodalField product;
    mass.vmult(step, velocity, product);
    double impulse = 0, scale = 0;
    for (unsigned int i = 0; i < step.nodes.n_owned() * dim; ++i)
      {
        scale = std::max({scale,
                          std::abs(product.local_element(i)),
                          std::abs(momentum.local_element(i))});
        if (held[i] && velocity.local_element(i) != 0.)
          impulse = std::max(impulse,
                             std::abs(product.local_element(i) -
                                      momentum.local_element(i)));
      }
    for (unsigned int k = 0; k < given_velocity.size(); ++k)
      {
        // also by what it follows, as the nodes of a rigid side do
        const double prescribed_velocity =
          given_velocity[k] + followers.sum(k, [&](const unsigned int entry) {
            return held[entry] ? velocity.local_element(entry) : 0.;
          });
        if (const unsigned int i = followers.entry[k];
            i < step.nodes.n_owned() * dim && prescribed_velocity != 0.)
          impulse = std::max(impulse,
                             std::abs(product.local_element(i) -
                                      momentum.local_element(i)));
      }
    const MPI_Comm comm = step.grid.communicator();
    return Utilities::MPI::max(impulse, comm) >
           1e-8 * Utilities::MPI::max(scale, comm);
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
  InertiaTerm<2>::finish_trial(
    const StepContext<2> &,
    const NodalField &,
    const std::vector<std::unique_ptr<BoundaryCondition<2>>> &,
    PointArrays<2> &);
  template bool
  InertiaTerm<2>::steps_over_waves(const StepContext<2> &,
                                   const ElementNodes &) const;
  template void
  InertiaTerm<2>::start_settling(
    const StepContext<2> &,
    const std::vector<std::unique_ptr<BoundaryCondition<2>>> &,
    MaterialPoints<2> &);
  template void
  InertiaTerm<2>::finish_settling(const StepContext<2> &,
                                  const NodalField &,
                                  PointArrays<2> &);
  template bool
  InertiaTerm<2>::starts_suddenly(const StepContext<2> &) const;
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
  InertiaTerm<3>::finish_trial(
    const StepContext<3> &,
    const NodalField &,
    const std::vector<std::unique_ptr<BoundaryCondition<3>>> &,
    PointArrays<3> &);
  template bool
  InertiaTerm<3>::steps_over_waves(const StepContext<3> &,
                                   const ElementNodes &) const;
  template void
  InertiaTerm<3>::start_settling(
    const StepContext<3> &,
    const std::vector<std::unique_ptr<BoundaryCondition<3>>> &,
    MaterialPoints<3> &);
  template void
  InertiaTerm<3>::finish_settling(const StepContext<3> &,
                                  const NodalField &,
                                  PointArrays<3> &);
  template bool
  InertiaTerm<3>::starts_suddenly(const StepContext<3> &) const;
} // namespace isochor
