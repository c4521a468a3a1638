/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_move_h
#define isochor_rigid_move_h

#include <isochor/base/finite_rotation.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <array>

namespace isochor
{
  /** Where a rigid body is: a place X of t = 0 is at x = c + u + R (X - c). */
  template <int dim>
  struct RigidPose
  {
    Point<dim>     reference;    ///< c (m)
    Tensor<1, dim> displacement; ///< u (m)
    Tensor<2, dim> rotation = unit_symmetric_tensor<dim>();

    /** x of a place @p X of t = 0. */
    Point<dim>
    place(const Point<dim> &X) const
    {
      return reference + displacement + rotation * (X - reference);
    }
    /** X of a place @p x. */
    Point<dim>
    original(const Point<dim> &x) const
    {
      return reference + transpose(rotation) * (x - reference - displacement);
    }
  };

  /** The increments of a rigid body: along the axes (m), then the rotation (2D)
   * or the rotation vector (3D; rad). Vectors of rotations have three
   * components in 2D, too, of which the last one counts. */
  template <int dim>
  struct RigidComponents
  {
    static constexpr unsigned int n_rotations = (dim == 2 ? 1 : 3);
    static constexpr unsigned int n           = dim + n_rotations;

    /** One number for each. */
    using Values = std::array<double, n>;
    using Matrix = std::array<Values, n>;

    /** The component of a rotation vector that is rotation @p r. */
    static constexpr unsigned int
    axis(const unsigned int r)
    {
      return dim == 2 ? 2 : r;
    }
    static Tensor<1, dim>
    translation(const Values &values);
    static Tensor<1, 3>
    rotation(const Values &values);
  };

  /**
   * A step of a rigid body from one pose to another by the increments Δu and
   * Δθ: u = u_n + Δu, R = exp([Δθ]×) R_n; and the derivatives with respect to
   * them that forces of contact need.
   */
  template <int dim>
  class RigidMove
  {
  public:
    using Components = RigidComponents<dim>;
    /** A vector for each component. */
    using Vectors = std::array<Tensor<1, dim>, Components::n>;

    RigidMove(const RigidPose<dim>              &old,
              const typename Components::Values &increments);

    /** At the start of the step. */
    const RigidPose<dim> &
    old_pose() const
    {
      return pose_n;
    }
    /** At its end. */
    const RigidPose<dim> &
    pose() const
    {
      return new_pose;
    }

    /** How the material place of the rigid body at @p x moves with each
     * increment, ∂x/∂Δ. A force f on it does the work f·∂x/∂Δ. */
    Vectors
    motion(const Point<dim> &x) const;
    /** How motion() of an increment changes with @p x. */
    Tensor<2, dim>
    motion_by_x(const unsigned int component) const;
    /** ∂²x/∂Δ_i∂Δ_j of the same place; zero but for rotations. */
    Tensor<1, dim>
    second_motion(const Point<dim>  &x,
                  const unsigned int i,
                  const unsigned int j) const;
    /** How the normal at a fixed place @p x changes with each increment; @p
     * closest is what x sees at the end of the step. The distance changes by
     * -normal·∂x/∂Δ. */
    Vectors
    normal_change(const Point<dim> &x, const ClosestPoint<dim> &closest) const;
    /** The mean velocity (m/s) in the step of size @p dt of the material place
     * that is at @p x at its end. */
    Tensor<1, dim>
    velocity(const Point<dim> &x, const double dt) const;

  private:
    RigidPose<dim> pose_n, new_pose;
    FiniteRotation turn;
    /** How the rotation spins with each component of its increment. */
    std::array<Tensor<1, 3>, Components::n_rotations> spins;
  };
} // namespace isochor

#endif
