/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What the constraints of a step mean for velocities and accelerations.

#include <isochor/dynamics/inertia_term.h>
#include <isochor/equations/invariants.h>
#include <isochor/grid/prescribed_motion.h>

#include <algorithm>
#include <tuple>

namespace isochor
{
  namespace
  {
    /** Those of @p all that have a @p place in another field, which an equation
     * has all or none of its entries in. */
    template <typename Place>
    Followers
    select_followers(const Followers &all, const Place &place)
    {
      Followers result;
      for (unsigned int k = 0; k < all.size(); ++k)
        {
          if (place(all.entry[k]) == numbers::invalid_unsigned_int)
            continue;
          result.entry.push_back(place(all.entry[k]));
          result.value.push_back(all.value[k]);
          result.flags.push_back(all.flags[k]);
          for (std::size_t i = all.start[k]; i < all.start[k + 1]; ++i)
            {
              result.master.push_back(place(all.master[i]));
              result.weight.push_back(all.weight[i]);
            }
          result.start.push_back(result.master.size());
        }
      return result;
    }
  } // namespace



  template <int dim>
  void
  InertiaTerm<dim>::prescribe(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    const NodalConstraints                                     &constraints)
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
    const NodalConstraints &start  = at[0];
    const SmoothStart       smooth = smooth_start(dt);
    held.assign(step.nodes.n_local() * dim, 0);
    if (kept_part > 0)
      {
        NodalConstraints ties_only;
        ties_only.reinit(step.nodes.n_local() * nc);
        ties_only.ties = constraints.ties;
        ties_only.resolve(nc);
        step.nodes.initialize(projected, dim);
        project(
          step, momentum, displacement_followers(ties_only, nc), {}, projected);
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

    followers = displacement_followers(start, nc);
    given_velocity.clear();
    given_acceleration.clear();
    if (!start.equations.empty())
      {
        const auto starts = starts_of_followers(at, nc, dt);
        for (const auto &[v, a] : starts)
          {
            given_velocity.push_back(v);
            given_acceleration.push_back(a);
          }
      }
    project_velocity(step);
    project_acceleration(step, conditions, start);
    prescribed = true;
  }



  template <int dim>
  void
  InertiaTerm<dim>::project_velocity(const StepContext<dim> &step)
  {
    project(step, momentum, followers, given_velocity, velocity);
  }



  template <int dim>
  void
  InertiaTerm<dim>::project_acceleration(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    const NodalConstraints                                     &start)
  {
    // those of a grid that is kept are those of the last step
    if (by_stresses && !prescribed && step.mixed() && !step.grid_is_kept)
      leave_out_unfelt_pressure(step, start);
    if (by_stresses && !prescribed)
      collect_boundary_forces(step, conditions);
    project(
      step, force, followers, given_acceleration, acceleration, by_stresses);
  }



  template <int dim>
  std::vector<std::pair<double, double>>
  InertiaTerm<dim>::starts_of_followers(const Places      &at,
                                        const unsigned int n_components,
                                        const double       dt) const
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
      all[k] = displacement_followers(at[k], n_components);
    std::vector<std::pair<double, double>> result;
    for (unsigned int f = 0; f < all[0].size(); ++f)
      {
        std::array<double, n_motion_places> places;
        for (unsigned int k = 0; k < n_motion_places; ++k)
          places[k] = all[k].value[f];
        result.push_back(smooth_start(dt).of(motion_of_step(places, dt)));
      }
    return result;
  }



  template <int dim>
  NodalConstraints
  InertiaTerm<dim>::constraints_at(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    const NodalTies                                            &ties,
    const double                                                part) const
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
  Followers
  InertiaTerm<dim>::displacement_followers(const NodalConstraints &constraints,
                                           const unsigned int      n_components)
  {
    AssertDimension(constraints.constrained.size() % n_components, 0u);
    return select_followers(constraints.followers,
                            [n_components](const unsigned int entry) {
                              return entry % n_components == dim ?
                                       numbers::invalid_unsigned_int :
                                       entry / n_components * dim +
                                         entry % n_components;
                            });
  }



  template <int dim>
  Followers
  InertiaTerm<dim>::pressure_followers(const NodalConstraints &constraints)
  {
    AssertDimension(constraints.constrained.size() % (dim + 1), 0u);
    return select_followers(constraints.followers,
                            [](const unsigned int entry) {
                              return entry % (dim + 1) == dim ?
                                       entry / (dim + 1) :
                                       numbers::invalid_unsigned_int;
                            });
  }



  template <int dim>
  void
  InertiaTerm<dim>::set_trial_increments(const StepContext<dim> &step,
                                         NodalConstraints &constraints) const
  {
    Assert(invariants::fits(velocity, step.nodes, dim), ExcOtherNodes());
    Assert(invariants::fits(acceleration, step.nodes, dim), ExcOtherNodes());
    const unsigned int nc        = step.n_components;
    const auto         increment = [this](const unsigned int i) {
      return trial.size * (velocity.local_element(i) +
                           trial.size / 2 * acceleration.local_element(i));
    };
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (constraints.constrained[node * nc + d])
          constraints.increment[node * nc + d] = increment(node * dim + d);
    if (constraints.equations.empty())
      return;
    for (auto &equation : constraints.equations)
      {
        // an equation has displacements or pressures, not both
        if (constraints.entry[equation.first] % nc == dim)
          continue;
        equation.value = 0;
        for (std::size_t i = equation.first; i < equation.last; ++i)
          equation.value += constraints.coefficient[i] *
                            increment(constraints.entry[i] / nc * dim +
                                      constraints.entry[i] % nc);
      }
    constraints.resolve(nc);
  }



  template void
  InertiaTerm<2>::prescribe(
    const StepContext<2> &,
    const std::vector<std::unique_ptr<BoundaryCondition<2>>> &,
    const NodalConstraints &);
  template std::vector<std::pair<double, double>>
  InertiaTerm<2>::starts_of_followers(const Places &,
                                      const unsigned int,
                                      const double) const;
  template Followers
  InertiaTerm<2>::displacement_followers(const NodalConstraints &,
                                         const unsigned int);
  template Followers
  InertiaTerm<2>::pressure_followers(const NodalConstraints &);
  template void
  InertiaTerm<2>::set_trial_increments(const StepContext<2> &,
                                       NodalConstraints &) const;
  template void
  InertiaTerm<3>::prescribe(
    const StepContext<3> &,
    const std::vector<std::unique_ptr<BoundaryCondition<3>>> &,
    const NodalConstraints &);
  template std::vector<std::pair<double, double>>
  InertiaTerm<3>::starts_of_followers(const Places &,
                                      const unsigned int,
                                      const double) const;
  template Followers
  InertiaTerm<3>::displacement_followers(const NodalConstraints &,
                                         const unsigned int);
  template Followers
  InertiaTerm<3>::pressure_followers(const NodalConstraints &);
  template void
  InertiaTerm<3>::set_trial_increments(const StepContext<3> &,
                                       NodalConstraints &) const;
} // namespace isochor
