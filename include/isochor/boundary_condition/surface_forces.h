/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_forces_h
#define isochor_surface_forces_h

#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/boundary_condition/surface_conditions.h>
#include <isochor/boundary_condition/surface_correction.h>
#include <isochor/grid/prescribed_motion.h>

namespace isochor
{
  /**
   * Forces on the surface of the body, by boundary points b with reference area
   * A_b:
   *  - dead loads t per reference area: f_I = Σ_b N_I A_b t;
   *  - a follower pressure p per present area: f_I = -Σ_b N_I p a_b;
   *  - prescribed displacements ū by a penalty, component by component,
   *    f_I = -Σ_b N_I β (G/h) A_b (u_b - ū - c), u_b the total displacement of
   *    the point and c a SurfaceCorrection. The force of a surface on the body
   *    is Σ_b of that.
   * Formulas are in the reference position.
   */
  template <int dim>
  class SurfaceForces
  {
  public:
    /** All are kept by reference. */
    SurfaceForces(const SurfaceConditions<dim> &conditions,
                  BoundaryPoints<dim>          &points,
                  const SurfaceCorrection<dim> &correction)
      : conditions(conditions)
      , points(points)
      , correction(correction)
    {}

    /** Residual and tangent of one point; room for any number of nodes. */
    struct PointElement
    {
      std::vector<double> residual, matrix;

      void
      reinit(const unsigned int n_dofs, const bool with_matrix)
      {
        residual.assign(n_dofs, 0.);
        if (with_matrix)
          matrix.assign(n_dofs * n_dofs, 0.);
      }
    };

    /** Give the points that are not on domains the G of their penalty: that of
     * the body or, if it consists of several materials, the mean by volume
     * around the point's nodes. After the points are located. Collective. */
    void
    find_shear_moduli(const StepContext<dim> &step) const;

    const SurfaceCondition<dim> &
    condition_at(const unsigned int b) const
    {
      return conditions.surfaces[points.surface(b)];
    }

    /** Whether point @p b adds to the matrix; dead loads don't. */
    bool
    has_element(const unsigned int b) const
    {
      return condition_at(b).is_fixed() || !condition_at(b).pressure.empty();
    }

    /** Prescribed displacements are increments of a trial from now on, see
     * BoundaryCondition::set_trial(). */
    void
    set_trial(const StepContext<dim> &step,
              const double            trial_size,
              const SmoothStart      &smooth)
    {
      trial.size   = trial_size;
      trial.smooth = smooth;
      trial.start  = step.old_time;
      trial.end    = step.time;
    }

    /** See BoundaryCondition::append_motion(). */
    void
    append_motion(const double time, std::vector<double> &values) const;

    /** What component @p a of the displacement of point @p b, which has to be
     * prescribed, is to be at the end of the step or trial. */
    double
    target(const StepContext<dim> &step,
           const unsigned int      b,
           const unsigned int      a) const;

    /** Whether that is another place than before. */
    bool
    moves(const StepContext<dim> &step,
          const unsigned int      b,
          const unsigned int      a) const
    {
      if (trial.size != 0)
        return initial_motion(b, a) != std::pair<double, double>();
      return prescribed_increment(condition_at(b).displacement[a].front(),
                                  points.reference_location(b),
                                  step.old_time,
                                  step.time) != 0;
    }

    /** Whether it is for any of the points of this rank. */
    bool
    move_body(const StepContext<dim> &step) const;

    /** Whether points with a prescribed component have another velocity than
     * the body, which has @p velocity (dim per node). */
    bool
    starts_suddenly(const StepContext<dim> &step,
                    const NodalField       &velocity) const;

    /** β G/h A_b at point @p b (N/m). */
    double
    stiffness(const StepContext<dim> &step, const unsigned int b) const;

    /** The displacement of point @p b at the end of the step (m). */
    Tensor<1, dim>
    displacement(const StepContext<dim> &step,
                 const NodalField       &unknowns,
                 const unsigned int      b) const;

    /** The penalty's force on the body (N). */
    Tensor<1, dim>
    penalty_force(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  const unsigned int      b) const;

    /** Penalty and pressure at point @p b, entries by node and component. */
    EvaluationStatus
    evaluate_point(const StepContext<dim> &step,
                   const NodalField       &unknowns,
                   const unsigned int      b,
                   const bool              with_matrix,
                   PointElement           &element) const;

    /** The force of the loads at point @p b, dead ones and pressures, on the
     * body (N). */
    Tensor<1, dim>
    load(const StepContext<dim> &step,
         const NodalField       &unknowns,
         const unsigned int      b) const;

    /** EquationTerm::add_unit_residual() of the penalty. */
    void
    add_unit_residual(const StepContext<dim> &step, NodalField &scale) const;

    /** Add the dead loads (N) to nodal forces. */
    void
    add_dead_loads(const StepContext<dim> &step, NodalField &force) const;

  private:
    /** A_b at t = 0 (m^(dim-1); in axisymmetry m^2, of the ring). */
    double
    area(const StepContext<dim> &step, const unsigned int b) const;
    /** The dead load at a point (N), zero without. */
    Tensor<1, dim>
    dead_load(const StepContext<dim> &step, const unsigned int b) const;
    void
    add_penalty(const StepContext<dim> &step,
                const NodalField       &unknowns,
                const unsigned int      b,
                const bool              with_matrix,
                PointElement           &element) const;
    EvaluationStatus
    add_pressure(const StepContext<dim> &step,
                 const NodalField       &unknowns,
                 const unsigned int      b,
                 const bool              with_matrix,
                 PointElement           &element) const;

    /** V and A, components @p a of what the prescribed motion of point @p b
     * has to start with in the step that is tried. */
    std::pair<double, double>
    initial_motion(const unsigned int b, const unsigned int a) const;

    const SurfaceConditions<dim> &conditions;
    BoundaryPoints<dim>          &points;
    const SurfaceCorrection<dim> &correction;

    struct Trial
    {
      double      size  = 0;          ///< 0: none
      double      start = 0, end = 0; ///< of the step itself
      SmoothStart smooth;
    } trial;
  };
} // namespace isochor

#endif
