/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_body_h
#define isochor_rigid_body_h

#include <isochor/base/statistics.h>
#include <isochor/rigid_body/rigid_inertia.h>
#include <isochor/rigid_body/rigid_motion.h>
#include <isochor/rigid_body/rigid_move.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * A rigid body, described by a subsection "Rigid body: NAME": its shape, its
   * motion, of which each component is prescribed, fixed or free, and its own
   * equations for those that are free. It is the same on all ranks.
   *
   * In a step the increments Δu and Δθ of what is free are unknowns, see
   * RigidMove. If a rotation is free, those that are prescribed have the
   * increments of their formulas as components of Δθ; if none is, the rotation
   * is exp([θ(t)]×).
   */
  template <int dim>
  class RigidBody
  {
  public:
    static constexpr unsigned int n_rotations =
      RigidComponents<dim>::n_rotations;
    static constexpr unsigned int n_components = RigidComponents<dim>::n;
    /** One number for each component, see RigidComponents. */
    using Components = typename RigidComponents<dim>::Values;
    using Matrix     = typename RigidComponents<dim>::Matrix;

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
    /** Whether a component is an unknown. */
    bool
    is_free(const unsigned int component) const
    {
      return motion.is_free(component);
    }
    bool
    has_free_components() const
    {
      return motion.has_free_components();
    }
    /** Whether what is prescribed moves from @p start to @p end. */
    bool
    is_moved(const double start, const double end) const
    {
      return motion.prescribed(start) != motion.prescribed(end);
    }
    /** @throws ExcMessage if what is free has no mass. In dynamics. */
    void
    check_inertia() const
    {
      inertia.check(section, motion);
    }

    /** At the start of the step. */
    const RigidPose<dim> &
    old_pose() const
    {
      return pose_n;
    }
    /** The step to @p time with these @p increments of what is free; those of
     * other components are ignored. It knows the pose at its end, and how what
     * touches the rigid body moves. */
    RigidMove<dim>
    move(const double time, const Components &increments) const
    {
      return RigidMove<dim>(pose_n, complete(time, increments));
    }
    /** What @p x sees of the surface, in space. */
    ClosestPoint<dim>
    closest(const Point<dim> &x, const RigidPose<dim> &pose) const;

    /** The equations of what is free, without forces of contact: inertia minus
     * force and moment (N, N m), in statics (a @p scheme without a step)
     * without the former; work-conjugate to the increments. The @p matrix is
     * the derivative of the @p residual; 0 in rows and columns of other
     * components. */
    void
    equations(const double       time,
              const RigidScheme &scheme,
              const Components  &increments,
              Components        &residual,
              Matrix            &matrix) const;

    /** A trial step of dynamics begins or, if it has no size, is over. */
    void
    set_trial(const TrialMotion &trial)
    {
      motion.set_trial(trial);
    }
    /** What is free goes on as it does at the start of the step: its increments
     * after @p dt. */
    Components
    coast(const double dt) const
    {
      return inertia.coast(dt, rotation_in_space());
    }
    /** What is free has the acceleration at the start of the step that these
     * @p forces and moments give it, loads included. */
    void
    accelerate(const Components &forces)
    {
      inertia.accelerate(forces, rotation_in_space(), motion);
    }
    /** Of what is free (J), at the start of the step. */
    double
    kinetic_energy() const
    {
      return inertia.kinetic_energy(motion);
    }
    /** The step to @p time has converged. */
    void
    advance(const double       time,
            const RigidScheme &scheme,
            const Components  &increments);

    /** Displacement and rotation at the end of the step, before advance(). */
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
    /** Those of what is free, and those that are prescribed. */
    Components
    complete(const double time, const Components &increments) const;
    /** In 2D, too, as a matrix in space. */
    Tensor<2, 3>
    rotation_in_space() const;
    Tensor<1, 3>
    total_after(const double time, const Components &all_increments) const;

    std::string                      section, own_name;
    std::unique_ptr<RigidShape<dim>> own_shape;
    RigidMotion<dim>                 motion;
    RigidInertia<dim>                inertia;
    /** At the start of the step: time, pose, and the rotation vector, which is
     * continuous in time. */
    double         old_time = 0;
    RigidPose<dim> pose_n;
    Tensor<1, 3>   total;
  };
} // namespace isochor

#endif
