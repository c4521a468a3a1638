/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/rigid_body/rigid_move.h>

namespace isochor
{
  namespace
  {
    using Vector3 = Tensor<1, 3>;

    template <int dim>
    Vector3
    in_space(const Tensor<1, dim> &v)
    {
      Vector3 result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = v[d];
      return result;
    }



    template <int dim>
    Tensor<1, dim>
    in_dim(const Vector3 &v)
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = v[d];
      return result;
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  RigidComponents<dim>::translation(const Values &values)
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = values[d];
    return result;
  }



  template <int dim>
  Tensor<1, 3>
  RigidComponents<dim>::rotation(const Values &values)
  {
    Tensor<1, 3> result;
    for (unsigned int r = 0; r < n_rotations; ++r)
      result[axis(r)] = values[dim + r];
    return result;
  }



  template <int dim>
  RigidMove<dim>::RigidMove(const RigidPose<dim>              &old,
                            const typename Components::Values &increments)
    : pose_n(old)
    , new_pose(old)
    , turn(Components::rotation(increments))
  {
    new_pose.displacement += Components::translation(increments);
    const Tensor<2, 3> R = turn.matrix();
    Tensor<2, dim>     part;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        part[i][j] = R[i][j];
    new_pose.rotation = part * pose_n.rotation;
    // the columns of T by the rows of its transpose
    for (unsigned int k = 0; k < 3; ++k)
      {
        Vector3 e;
        e[k]                 = 1;
        const Vector3 pulled = turn.pull_back(e);
        for (unsigned int r = 0; r < Components::n_rotations; ++r)
          spins[r][k] = pulled[Components::axis(r)];
      }
  }



  template <int dim>
  typename RigidMove<dim>::Vectors
  RigidMove<dim>::motion(const Point<dim> &x) const
  {
    Vectors result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d][d] = 1;
    const Vector3 arm =
      in_space<dim>(x - new_pose.reference - new_pose.displacement);
    for (unsigned int r = 0; r < Components::n_rotations; ++r)
      result[dim + r] = in_dim<dim>(cross_product_3d(spins[r], arm));
    return result;
  }



  template <int dim>
  Tensor<2, dim>
  RigidMove<dim>::motion_by_x(const unsigned int component) const
  {
    Tensor<2, dim> result;
    for (unsigned int b = 0; b < dim && component >= dim; ++b)
      {
        Vector3 e;
        e[b]                 = 1;
        const Vector3 column = cross_product_3d(spins[component - dim], e);
        for (unsigned int a = 0; a < dim; ++a)
          result[a][b] = column[a];
      }
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  RigidMove<dim>::second_motion(const Point<dim>  &x,
                                const unsigned int i,
                                const unsigned int j) const
  {
    if (i < dim || j < dim)
      return Tensor<1, dim>();
    // x - c - u = exp([Δθ]×) times the arm at the start of the step
    const Vector3 arm = in_space<dim>(
      pose_n.rotation * (new_pose.original(x) - pose_n.reference));
    return in_dim<dim>(turn.second_derivative(Components::axis(i - dim),
                                              Components::axis(j - dim),
                                              arm));
  }



  template <int dim>
  typename RigidMove<dim>::Vectors
  RigidMove<dim>::normal_change(const Point<dim>        &x,
                                const ClosestPoint<dim> &closest) const
  {
    // n(x) = R n_0(X(x)): it spins, and x moves backwards along the surface
    Vectors result = motion(x);
    for (unsigned int c = 0; c < Components::n; ++c)
      {
        result[c] = -(closest.curvature * result[c]);
        if (c >= dim)
          result[c] += in_dim<dim>(
            cross_product_3d(spins[c - dim], in_space<dim>(closest.normal)));
      }
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  RigidMove<dim>::velocity(const Point<dim> &x, const double dt) const
  {
    return (x - pose_n.place(new_pose.original(x))) / dt;
  }



  template struct RigidComponents<2>;
  template struct RigidComponents<3>;
  template class RigidMove<2>;
  template class RigidMove<3>;
} // namespace isochor
