/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_to_points_h
#define isochor_grid_to_points_h

#include <isochor/dynamics/inertia_term.h>
#include <isochor/transfer/volume_projection.h>

namespace isochor
{
  /**
   * What the points take from the nodes at the end of a step;
   * pressure_mapping.h is the way back. The only place that changes points
   * within a step, so that a step that fails has nothing to undo.
   */
  template <int dim>
  class GridToPoints
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    /** @p measure_energy: whether energy() will be asked for. */
    void
    parse_parameters(ParameterHandler          &prm,
                     const BodyQuadrature<dim> &quadrature,
                     const bool                 measure_energy);

    /**
     * The points move with Σ N_I Δu_I and get F, stress, history, the pressure
     * Σ N_I p_I, P(38), and in dynamics velocity and acceleration. @p of_step,
     * the arrays that @p step reads, get the new F, too.
     */
    void
    transfer(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const InertiaTerm<dim> &inertia,
             MaterialPoints<dim>    &points,
             PointArrays<dim>       &of_step);

    /** Bring the volume change of the @p points, which have moved, near that
     * of the pressure field, if asked for. @p of_step: see transfer().
     * Collective. */
    void
    project_volume(const StepContext<dim> &step,
                   MaterialPoints<dim>    &points,
                   PointArrays<dim>       &of_step);

    /** This rank's Σ_p |V_p τ:Δε| of the step, in dynamics plus the kinetic
     * energy (J). */
    double
    energy() const
    {
      return step_energy;
    }

  private:
    VolumeProjection<dim> volume_projection;
    bool                  projects_volume = false;
    bool                  measures_energy = false;
    double                step_energy     = 0;
  };
} // namespace isochor

#endif
