/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/dynamics/field_followers.h>
#include <isochor/dynamics/nodal_start.h>
#include <isochor/dynamics/unfelt_pressure.h>
#include <isochor/equations/invariants.h>
#include <isochor/grid/prescribed_motion.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace isochor
{
  template <int dim>
  void
  NodalStart<dim>::take_pressures(const StepContext<dim> &step,
                                  const NodalField       &unknowns)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    step.nodes.initialize(start_unknowns, step.n_components);
    start_unknowns.set_ghost_state(true);
    for (unsigned int node = 0; node < step.nodes.n_local() && step.mixed();
         ++node)
      {
        const unsigned int entry            = node * step.n_components + dim;
        start_unknowns.local_element(entry) = unknowns.local_element(entry);
      }
  }



  template <int dim>
  void
  NodalStart<dim>::start_step(const StepContext<dim> &step,
                              const Conditions       &conditions,
                              MaterialPoints<dim>    &points,
                              const bool              from_stresses,
                              const bool              takes_mean)
  {
    worst_projection = 0;
    by_stresses      = from_stresses;
    has_mean         = takes_mean;
    mass.reinit(step, has_mean);
    mass.collect(step, step.points.velocity, momentum);
    if (by_stresses)
      collect_forces(step, conditions, points);
    else
      mass.collect(step, step.points.acceleration, force);
    prescribed = false;
    step.nodes.initialize(velocity, dim);
    step.nodes.initialize(acceleration, dim);
  }



  template <int dim>
  void
  NodalStart<dim>::collect_forces(const StepContext<dim> &step,
                                  const Conditions       &conditions,
                                  MaterialPoints<dim>    &points)
  {
    StepContext<dim> start = step;
    start.time             = step.old_time;
    NodalField loads;
    step.nodes.initialize(loads, step.n_components);
    for (const auto &condition : conditions)
      condition->add_external_force(start, loads);
    const PointLayout &l = points.layout();
    points.for_each([&](const unsigned int k,
                        const unsigned int q,
                        Point<dim> & /*location*/,
                        ArrayView<double> properties) {
      const auto   stencil = step.points.stencil(step.grid.geometry(), k, q);
      const auto   stress  = load_symmetric<dim>(&properties[l.stress]);
      const double V = step.points.measure(q) * determinant(step.points.F[q]) *
                       step.kernel.hoop_stretch(properties.data() + l.history);
      for (unsigned int I = 0; I < stencil.n_nodes; ++I)
        {
          const unsigned int entry =
            step.nodes.node(stencil.vertex[I]) * step.n_components;
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              loads.local_element(entry + a) -=
                V * stress[a][b] * stencil.gradient[I][b];
          if (step.kernel.axisymmetric)
            loads.local_element(entry) -=
              V * stress[2][2] * stencil.shape[I] / step.points.radius[q];
        }
    });
    loads.compress(VectorOperation::add);
    std::vector<Tensor<1, dim>> excess(step.points.n_points());
    points.for_each([&](const unsigned int /*k*/,
                        const unsigned int q,
                        Point<dim> & /*location*/,
                        ArrayView<double> properties) {
      // and what trials have added to the acceleration since
      for (unsigned int d = 0; d < dim; ++d)
        excess[q][d] = properties[l.excess + d] +
                       step.points.acceleration[q][d] -
                       properties[l.acceleration + d];
    });
    mass.collect(step, excess, force);
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      for (unsigned int a = 0; a < dim; ++a)
        force.local_element(node * dim + a) +=
          loads.local_element(node * step.n_components + a);
  }



  template <int dim>
  void
  NodalStart<dim>::collect_boundary_forces(const StepContext<dim> &step,
                                           const Conditions       &conditions)
  {
    StepContext<dim> start = step;
    start.time             = step.old_time;
    NodalField forces;
    step.nodes.initialize(forces, step.n_components);
    const auto acting = with_role<ActsByAssembly<dim>>(conditions);
    for (const auto *const condition : acting)
      condition->add_boundary_force(start, start_unknowns, forces);
    forces.compress(VectorOperation::add);
    for (auto *const condition : acting)
      condition->note_start(start, start_unknowns, forces);
    for (unsigned int node = 0; node < step.nodes.n_owned() && by_stresses;
         ++node)
      for (unsigned int a = 0; a < dim; ++a)
        force.local_element(node * dim + a) +=
          forces.local_element(node * step.n_components + a);
  }



  template <int dim>
  void
  NodalStart<dim>::project(const StepContext<dim>    &step,
                           const NodalField          &load,
                           const Followers           &followers,
                           const std::vector<double> &given,
                           NodalField                &solution,
                           const bool                 with_domains)
  {
    Assert(held.size() >= solution.locally_owned_size(), ExcInternalError());
    const auto solve = [&](const bool by_domains) {
      solution.zero_out_ghost_values();
      mass.set_lumped_solution(load, held, solution);
      return mass.solve(
        step, load, held, followers, given, solution, by_domains);
    };
    // the points' own mass conserves angular momentum best; where it is
    // singular and the load not in its range, that of their domains takes its
    // place
    double error = solve(false);
    if (with_domains && !(error < 1e-8))
      error = solve(true);
    if (!(error <= worst_projection))
      worst_projection = error;
  }



  template <int dim>
  void
  NodalStart<dim>::prescribe(const StepContext<dim> &step,
                             const Conditions       &conditions,
                             const NodalConstraints &constraints,
                             const SmoothStart      &smooth,
                             const bool              with_projection)
  {
    const unsigned int nc = step.n_components;
    const double       dt = step.step_size();
    // differences only: a jump of the prescribed place at the start of the step
    // is in all of them
    Places at;
    for (unsigned int k = 0; k < n_motion_places; ++k)
      at[k] = constraints_at(step,
                             conditions,
                             constraints.ties,
                             k / (n_motion_places - 1.));
    const NodalConstraints &start = at[0];
    held.assign(step.nodes.n_local() * dim, 0);
    if (with_projection)
      {
        NodalConstraints ties_only;
        ties_only.reinit(step.nodes.n_local() * nc);
        ties_only.ties = constraints.ties;
        ties_only.resolve(nc);
        step.nodes.initialize(projected, dim);
        project(step,
                momentum,
                displacement_followers<dim>(ties_only, nc),
                {},
                projected);
      }
    step.nodes.initialize(velocity, dim);
    step.nodes.initialize(acceleration, dim);
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int entry = node * nc + d, i = node * dim + d;
          held[i] =
            constraints.constrained[entry] == NodalConstraints::prescribed;
          if (!held[i] || node >= step.nodes.n_owned())
            continue;
          const MotionAtStart motion =
            motion_of_step({{at[0].increment[entry],
                             at[1].increment[entry],
                             at[2].increment[entry],
                             at[3].increment[entry]}},
                           dt);
          std::tie(velocity.local_element(i), acceleration.local_element(i)) =
            smooth.of(motion);
        }

    followers = displacement_followers<dim>(start, nc);
    given_velocity.clear();
    given_acceleration.clear();
    if (!start.equations.empty())
      {
        const auto starts = starts_of_followers(at, nc, dt, smooth);
        for (const auto &[v, a] : starts)
          {
            given_velocity.push_back(v);
            given_acceleration.push_back(a);
          }
      }
    project(step, momentum, followers, given_velocity, velocity);
    project_acceleration(step, conditions, start);
    prescribed = true;
  }



  template <int dim>
  void
  NodalStart<dim>::project_acceleration(const StepContext<dim> &step,
                                        const Conditions       &conditions,
                                        const NodalConstraints &start)
  {
    // those of a grid that is kept are those of the last step
    if (has_mean && !prescribed && step.mixed() && !step.grid_is_kept)
      {
        NodalField unused;
        step.nodes.initialize(unused, dim);
        leave_out_unfelt_pressure(step,
                                  start,
                                  start_unknowns,
                                  by_stresses ? force : unused);
      }
    if (has_mean && !prescribed)
      collect_boundary_forces(step, conditions);
    project(
      step, force, followers, given_acceleration, acceleration, by_stresses);
  }



  template <int dim>
  void
  NodalStart<dim>::accelerate(const StepContext<dim> &step,
                              const NodalField       &load,
                              NodalField             &acceleration)
  {
    step.nodes.initialize(acceleration, dim);
    if (load.size() > 0)
      {
        NodalField of_displacements;
        step.nodes.initialize(of_displacements, dim);
        for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
          for (unsigned int a = 0; a < dim; ++a)
            of_displacements.local_element(node * dim + a) =
              load.local_element(node * step.n_components + a);
        const std::vector<double> none_given(given_acceleration.size(), 0.);
        project(
          step, of_displacements, followers, none_given, acceleration, true);
      }
    acceleration.update_ghost_values();
  }



  template <int dim>
  std::vector<std::pair<double, double>>
  NodalStart<dim>::starts_of_followers(const Places      &at,
                                       const unsigned int n_components,
                                       const double       dt,
                                       const SmoothStart &smooth)
  {
    Assert(dt > 0, ExcInternalError());
    Assert(std::all_of(at.begin(),
                       at.end(),
                       [&](const auto &c) {
                         return c.followers.size() == at[0].followers.size();
                       }),
           ExcMessage("Followers change within a step."));
    std::array<Followers, n_motion_places> all;
    for (unsigned int k = 0; k < n_motion_places; ++k)
      all[k] = displacement_followers<dim>(at[k], n_components);
    std::vector<std::pair<double, double>> result;
    for (unsigned int f = 0; f < all[0].size(); ++f)
      {
        std::array<double, n_motion_places> places;
        for (unsigned int k = 0; k < n_motion_places; ++k)
          places[k] = all[k].value[f];
        result.push_back(smooth.of(motion_of_step(places, dt)));
      }
    return result;
  }



  template <int dim>
  NodalConstraints
  NodalStart<dim>::constraints_at(const StepContext<dim> &step,
                                  const Conditions       &conditions,
                                  const NodalTies        &ties,
                                  const double            part)
  {
    Assert(part >= 0 && part <= 1, ExcInternalError());
    StepContext<dim> until = step;
    until.time             = step.old_time + part * step.step_size();
    NodalConstraints constraints;
    constraints.reinit(step.nodes.n_local() * step.n_components,
                       step.nodes.control_entries(step.n_components));
    constrain_nodes(conditions, until, constraints);
    if (part > 0 && constraints.equations.empty())
      return constraints; // nothing but prescribed unknowns
    constraints.ties = ties;
    constraints.resolve(step.n_components);
    return constraints;
  }



  template <int dim>
  double
  NodalStart<dim>::acceleration_change(const StepContext<dim> &step,
                                       const NodalField       &unknowns,
                                       const TimeIntegrator   &scheme) const
  {
    std::array<double, 2> sums{}; // of the squares, and of the mass
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      {
        const double m = std::max(mass.lumped.local_element(node), 0.);
        sums[1] += m;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = node * dim + d;
            if (held[i]) // it is where it shall be
              continue;
            const double a_n = acceleration.local_element(i);
            const double a =
              scheme.acceleration(unknowns.local_element(
                                    node * step.n_components + d),
                                  velocity.local_element(i),
                                  a_n,
                                  step.step_size());
            sums[0] += m * (a - a_n) * (a - a_n);
          }
      }
    sum_over_ranks(sums, step.grid.communicator());
    return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0.;
  }



  template <int dim>
  double
  NodalStart<dim>::kinetic_energy(const StepContext<dim> &step) const
  {
    const PointArrays<dim> &points = step.points;
    double                  energy = 0;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        energy += points.mass[q] / 2 *
                  interpolate(step,
                              points.stencil(step.grid.geometry(), k, q),
                              velocity)
                    .norm_square();
    return energy;
  }



  template <int dim>
  Tensor<1, dim>
  interpolate(const StepContext<dim>                   &step,
              const typename PointArrays<dim>::Stencil &stencil,
              const NodalField                         &field)
  {
    Assert(invariants::fits(field, step.nodes, dim), ExcOtherNodes());
    Tensor<1, dim> value;
    for (unsigned int I = 0; I < stencil.n_nodes; ++I)
      {
        const unsigned int first = step.nodes.node(stencil.vertex[I]) * dim;
        for (unsigned int d = 0; d < dim; ++d)
          value[d] += stencil.shape[I] * field.local_element(first + d);
      }
    return value;
  }



  template Tensor<1, 2>
  interpolate(const StepContext<2> &,
              const PointArrays<2>::Stencil &,
              const NodalField &);
  template Tensor<1, 3>
  interpolate(const StepContext<3> &,
              const PointArrays<3>::Stencil &,
              const NodalField &);
  template class NodalStart<2>;
  template class NodalStart<3>;
} // namespace isochor
