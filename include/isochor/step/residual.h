/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_residual_h
#define isochor_residual_h

#include <isochor/nonlinear_solver/newton_solver.h>
#include <isochor/step/load_change.h>
#include <isochor/step/step_setup.h>

#include <vector>

namespace isochor
{
  /**
   * What is out of equilibrium at an iterate: the sum of the terms of the
   * equations, less the dead loads, its size, and the size below which it is
   * rounding.
   */
  template <int dim>
  class Residual
  {
  public:
    /** All arguments are kept by reference. */
    Residual(const Scene<dim>       &scene,
             const StepSetup<dim>   &setup,
             const NodalConstraints &constraints,
             MixedSystem<dim>       &system);

    /** The terms of the equations, in the order of their elements, first that
     * of the body. */
    std::vector<EquationTerm<dim> *> terms;

    /** The active nodes of the step are known. */
    void
    start_step();
    /** Evaluate the dead loads at the end of the step. Collective. */
    void
    set_loads();
    /** Find the residual that is rounding. Collective. */
    void
    compute_floor();

    /** Assemble residual, and matrix if @p with_matrix; @p at_start: the
     * @p unknowns are where the step starts. Collective. */
    ResidualNorms
    assemble(const NodalField &unknowns,
             const bool        with_matrix,
             const bool        at_start);

    /** After the last iterate @p unknowns: what its residual changes by if its
     * forces are those at the end of the step alone, without
     * StepContext::unknowns_at_start. Collective. */
    NodalField
    change_without_start(const NodalField &unknowns);

    /** What of the prescribed increments is still to come after the iterate
     * that was assembled last. */
    const NodalField &
    pending_increments() const
    {
      return pending;
    }
    /** Collective. */
    bool
    has_dead_loads() const
    {
      return external_force.l2_norm() > 0;
    }
    /** See Equilibrium::change_of_loads(). */
    LoadChange
    change_of_loads(const TimeInterval &other) const;

  private:
    /** Find what of the prescribed increments is still to come; whether there
     * is anything on this rank. */
    bool
    update_pending(const NodalField &unknowns);
    /** Whether a boundary condition sets this rank's part of the body in
     * motion; collects the forces of all of them. */
    bool
    update_boundary_force(const StepContext<dim> &step,
                          const NodalField       &unknowns,
                          const bool              at_start);
    EvaluationStatus
    assemble_terms(const StepContext<dim> &step,
                   const NodalField       &unknowns,
                   const bool              with_matrix);
    /** Sums over all ranks. */
    ResidualNorms
    measure(const EvaluationStatus status, const bool anything_pending) const;

    const Scene<dim>       &scene;
    const StepSetup<dim>   &setup;
    const NodalConstraints &constraints;
    MixedSystem<dim>       &system;

    NodalField pending;
    NodalField external_force;
    /** Forces of the boundary conditions that are terms of the equations. */
    NodalField boundary_force;
    double     force_floor = 0, volume_floor = 0;
    /** The part of the former that comes from strains. */
    double strain_floor = 0;
  };
} // namespace isochor

#endif
