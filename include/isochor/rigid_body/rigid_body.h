/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_body_h
#define isochor_rigid_body_h

#include <isochor/base/expression.h>
#include <isochor/base/finite_rotation.h>
#include <isochor/base/statistics.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace isochor
{
  /** Where a rigid body is: a place X of t = 0 is at x = c + u + R (X - c),
   * with the reference point c, the displacement u (m) and the rotation R. */
  template <int dim>
  struct RigidPose
  {
    Tensor<1, dim> displacement;
    Tensor<2, dim> rotation = unit_symmetric_tensor<dim>();
  };

  /** What a scheme in time makes of the increment Δ of a step and of velocity
   * and acceleration at its start: their coefficients, in this order. All are
   * zero in statics. */
  struct RigidScheme
  {
    /** The acceleration in the equation of motion; the acceleration and the
     * velocity at the end of the step. */
    std::array<double, 3> inertia{}, acceleration{}, velocity{};

    bool
    is_static() const
    {
      return inertia[0] == 0;
    }

    /** Newmark's scheme over a step of size @p dt, Bossak's for @p alpha ≠ 0.
     */
    static RigidScheme
    newmark(const double beta,
            const double gamma,
            const double dt,
            const double alpha = 0);
  };

  /**
   * A rigid body, described by a subsection "Rigid body: NAME": its shape, its
   * motion, of which each component is prescribed, fixed or free, and its own
   * equations for those that are free. It is the same on all ranks.
   *
   * The components are the displacement of the reference point along the axes
   * (m), then the rotation (2D) or the rotation vector (3D; rad) about it. What
   * is free has as unknowns of a step the increments Δu and Δθ: u = u_n + Δu,
   * R = exp([Δθ]×) R_n. The centre of mass is the reference point.
   */
  template <int dim>
  class RigidBody
  {
  public:
    static constexpr unsigned int n_rotations  = (dim == 2 ? 1 : 3);
    static constexpr unsigned int n_components = dim + n_rotations;
    /** One number for each component. */
    using Components = std::array<double, n_components>;
    using Matrix     = std::array<Components, n_components>;

    /** In the subsection of a rigid body. */
    static void
    declare_parameters(ParameterHandler &prm);
    /** @param section "Rigid body: NAME". */
    explicit RigidBody(const std::string &section);
    /** In the subsection. @throws ExcMessage for what contradicts itself. */
    void
    parse_parameters(ParameterHandler &prm);
    /** The parameters of the subsection that matter: those of other shapes
     * don't. */
    std::set<std::string>
    parameters_in_use() const;

    const std::string &
    name() const
    {
      return own_name;
    }
    const RigidShape<dim> &
    shape() const
    {
      return *own_shape;
    }
    /** "x", "y", "rotation", or "x", "y", "z", "rx", "ry", "rz". */
    static const std::vector<std::string> &
    component_names();
    /** Whether a component is an unknown. */
    bool
    is_free(const unsigned int component) const
    {
      return free[component];
    }
    bool
    has_free_components() const;
    /** @throws ExcMessage if what is free has no mass. In dynamics. */
    void
    check_inertia() const;

    /** At the start of the step. */
    RigidPose<dim>
    old_pose() const;
    /** At @p time, the end of the step, with these @p increments of what is
     * free; others are ignored. */
    RigidPose<dim>
    pose(const double time, const Components &increments) const;
    /** The same if what is free stays where it is. */
    RigidPose<dim>
    prescribed_pose(const double time) const
    {
      return pose(time, Components());
    }

    /** x of a place X of t = 0. */
    Point<dim>
    place(const Point<dim> &X, const RigidPose<dim> &pose) const;
    /** X of a place x. */
    Point<dim>
    original(const Point<dim> &x, const RigidPose<dim> &pose) const;
    /** What @p x sees of the surface, in space. */
    ClosestPoint<dim>
    closest(const Point<dim> &x, const RigidPose<dim> &pose) const;
    /** The mean velocity (m/s) in the step of size @p dt of the material place
     * that is at @p x at its end. */
    Tensor<1, dim>
    velocity(const Point<dim>     &x,
             const RigidPose<dim> &pose,
             const double          dt) const;

    /** How the material place of the rigid body at @p x moves with each
     * increment, ∂x/∂Δ. A force f on it does the work f·∂x/∂Δ. */
    std::array<Tensor<1, dim>, n_components>
    motion(const Point<dim> &x,
           const double      time,
           const Components &increments) const;
    /** ∂²x/∂Δ_i∂Δ_j of the same place; zero but for rotations. */
    Tensor<1, dim>
    second_motion(const Point<dim>  &x,
                  const double       time,
                  const Components  &increments,
                  const unsigned int i,
                  const unsigned int j) const;
    /** How the normal at a fixed place @p x changes with each increment, with
     * what closest() gives there. The distance changes by -normal·∂x/∂Δ. */
    std::array<Tensor<1, dim>, n_components>
    normal_change(const Point<dim>        &x,
                  const ClosestPoint<dim> &closest,
                  const double             time,
                  const Components        &increments) const;

    /** The equations of what is free without forces of contact: inertia minus
     * Force and Moment, in statics (a @p scheme of zeros) without the former;
     * work-conjugate to the increments (N, N m). The @p matrix is the
     * derivative of the @p residual; 0 in rows and columns of other components.
     */
    void
    equations(const double       time,
              const RigidScheme &scheme,
              const Components  &increments,
              Components        &residual,
              Matrix            &matrix) const;

    /** The step to @p time has converged. */
    void
    advance(const double       time,
            const RigidScheme &scheme,
            const Components  &increments);

    /** The displacement and rotation at the end of the step, before advance().
     */
    void
    set_statistics(const double      time,
                   const Components &increments,
                   Statistics       &statistics) const;
    std::string
    save_state() const;
    void
    load_state(const std::string &text);

    /** The surface in space, for pictures: see RigidShape::surface(). */
    std::vector<typename RigidShape<dim>::Facet>
    surface(const RigidPose<dim> &pose, const double reach) const;

  private:
    using Vector3 = Tensor<1, 3>;
    using Formula = std::unique_ptr<Expression<dim>>;

    void
    parse_free(const std::string &list);
    void
    parse_loads(ParameterHandler &prm);
    void
    parse_inertia(ParameterHandler &prm);
    /** Pose, velocity and acceleration of t = 0. */
    void
    start();

    /** 0 if there is no formula. */
    static double
    at(const Formula &formula, const double time);
    /** The rotation component of a rotation vector: z in 2D. */
    static constexpr unsigned int
    axis(const unsigned int r)
    {
      return dim == 2 ? 2 : r;
    }
    static Vector3
    in_space(const Tensor<1, dim> &v);
    static Tensor<1, dim>
    in_plane(const Vector3 &v);
    bool
    rotation_is_free() const;
    Vector3
    prescribed_rotation(const double time) const;
    /** All increments of the step to @p time. */
    Tensor<1, dim>
    translation_increment(const double      time,
                          const Components &increments) const;
    Vector3
    rotation_increment(const double time, const Components &increments) const;
    Vector3
    total_rotation(const double time, const Vector3 &theta) const;
    /** How the rotation spins with each component of its increment. */
    std::array<Vector3, n_rotations>
    spins(const Vector3 &theta) const;
    void
    rotation_equations(const double       time,
                       const RigidScheme &scheme,
                       const Vector3     &theta,
                       Components        &residual,
                       Matrix            &matrix) const;

    std::string                      section, own_name;
    std::unique_ptr<RigidShape<dim>> own_shape;
    Point<dim>                       reference; ///< c
    std::vector<Formula>             motions, loads;
    std::array<bool, n_components>   free{};
    double                           mass = 0;
    /** About the axes at t = 0; in 2D about z. */
    Vector3    moment_of_inertia;
    Components initial_velocity{};

    /** At the start of the step: the pose; the rotation vector, continuous in
     * time; velocity and acceleration, those of the rotation in the axes of the
     * body. */
    struct State
    {
      double         time = 0;
      Tensor<1, dim> displacement, velocity, acceleration;
      Tensor<2, 3>   rotation = unit_symmetric_tensor<3>();
      Vector3        total, angular_velocity, angular_acceleration;
    };
    State old;
  };
} // namespace isochor

#endif
