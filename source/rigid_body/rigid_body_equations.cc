/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/rigid_body/rigid_body.h>

#include <cmath>
#include <limits>
#include <sstream>

// The equations of a rigid body, and what it remembers.

namespace isochor
{
  namespace
  {
    /** What the scheme makes of increment, velocity and acceleration. */
    template <typename Value>
    Value
    combine(const std::array<double, 3> &coefficients,
            const Value                 &increment,
            const Value                 &velocity,
            const Value                 &acceleration)
    {
      return coefficients[0] * increment + coefficients[1] * velocity +
             coefficients[2] * acceleration;
    }



    Tensor<1, 3>
    scale(const Tensor<1, 3> &by, const Tensor<1, 3> &v)
    {
      return Tensor<1, 3>({by[0] * v[0], by[1] * v[1], by[2] * v[2]});
    }
  } // namespace



  template <int dim>
  void
  RigidBody<dim>::start()
  {
    old = State();
    for (unsigned int d = 0; d < dim; ++d)
      {
        old.displacement[d] = at(motions[d], 0);
        old.velocity[d]     = initial_velocity[d];
        if (free[d] && mass > 0)
          old.acceleration[d] = at(loads[d], 0) / mass;
      }
    old.total    = prescribed_rotation(0);
    old.rotation = FiniteRotation(old.total).matrix();
    Vector3 spin, moment;
    for (unsigned int r = 0; r < n_rotations; ++r)
      {
        spin[axis(r)]   = initial_velocity[dim + r];
        moment[axis(r)] = at(loads[dim + r], 0);
      }
    const Tensor<2, 3> back = transpose(old.rotation);
    old.angular_velocity    = back * spin;
    const Vector3 rest =
      back * moment -
      cross_product_3d(old.angular_velocity,
                       scale(moment_of_inertia, old.angular_velocity));
    for (unsigned int r = 0; r < n_rotations; ++r)
      if (free[dim + r] && moment_of_inertia[axis(r)] > 0)
        old.angular_acceleration[axis(r)] =
          rest[axis(r)] / moment_of_inertia[axis(r)];
  }



  template <int dim>
  void
  RigidBody<dim>::equations(const double       time,
                            const RigidScheme &scheme,
                            const Components  &increments,
                            Components        &residual,
                            Matrix            &matrix) const
  {
    residual.fill(0.);
    for (auto &row : matrix)
      row.fill(0.);
    const auto u = translation_increment(time, increments);
    for (unsigned int d = 0; d < dim; ++d)
      if (free[d])
        {
          residual[d] = mass * combine(scheme.inertia,
                                       u[d],
                                       old.velocity[d],
                                       old.acceleration[d]) -
                        at(loads[d], time);
          matrix[d][d] = mass * scheme.inertia[0];
        }
    if (rotation_is_free())
      rotation_equations(
        time, scheme, rotation_increment(time, increments), residual, matrix);
  }



  template <int dim>
  void
  RigidBody<dim>::rotation_equations(const double       time,
                                     const RigidScheme &scheme,
                                     const Vector3     &theta,
                                     Components        &residual,
                                     Matrix            &matrix) const
  {
    // in the axes of the body, with Θ = R_nᵀ θ: J A + Ω × J Ω (Simo & Vu-Quoc,
    // Comput. Methods Appl. Mech. Eng. 66 (1988) 125-161); its work on δθ is
    // Tᵀ(θ) R_{n+1} h = T(θ) R_n h, and T(θ) = Tᵀ(-θ)
    const Tensor<2, 3> back = transpose(old.rotation);
    const Vector3     &J    = moment_of_inertia;
    const Vector3      turn = back * theta;
    const Vector3      A    = combine(scheme.inertia,
                              turn,
                              old.angular_velocity,
                              old.angular_acceleration),
                  spin      = combine(scheme.velocity,
                                 turn,
                                 old.angular_velocity,
                                 old.angular_acceleration);
    const Vector3 h =
      old.rotation * (scale(J, A) + cross_product_3d(spin, scale(J, spin)));
    Vector3 moment;
    for (unsigned int r = 0; r < n_rotations; ++r)
      moment[axis(r)] = at(loads[dim + r], time);
    const FiniteRotation forwards(theta), backwards(-theta);
    const Vector3 force = backwards.pull_back(h) - forwards.pull_back(moment);
    for (unsigned int s = 0; s < n_rotations; ++s)
      {
        const unsigned int j = axis(s);
        Vector3            e;
        e[j]                 = 1;
        const Vector3 d_turn = back * e, d_spin = scheme.velocity[0] * d_turn;
        const Vector3 dh =
          old.rotation * (scale(J, scheme.inertia[0] * d_turn) +
                          cross_product_3d(d_spin, scale(J, spin)) +
                          cross_product_3d(spin, scale(J, d_spin)));
        const Vector3 d_force = backwards.pull_back(dh) -
                                backwards.pull_back_derivative(j, h) -
                                forwards.pull_back_derivative(j, moment);
        for (unsigned int r = 0; r < n_rotations; ++r)
          if (free[dim + r] && free[dim + s])
            matrix[dim + r][dim + s] = d_force[axis(r)];
      }
    for (unsigned int r = 0; r < n_rotations; ++r)
      if (free[dim + r])
        residual[dim + r] = force[axis(r)];
  }



