/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What one-sided walls mean for velocities and accelerations.

#include <isochor/dynamics/inertia_term.h>
#include <isochor/grid/prescribed_motion.h>

namespace isochor
{
  template <int dim>
  void
  InertiaTerm<dim>::hold_pressed(const StepContext<dim> &step,
                                 double WallMotion::*const start,
                                 NodalField               &field)
  {
    for (const StoppedAtWall &node : pressed.components)
      {
        held[node.entry] = 1;
        if (node.entry < step.nodes.n_owned() * dim)
          field.local_element(node.entry) = node.wall.*start;
      }
  }


  template <int dim>
  void
  InertiaTerm<dim>::note_pressed(const StepContext<dim> &step,
                                 const NodalConstraints &constraints,
                                 const Places           &contact,
                                 const Places           &at)
  {
    const unsigned int nc = step.n_components;
    pressed.components    = stopped;
    pressed.followers     = {};
    pressed.velocity.clear();
    pressed.acceleration.clear();
    bool walls = false;
    for (const auto &equation : contact[0].equations)
      walls = walls || equation.how == NodalConstraints::in_contact;
    // what a wall along an axis holds may also follow a periodic
    // partner or a tie, or be followed
    if (!contact[0].equations.empty() || !constraints.ties.node.empty())
      for (const auto how : contact[0].constrained)
        walls = walls || how == NodalConstraints::in_contact;
    if (Utilities::MPI::max(walls ? 1 : 0, step.grid.communicator()) == 0)
      return;
    Places all;
    for (unsigned int k = 0; k < n_motion_places; ++k)
      {
        // see constraints_at()
        all[k] = k > 0 && contact[k].equations.empty() ? at[k] : contact[k];
        all[k].ties = constraints.ties;
        all[k].resolve(nc);
      }
    pressed.followers = displacement_followers(all[0], nc);
    for (const auto &[v, a] : starts_of_followers(all, nc, step.step_size()))
      {
        pressed.velocity.push_back(v);
        pressed.acceleration.push_back(a);
      }
  }


  template <int dim>
  void
  InertiaTerm<dim>::note_stopping_walls(const Places      &constraints,
                                        const unsigned int n_components,
                                        const double       dt)
  {
    stopped_along.clear();
    const NodalConstraints &start = constraints[0];
    for (unsigned int k = 0; !trial.walls_lead && k < start.equations.size();
         ++k)
      {
        const auto &equation = start.equations[k];
        if (equation.how != NodalConstraints::in_contact)
          continue;
        StoppedAlongWall wall;
        wall.wall =
          wall_motion(motion_of_step({{equation.value,
                                       constraints[1].equations[k].value,
                                       constraints[2].equations[k].value,
                                       constraints[3].equations[k].value}},
                                     dt),
                      dt);
        for (std::size_t i = equation.first; i < equation.last; ++i)
          wall.direction.emplace_back(start.entry[i] / n_components * dim +
                                        start.entry[i] % n_components,
                                      start.coefficient[i]);
        stopped_along.push_back(wall);
      }
  }


  template <int dim>
  WallMotion
  InertiaTerm<dim>::wall_motion(const MotionAtStart &motion,
                                const double         dt) const
  {
    const SmoothStart smooth = smooth_start(dt);
    const auto        start  = smooth.of(motion);
    const auto        end    = smooth.of(motion.after(dt));
    return {motion, start.first, start.second, end.first, end.second};
  }


  template <int dim>
  double
  InertiaTerm<dim>::excess_acceleration(const WallMotion &wall) const
  {
    return wall.acceleration_at_end -
           integrator->inertial_acceleration(wall.acceleration_at_start,
                                             wall.acceleration_at_end);
  }


  template <int dim>
  void
  InertiaTerm<dim>::stop_at_walls()
  {
    const auto set =
      [](const StoppedAlongWall &wall, NodalField &field, const double value) {
        double sum = 0, square = 0;
        for (const auto &[i, a] : wall.direction)
          {
            sum += a * field.local_element(i);
            square += a * a;
          }
        for (const auto &[i, a] : wall.direction)
          field.local_element(i) += a / square * (value - sum);
      };
    for (const StoppedAlongWall &wall : stopped_along)
      {
        set(wall, at_end.velocity, wall.wall.velocity_at_end);
        set(wall, at_end.acceleration, wall.wall.acceleration_at_end);
        set(wall, at_end.excess, excess_acceleration(wall.wall));
      }
  }



  template void
  InertiaTerm<2>::note_pressed(const StepContext<2> &,
                               const NodalConstraints &,
                               const Places &,
                               const Places &);
  template void
  InertiaTerm<2>::hold_pressed(const StepContext<2> &,
                               double WallMotion::*const,
                               NodalField &);
  template void
  InertiaTerm<2>::note_stopping_walls(const Places &,
                                      const unsigned int,
                                      const double);
  template WallMotion
  InertiaTerm<2>::wall_motion(const MotionAtStart &, const double) const;
  template void
  InertiaTerm<2>::stop_at_walls();
  template double
  InertiaTerm<2>::excess_acceleration(const WallMotion &) const;
  template void
  InertiaTerm<3>::note_pressed(const StepContext<3> &,
                               const NodalConstraints &,
                               const Places &,
                               const Places &);
  template void
  InertiaTerm<3>::hold_pressed(const StepContext<3> &,
                               double WallMotion::*const,
                               NodalField &);
  template void
  InertiaTerm<3>::note_stopping_walls(const Places &,
                                      const unsigned int,
                                      const double);
  template WallMotion
  InertiaTerm<3>::wall_motion(const MotionAtStart &, const double) const;
  template void
  InertiaTerm<3>::stop_at_walls();
  template double
  InertiaTerm<3>::excess_acceleration(const WallMotion &) const;
} // namespace isochor
