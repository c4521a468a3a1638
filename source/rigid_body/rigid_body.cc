/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/rigid_body/rigid_body.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace isochor
{
  RigidScheme
  RigidScheme::newmark(const double beta,
                       const double gamma,
                       const double dt,
                       const double alpha)
  {
    Assert(beta > 0 && dt > 0, ExcMessage("There is no such scheme."));
    RigidScheme scheme;
    scheme.acceleration = {
      {1 / (beta * dt * dt), -1 / (beta * dt), 1 - 0.5 / beta}};
    scheme.velocity = {
      {gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)}};
    for (unsigned int k = 0; k < 3; ++k)
      scheme.inertia[k] =
        (1 - alpha) * scheme.acceleration[k] + (k == 2 ? alpha : 0.);
    return scheme;
  }



  template <int dim>
  bool
  RigidBody<dim>::has_free_components() const
  {
    return std::any_of(free.begin(), free.end(), [](const bool is_free) {
      return is_free;
    });
  }



  template <int dim>
  double
  RigidBody<dim>::at(const Formula &formula, const double time)
  {
    return formula ? (*formula)(Point<dim>(), time) : 0.;
  }



  template <int dim>
  typename RigidBody<dim>::Vector3
  RigidBody<dim>::in_space(const Tensor<1, dim> &v)
  {
    Vector3 result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = v[d];
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  RigidBody<dim>::in_plane(const Vector3 &v)
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = v[d];
    return result;
  }



  template <int dim>
  bool
  RigidBody<dim>::rotation_is_free() const
  {
    return std::any_of(free.begin() + dim, free.end(), [](const bool is_free) {
      return is_free;
    });
  }



  template <int dim>
  typename RigidBody<dim>::Vector3
  RigidBody<dim>::prescribed_rotation(const double time) const
  {
    Vector3 result;
    for (unsigned int r = 0; r < n_rotations; ++r)
      result[axis(r)] = at(motions[dim + r], time);
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  RigidBody<dim>::translation_increment(const double      time,
                                        const Components &increments) const
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] =
        free[d] ? increments[d] : at(motions[d], time) - old.displacement[d];
    return result;
  }



  template <int dim>
  typename RigidBody<dim>::Vector3
  RigidBody<dim>::rotation_increment(const double      time,
                                     const Components &increments) const
  {
    if (!rotation_is_free())
      {
        // not to lose turns, which a rotation matrix doesn't count
        if (dim == 2)
          return prescribed_rotation(time) - old.total;
        return FiniteRotation::vector_of(
          FiniteRotation(prescribed_rotation(time)).matrix() *
          transpose(old.rotation));
      }
    Vector3 theta = prescribed_rotation(time) - prescribed_rotation(old.time);
    for (unsigned int r = 0; r < n_rotations; ++r)
      if (free[dim + r])
        theta[axis(r)] = increments[dim + r];
    return theta;
  }



  template <int dim>
  RigidPose<dim>
  RigidBody<dim>::old_pose() const
  {
    RigidPose<dim> pose;
    pose.displacement = old.displacement;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        pose.rotation[i][j] = old.rotation[i][j];
    return pose;
  }



  template <int dim>
  RigidPose<dim>
  RigidBody<dim>::pose(const double time, const Components &increments) const
  {
    RigidPose<dim> pose;
    pose.displacement =
      old.displacement + translation_increment(time, increments);
    const Tensor<2, 3> R =
      FiniteRotation(rotation_increment(time, increments)).matrix() *
      old.rotation;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        pose.rotation[i][j] = R[i][j];
    return pose;
  }



  template <int dim>
  Point<dim>
  RigidBody<dim>::place(const Point<dim> &X, const RigidPose<dim> &pose) const
  {
    return reference + pose.displacement + pose.rotation * (X - reference);
  }



  template <int dim>
  Point<dim>
  RigidBody<dim>::original(const Point<dim>     &x,
                           const RigidPose<dim> &pose) const
  {
    return reference +
           transpose(pose.rotation) * (x - reference - pose.displacement);
  }



  template <int dim>
  ClosestPoint<dim>
  RigidBody<dim>::closest(const Point<dim> &x, const RigidPose<dim> &pose) const
  {
    ClosestPoint<dim>     result = own_shape->closest(original(x, pose));
    const Tensor<2, dim> &R      = pose.rotation;
    result.point                 = place(result.point, pose);
    result.normal                = R * result.normal;
    result.curvature =
      symmetrize(R * Tensor<2, dim>(result.curvature) * transpose(R));
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  RigidBody<dim>::velocity(const Point<dim>     &x,
                           const RigidPose<dim> &pose,
                           const double          dt) const
  {
    return (x - place(original(x, pose), old_pose())) / dt;
  }



  template <int dim>
  std::array<typename RigidBody<dim>::Vector3, RigidBody<dim>::n_rotations>
  RigidBody<dim>::spins(const Vector3 &theta) const
  {
    // the columns of T by the rows of its transpose
    const FiniteRotation             rotation(theta);
    std::array<Vector3, n_rotations> result;
    for (unsigned int k = 0; k < 3; ++k)
      {
        Vector3 e;
        e[k]                 = 1;
        const Vector3 pulled = rotation.pull_back(e);
        for (unsigned int r = 0; r < n_rotations; ++r)
          result[r][k] = pulled[axis(r)];
      }
    return result;
  }



  template <int dim>
  std::array<Tensor<1, dim>, RigidBody<dim>::n_components>
  RigidBody<dim>::motion(const Point<dim> &x,
                         const double      time,
                         const Components &increments) const
  {
    std::array<Tensor<1, dim>, n_components> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d][d] = 1;
    const auto    spin = spins(rotation_increment(time, increments));
    const Vector3 arm =
      in_space(x - reference - pose(time, increments).displacement);
    for (unsigned int r = 0; r < n_rotations; ++r)
      result[dim + r] = in_plane(cross_product_3d(spin[r], arm));
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  RigidBody<dim>::second_motion(const Point<dim>  &x,
                                const double       time,
                                const Components  &increments,
                                const unsigned int i,
                                const unsigned int j) const
  {
    if (i < dim || j < dim)
      return Tensor<1, dim>();
    // x - c - u = exp(θ) (arm at the start of the step)
    const FiniteRotation turn(rotation_increment(time, increments));
    const Vector3        arm =
      transpose(turn.matrix()) *
      in_space(x - reference - pose(time, increments).displacement);
    return in_plane(turn.second_derivative(axis(i - dim), axis(j - dim), arm));
  }



  template <int dim>
  std::array<Tensor<1, dim>, RigidBody<dim>::n_components>
  RigidBody<dim>::normal_change(const Point<dim>        &x,
                                const ClosestPoint<dim> &closest,
                                const double             time,
                                const Components        &increments) const
  {
    // n(x) = R n_0(X(x)): it spins, and x moves backwards along the surface
    const auto moves = motion(x, time, increments);
    const auto spin  = spins(rotation_increment(time, increments));
    std::array<Tensor<1, dim>, n_components> result;
    for (unsigned int c = 0; c < n_components; ++c)
      {
        result[c] = -(closest.curvature * moves[c]);
        if (c >= dim)
          result[c] +=
            in_plane(cross_product_3d(spin[c - dim], in_space(closest.normal)));
      }
    return result;
  }



  template <int dim>
  std::vector<typename RigidShape<dim>::Facet>
  RigidBody<dim>::surface(const RigidPose<dim> &pose, const double reach) const
  {
    auto facets = own_shape->surface(reach);
    for (auto &facet : facets)
      for (Point<dim> &corner : facet)
        corner = place(corner, pose);
    return facets;
  }



  template class RigidBody<2>;
  template class RigidBody<3>;
} // namespace isochor