  template <int dim>
  typename RigidBody<dim>::Vector3
  RigidBody<dim>::total_rotation(const double time, const Vector3 &theta) const
  {
    if (!rotation_is_free())
      return prescribed_rotation(time);
    if (dim == 2)
      return old.total + theta;
    // of the rotation vectors of the same rotation that nearest to the last
    const Vector3 v =
      FiniteRotation::vector_of(FiniteRotation(theta).matrix() * old.rotation);
    const double angle = v.norm();
    if (angle == 0)
      return v;
    const Vector3 n = v / angle;
    const double  turns =
      std::round((old.total * n - angle) / (2 * numbers::PI));
    return (angle + 2 * numbers::PI * turns) * n;
  }



  template <int dim>
  void
  RigidBody<dim>::advance(const double       time,
                          const RigidScheme &scheme,
                          const Components  &increments)
  {
    State      next;
    const auto u      = translation_increment(time, increments);
    const auto theta  = rotation_increment(time, increments);
    const auto turn   = transpose(old.rotation) * theta;
    next.time         = time;
    next.displacement = old.displacement + u;
    next.velocity = combine(scheme.velocity, u, old.velocity, old.acceleration);
    next.acceleration =
      combine(scheme.acceleration, u, old.velocity, old.acceleration);
    next.total                = total_rotation(time, theta);
    next.rotation             = FiniteRotation(next.total).matrix();
    next.angular_velocity     = combine(scheme.velocity,
                                    turn,
                                    old.angular_velocity,
                                    old.angular_acceleration);
    next.angular_acceleration = combine(scheme.acceleration,
                                        turn,
                                        old.angular_velocity,
                                        old.angular_acceleration);
    if (scheme.is_static())
      {
        // what dynamics may begin with later
        next.velocity         = old.velocity;
        next.angular_velocity = old.angular_velocity;
      }
    old = next;
  }



  template <int dim>
  void
  RigidBody<dim>::set_statistics(const double      time,
                                 const Components &increments,
                                 Statistics       &statistics) const
  {
    const Tensor<1, dim> u =
      old.displacement + translation_increment(time, increments);
    const Vector3 total =
      total_rotation(time, rotation_increment(time, increments));
    for (unsigned int d = 0; d < dim; ++d)
      statistics.set("Translation " + component_names()[d] + " of rigid body " +
                       own_name + " (m)",
                     u[d]);
    for (unsigned int r = 0; r < n_rotations; ++r)
      statistics.set("Rotation" +
                       (dim == 2 ? "" : std::string(" ") + "xyz"[r]) +
                       " of rigid body " + own_name + " (rad)",
                     total[axis(r)]);
  }



  template <int dim>
  std::string
  RigidBody<dim>::save_state() const
  {
    std::ostringstream state;
    state.precision(std::numeric_limits<double>::max_digits10);
    state << old.time << ' ' << old.displacement << ' ' << old.velocity << ' '
          << old.acceleration << ' ' << old.rotation << ' ' << old.total << ' '
          << old.angular_velocity << ' ' << old.angular_acceleration;
    return state.str();
  }



  template <int dim>
  void
  RigidBody<dim>::load_state(const std::string &text)
  {
    std::istringstream state(text);
    const auto         read = [&state](auto &tensor) {
      for (unsigned int i = 0; i < tensor.n_independent_components; ++i)
        state >> tensor[tensor.unrolled_to_component_indices(i)];
    };
    state >> old.time;
    read(old.displacement);
    read(old.velocity);
    read(old.acceleration);
    read(old.rotation);
    read(old.total);
    read(old.angular_velocity);
    read(old.angular_acceleration);
    AssertThrow(state,
                ExcMessage("The state of <" + section +
                           "> in the checkpoint is incomplete."));
  }



  template void
  RigidBody<2>::start();
  template void
  RigidBody<2>::equations(const double,
                          const RigidScheme &,
                          const Components &,
                          Components &,
                          Matrix &) const;
  template void
  RigidBody<2>::advance(const double, const RigidScheme &, const Components &);
  template void
  RigidBody<2>::set_statistics(const double,
                               const Components &,
                               Statistics &) const;
  template std::string
  RigidBody<2>::save_state() const;
  template void
  RigidBody<2>::load_state(const std::string &);

  template void
  RigidBody<3>::start();
  template void
  RigidBody<3>::equations(const double,
                          const RigidScheme &,
                          const Components &,
                          Components &,
                          Matrix &) const;
  template void
  RigidBody<3>::advance(const double, const RigidScheme &, const Components &);
  template void
  RigidBody<3>::set_statistics(const double,
                               const Components &,
                               Statistics &) const;
  template std::string
  RigidBody<3>::save_state() const;
  template void
  RigidBody<3>::load_state(const std::string &);
} // namespace isochor
