/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_inertia_h
#define isochor_rigid_inertia_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/rigid_body/rigid_motion.h>

#include <array>
#include <iosfwd>
#include <string>

namespace isochor
{
  /** The trapezoidal rule: what it makes of an increment and of velocity and
   * acceleration at the start of a step at its end. Zero in statics. */
  struct RigidScheme
  {
    double rate; ///< 2/Δt (1/s); 0 in statics

    /** Of a step of size @p dt, 0 in statics. */
    explicit RigidScheme(const double dt = 0)
      : rate(dt > 0 ? 2 / dt : 0.)
    {}

    template <typename Value>
    Value
    velocity(const Value &increment, const Value &velocity) const
    {
      return rate > 0 ? Value(rate * increment - velocity) : Value();
    }

    template <typename Value>
    Value
    acceleration(const Value &increment,
                 const Value &velocity,
                 const Value &acceleration) const
    {
      return rate > 0 ?
               Value(rate * (rate * increment - 2 * velocity) - acceleration) :
               Value();
    }
  };

  /** Mass and moments of inertia of a rigid body, velocity and acceleration at
   * the start of a step, and the equations of motion. The centre of mass is the
   * reference point. Those of the rotation are in the axes of the body: J A + Ω
   * × J Ω = Rᵀ M, with the scheme applied to Θ = R_nᵀ Δθ (Simo & Vu-Quoc,
   * Comput. Methods Appl. Mech. Eng. 66 (1988) 125-161). */
  template <int dim>
  class RigidInertia
  {
  public:
    using Components = RigidComponents<dim>;
    using Values     = typename Components::Values;
    using Matrix     = typename Components::Matrix;

    static void
    declare_parameters(ParameterHandler &prm);
    /** In the subsection @p section. */
    void
    parse_parameters(ParameterHandler       &prm,
                     const std::string      &section,
                     const RigidMotion<dim> &motion);
    /** @throws ExcMessage if what is free in @p motion has no mass. */
    void
    check(const std::string &section, const RigidMotion<dim> &motion) const;

    /** At t = 0: the acceleration that the @p loads cause, with the @p rotation
     * there. */
    void
    start(const Values           &loads,
          const Tensor<2, 3>     &rotation,
          const RigidMotion<dim> &motion);

    /** The acceleration that @p forces cause. */
    void
    accelerate(const Values           &forces,
               const Tensor<2, 3>     &rotation,
               const RigidMotion<dim> &motion);
    /** Increments after @p dt with velocity and acceleration as they are. */
    Values
    coast(const double dt, const Tensor<2, 3> &rotation) const;

    /** Inertia minus @p loads, work-conjugate to the @p increments, and the
     * derivative, of what is free; 0 elsewhere. @p rotation is that at the
     * start of the step. */
    void
    equations(const RigidScheme      &scheme,
              const Values           &increments,
              const Values           &loads,
              const Tensor<2, 3>     &rotation,
              const RigidMotion<dim> &motion,
              Values                 &residual,
              Matrix                 &matrix) const;

    /** The step with these @p increments has converged. */
    void
    advance(const RigidScheme  &scheme,
            const Values       &increments,
            const Tensor<2, 3> &rotation);

    /** Of what is free in @p motion (J). */
    double
    kinetic_energy(const RigidMotion<dim> &motion) const;

    void
    save(std::ostream &state) const;
    void
    load(std::istream &state);

  private:
    using Vector3 = Tensor<1, 3>;

    /** About the axes at t = 0; in 2D the last one. */
    Vector3 moments;
    double  mass = 0;
    Values  initial_velocity{};
    /** At the start of the step, of the rotation in the axes of the body. */
    Tensor<1, dim> velocity, acceleration;
    Vector3        angular_velocity, angular_acceleration;
  };
} // namespace isochor

#endif
