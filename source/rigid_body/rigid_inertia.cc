/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/utilities.h>

#include <isochor/base/component_formulas.h>
#include <isochor/rigid_body/rigid_inertia.h>

#include <istream>
#include <ostream>

namespace isochor
{
  namespace
  {
    using Vector3 = Tensor<1, 3>;

    Vector3
    scale(const Vector3 &by, const Vector3 &v)
    {
      return Vector3({by[0] * v[0], by[1] * v[1], by[2] * v[2]});
    }
  } // namespace



  template <int dim>
  void
  RigidInertia<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry("Mass",
                      "0",
                      Patterns::Double(0),
                      "The mass (kg) of what is free, for scenes with "
                      "inertia.");
    prm.declare_entry(
      "Moment of inertia",
      "0",
      Patterns::List(Patterns::Double(0), 1, Components::n_rotations),
      dim == 2 ? "About the reference point (kg m²)." :
                 "About the axes through the reference point at t = 0, "
                 "which have to be the principal axes (kg m²): one "
                 "number for all, or three.");
    prm.declare_entry("Initial velocity",
                      "",
                      Patterns::Anything(),
                      "Of free components at t = 0, in scenes with inertia "
                      "(m/s, rad/s): 'y=-2'.");
  }



  template <int dim>
  void
  RigidInertia<dim>::parse_parameters(ParameterHandler       &prm,
                                      const std::string      &section,
                                      const RigidMotion<dim> &motion)
  {
    constexpr unsigned int n_rotations = Components::n_rotations;
    mass                               = prm.get_double("Mass");
    std::vector<double> list;
    for (const std::string &one :
         Utilities::split_string_list(prm.get("Moment of inertia")))
      list.push_back(number_in(one, section + "/Moment of inertia"));
    AssertThrow(list.size() == 1 || list.size() == n_rotations,
                ExcMessage("The parameter <" + section +
                           "/Moment of inertia> must be one number or " +
                           std::to_string(n_rotations) + "."));
    for (unsigned int r = 0; r < n_rotations; ++r)
      moments[Components::axis(r)] = list[list.size() == 1 ? 0 : r];
    const std::string parameter = section + "/Initial velocity";
    const auto        formulas =
      parse_component_formulas<dim>(prm.get("Initial velocity"),
                                    RigidMotion<dim>::names(),
                                    parameter,
                                    FormulaVariables::time);
    for (unsigned int c = 0; c < Components::n; ++c)
      if (formulas[c])
        {
          AssertThrow(motion.is_free(c),
                      ExcMessage("The parameter <" + parameter + "> names <" +
                                 RigidMotion<dim>::names()[c] +
                                 ">, which isn't free."));
          initial_velocity[c] = (*formulas[c])(Point<dim>(), 0.);
        }
  }



  template <int dim>
  void
  RigidInertia<dim>::check(const std::string      &section,
                           const RigidMotion<dim> &motion) const
  {
    for (unsigned int c = 0; c < Components::n; ++c)
      AssertThrow(!motion.is_free(c) ||
                    (c < dim ? mass : moments[Components::axis(c - dim)]) > 0,
                  ExcMessage("The parameter <" + section +
                             (c < dim ? "/Mass" : "/Moment of inertia") +
                             "> must be positive in a scene with inertia: the "
                             "component <" +
                             RigidMotion<dim>::names()[c] + "> is free."));
    AssertThrow(!motion.has_free_rotations() ||
                  !motion.has_prescribed_rotations(),
                ExcMessage("<" + section + "> has free rotations, <" + section +
                           "/Free>, and prescribed ones, <" + section +
                           "/Motion>. With inertia either all that move are "
                           "free or none."));
  }



  template <int dim>
  void
  RigidInertia<dim>::start(const Values           &loads,
                           const Tensor<2, 3>     &rotation,
                           const RigidMotion<dim> &motion)
  {
    velocity = Components::translation(initial_velocity);
    angular_velocity =
      transpose(rotation) * Components::rotation(initial_velocity);
    accelerate(loads, rotation, motion);
  }



  template <int dim>
  void
  RigidInertia<dim>::accelerate(const Values           &forces,
                                const Tensor<2, 3>     &rotation,
                                const RigidMotion<dim> &motion)
  {
    acceleration         = 0;
    angular_acceleration = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (motion.is_free(d) && mass > 0)
        acceleration[d] = forces[d] / mass;
    const Vector3 rest =
      transpose(rotation) * Components::rotation(forces) -
      cross_product_3d(angular_velocity, scale(moments, angular_velocity));
    for (unsigned int r = 0; r < Components::n_rotations; ++r)
      {
        const unsigned int i = Components::axis(r);
        if (motion.is_free(dim + r) && moments[i] > 0)
          angular_acceleration[i] = rest[i] / moments[i];
      }
  }



  template <int dim>
  typename RigidInertia<dim>::Values
  RigidInertia<dim>::coast(const double dt, const Tensor<2, 3> &rotation) const
  {
    const Tensor<1, dim> u = dt * (velocity + dt / 2 * acceleration);
    const Vector3        turn =
      rotation * (dt * (angular_velocity + dt / 2 * angular_acceleration));
    Values result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = u[d];
    for (unsigned int r = 0; r < Components::n_rotations; ++r)
      result[dim + r] = turn[Components::axis(r)];
    return result;
  }



  template <int dim>
  void
  RigidInertia<dim>::equations(const RigidScheme      &scheme,
                               const Values           &increments,
                               const Values           &loads,
                               const Tensor<2, 3>     &rotation,
                               const RigidMotion<dim> &motion,
                               Values                 &residual,
                               Matrix                 &matrix) const
  {
    residual.fill(0.);
    for (auto &row : matrix)
      row.fill(0.);
    for (unsigned int d = 0; d < dim; ++d)
      if (motion.is_free(d))
        {
          residual[d] =
            mass *
              scheme.acceleration(increments[d], velocity[d], acceleration[d]) -
            loads[d];
          matrix[d][d] = mass * scheme.rate * scheme.rate;
        }
    if (!motion.has_free_rotations())
      return;

    const Vector3 theta     = Components::rotation(increments),
                  moment    = Components::rotation(loads);
    const Tensor<2, 3> back = transpose(rotation);
    const Vector3      turn = back * theta;
    const Vector3      A    = scheme.acceleration(turn,
                                          angular_velocity,
                                          angular_acceleration),
                  spin      = scheme.velocity(turn, angular_velocity);
    const Vector3 h         = rotation * (scale(moments, A) +
                                  cross_product_3d(spin, scale(moments, spin)));
    // the work of R_{n+1} J A on δθ is that of Tᵀ(θ) exp([θ]×) h = T(θ) h, and
    // T(θ) = Tᵀ(-θ)
    const FiniteRotation forwards(theta), backwards(-theta);
    const Vector3 force = backwards.pull_back(h) - forwards.pull_back(moment);
    for (unsigned int s = 0; s < Components::n_rotations; ++s)
      {
        const unsigned int j = Components::axis(s);
        Vector3            e;
        e[j]                 = 1;
        const Vector3 d_turn = back * e, d_spin = scheme.rate * d_turn;
        const Vector3 dh =
          rotation * (scale(moments, scheme.rate * d_spin) +
                      cross_product_3d(d_spin, scale(moments, spin)) +
                      cross_product_3d(spin, scale(moments, d_spin)));
        const Vector3 d_force = backwards.pull_back(dh) -
                                backwards.pull_back_derivative(j, h) -
                                forwards.pull_back_derivative(j, moment);
        for (unsigned int r = 0; r < Components::n_rotations; ++r)
          if (motion.is_free(dim + r) && motion.is_free(dim + s))
            matrix[dim + r][dim + s] = d_force[Components::axis(r)];
      }
    for (unsigned int r = 0; r < Components::n_rotations; ++r)
      if (motion.is_free(dim + r))
        residual[dim + r] = force[Components::axis(r)];
  }



  template <int dim>
  void
  RigidInertia<dim>::advance(const RigidScheme  &scheme,
                             const Values       &increments,
                             const Tensor<2, 3> &rotation)
  {
    if (scheme.rate == 0)
      return;
    const Tensor<1, dim> u = Components::translation(increments);
    const Vector3 turn = transpose(rotation) * Components::rotation(increments);
    acceleration       = scheme.acceleration(u, velocity, acceleration);
    velocity           = scheme.velocity(u, velocity);
    angular_acceleration =
      scheme.acceleration(turn, angular_velocity, angular_acceleration);
    angular_velocity = scheme.velocity(turn, angular_velocity);
  }



  template <int dim>
  double
  RigidInertia<dim>::kinetic_energy(const RigidMotion<dim> &motion) const
  {
    double energy = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (motion.is_free(d))
        energy += mass / 2 * velocity[d] * velocity[d];
    // rotations that move are all free or none is
    if (motion.has_free_rotations())
      energy += angular_velocity * scale(moments, angular_velocity) / 2;
    return energy;
  }



  template <int dim>
  void
  RigidInertia<dim>::save(std::ostream &state) const
  {
    state << velocity << ' ' << acceleration << ' ' << angular_velocity << ' '
          << angular_acceleration << ' ';
  }



  template <int dim>
  void
  RigidInertia<dim>::load(std::istream &state)
  {
    for (auto *vector : {&velocity, &acceleration})
      for (unsigned int d = 0; d < dim; ++d)
        state >> (*vector)[d];
    for (auto *vector : {&angular_velocity, &angular_acceleration})
      for (unsigned int d = 0; d < 3; ++d)
        state >> (*vector)[d];
  }



  template class RigidInertia<2>;
  template class RigidInertia<3>;
} // namespace isochor
