/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_inertia_term_h
#define isochor_inertia_term_h

#include <isochor/dynamics/nodal_end.h>

#include <memory>

namespace isochor
{
  template <int dim>
  class BodyQuadrature;
  class LoadStepping;

  /** A step that looks for the acceleration at the start of another one. */
  struct TrialStep
  {
    double size; ///< positive or negative (s)
    /** With the prescribed motions as they were up to then. */
    bool is_past;
    /** The size of the steps that these motions start or go on with (s). */
    double step_size;
    /** Whether the velocities change, too. */
    bool with_velocity;
  };



  /**
   * Inertia with the consistent mass matrix, R_u = M ((1 - α) a_{n+1} + α a_n),
   * and all that goes with it: velocities and accelerations of the nodes are
   * the projections of those of the points (MassMatrix), where displacements
   * are prescribed those of the prescribed motion; TimeIntegrator gives
   * a_{n+1} and v_{n+1} at the end of the step, and the points take
   *   a_p = Σ N_I a_I,  v_p = Σ N_I v_I + η (v_p,n - Σ N_I v_n,I),
   * with η the part that is kept of what the nodes can't represent (0: all
   * velocity is interpolated, PIC; 1: increments are, FLIP) and v_n,I without
   * constraints. Where the scheme is statics there is nothing of all this.
   *
   * The acceleration a_n that a step starts with is either this projection, or
   * (`Acceleration = from stresses`) the solution of
   *   M a_n = f_ext(t_n) - Σ_p V_p σ_p ∇_n N_I + Σ_p m_p N_I d_p,
   * with d = a_n - ((1 - α) a_n + α a_{n-1}), its excess over what forces gave,
   * carried by the points beside a_n itself. Over a step the forces that do
   * work are then those of one grid, and what kinetic energy loses strain
   * energy gains, whatever cells the points are in. With nodal pressures σ_p is
   * without what they can't represent on this grid, see
   * leave_out_unfelt_pressure(). Where steps_over_waves(), a step whose grid,
   * points or free nodes are others than before takes the projection: stresses
   * made on another grid are not in equilibrium on this one.
   */
  template <int dim>
  class InertiaTerm : public EquationTerm<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler          &prm,
                     const BodyQuadrature<dim> &quadrature);

    /** Whether the scheme has inertia. If not, nothing below has any effect. */
    bool
    is_active() const
    {
      return integrator && integrator->has_inertia();
    }

    /** Whether steps start with the acceleration that stresses and loads give;
     * points have an excess acceleration then. */
    bool
    is_from_stresses() const
    {
      return is_active() && from_stresses;
    }

    /** @p unknowns have the nodes' pressures if the grid of the step is kept.
     */
    void
    take_pressures(const StepContext<dim> &step, const NodalField &unknowns);
    /** Those of the forces that the step started with, if it did; else null. */
    const NodalField *
    unknowns_at_start() const
    {
      return is_active() && !in_trial() ? start.unknowns_at_start() : nullptr;
    }
    /** TimeIntegrator::end_weight() of a step that starts from stresses. */
    double
    end_weight() const
    {
      return unknowns_at_start() != nullptr ? integrator->end_weight() : 0.5;
    }
    /** Take the points as they are at the start of the step. If it @p carries
     * accelerations, as the first one does, those of the points count in any
     * case. Collective. */
    void
    start_step(
      const StepContext<dim>                                     &step,
      const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
      MaterialPoints<dim>                                        &points,
      const bool                                                  carries);

    /** The error that the projections of velocities and accelerations to the
     * nodes have left in this step, of the size of what is projected. */
    double
    projection_error() const
    {
      return start.worst_projection;
    }

    /** Nodes are held anew by @p constraints, in a way that has @p changed or
     * not; the step ends at @p end. Do what follows from that. Collective. */
    void
    constrain(
      const StepContext<dim>                                     &step,
      const double                                                end,
      const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
      const bool                                                  changed,
      NodalConstraints                                           &constraints);

    /**
     * Look for the acceleration at the start of @p step, the first one or one
     * at whose start a prescribed motion jumps. From now on the equations are
     * those of the @p trial_step of size h, whose acceleration is constant and
     * in equilibrium with what acts at its end:
     *   Δu = h v_n + h²/2 a,   M a + f_int(u_n + Δu) = f_ext(t_n).
     * Pressures that a constraint or a bulk modulus which the step does not
     * resolve answer with are part of it. (Newmark's β = 1/2, γ = 1: a_n has no
     * influence.)
     */
    void
    start_trial(
      const StepContext<dim>                                     &step,
      const TrialStep                                            &trial_step,
      const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions);
    /**
     * A trial was successful: add half of its acceleration to those of the
     * points. Where prescribed motions start, what the step does not resolve
     * has to follow at once, or it would oscillate with each step: the points
     * get the velocity (a_+ - a_-) h/4, which is V where the motion in both
     * trials is all prescribed, and of second order in h for what h resolves.
     * What trials with the motion of the past find is subtracted: the points
     * get what the start changes, and nothing where it isn't felt. Collective.
     */
    void
    finish_trial(const StepContext<dim> &step,
                 const NodalField       &unknowns,
                 PointArrays<dim>       &points);
    bool
    in_trial() const
    {
      return trial.size != 0;
    }
    /** Back to those of a step. */
    void
    end_trial(
      const StepContext<dim>                                     &step,
      const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions);

    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;

    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override;

    /** The step has converged: compute what move_point() needs. The velocity
     * follows from the means that the equations have of forces,
     * StepContext::end_weight; the acceleration, which the next step starts
     * with or takes its excess from, is that of the forces at the end: @p
     * force_of_mean is what the residual changes by with these, or empty if
     * they are the same. */
    void
    finish_step(const StepContext<dim> &step,
                const NodalField       &unknowns,
                const NodalField       &force_of_mean);

    /**
     * Estimate (m) of what the displacements that the @p step has found are
     * wrong by, as it is not shorter: the part of third order in Δt of what the
     * scheme says of a motion whose jerk is constant,
     *   e = m Δt² (a_{n+1} - a_n)
     * with m of NewmarkFamily::smooth_start() (1/6 - β of the trapezoidal rule:
     * Zienkiewicz & Xie, Earthq. Eng. Struct. Dyn. 20 (1991) 871-887), root
     * mean square over the mass of the body. Collective.
     */
    double
    error_of_step(const StepContext<dim> &step,
                  const NodalField       &unknowns) const;

    /**
     * The work (J) of prescribed motions that jump as the @p step begins: the
     * impulses that give the nodes they hold another velocity at once, times
     * the mean of the velocities before and after, are the kinetic energy that
     * the step starts with minus that of the @p points at the end of the last
     * one. At t = 0, where the energy of what moves is no work, minus that
     * which the points start with. This rank's part.
     */
    double
    work_of_jump(const StepContext<dim>    &step,
                 const MaterialPoints<dim> &points,
                 const LoadStepping        &time) const;

    /** Write velocity and acceleration of point @p q at the end of the step
     * into its @p properties. Returns its kinetic energy (J). */
    double
    move_point(const StepContext<dim>                   &step,
               const typename PointArrays<dim>::Stencil &stencil,
               const unsigned int                        q,
               const PointLayout                        &layout,
               const ArrayView<double>                  &properties) const
    {
      return is_active() ?
               at_end.move_point(step, stencil, q, layout, properties) :
               0.;
    }

    /** Velocity (m/s) of the body at t = 0, formulas in x, y(, z). */
    std::string initial_velocity;

  private:
    /** The increments of a trial: those of the prescribed motion in
     * @p constraints. Collective. */
    void
    set_trial_increments(const StepContext<dim> &step,
                         NodalConstraints       &constraints) const;
    /** Size of the step whose equations are assembled (s). */
    double
    step_size(const StepContext<dim> &step) const
    {
      return in_trial() ? trial.size : step.step_size();
    }
    /** The end of the motion that prescribed velocities and accelerations are
     * taken from: that of @p step, or a time before its start. */
    double
    end_of_motion(const StepContext<dim> &step) const
    {
      return trial.is_past ? std::max(0., step.old_time - trial.step_size / 4) :
                             step.time;
    }
    /** What a motion over a time @p dt (s) is to start with. */
    SmoothStart
    smooth_start(const double dt) const
    {
      return integrator->smooth_start(in_trial() ? trial.step_size : dt);
    }
    const TimeIntegrator &
    scheme() const
    {
      if (in_trial())
        return trial_integrator;
      return *integrator;
    }

    std::unique_ptr<TimeIntegrator> integrator;
    const NewmarkFamily             trial_integrator{0.5, 1., 0.};
    TrialStep                       trial{};
    bool                            from_stresses = false;
    /** Whether the last trial has changed the velocities. */
    bool starts_with_impulse = false;

    NodalStart<dim> start;
    NodalEnd<dim>   at_end;
    /** What assemble() works with. */
    struct
    {
      std::vector<unsigned int> nodes;
      std::vector<double>       mass, residual, matrix;
      NodalField                acceleration; ///< of the equation of motion
    } element;
  };



  /** Whether shear waves cross more than half of the smallest extent of each
   * body within @p step: their vibrations are not resolved then. Collective. */
  template <int dim>
  bool
  steps_over_waves(const StepContext<dim> &step);
} // namespace isochor

#endif
