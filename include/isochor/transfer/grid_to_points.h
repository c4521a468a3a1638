/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_to_points_h
#define isochor_grid_to_points_h

#include <isochor/dynamics/inertia_term.h>
#include <isochor/transfer/unseen_volume.h>

#include <vector>

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
    /** @p is_measured: energy() will be asked for. */
    void
    measure_energy(const bool is_measured)
    {
      measures_energy = is_measured;
    }

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

    /** See UnseenVolume::apply(). Collective. */
    void
    pass_unseen_volume(const StepContext<dim> &step,
                       const bool              grid_is_reset,
                       MaterialPoints<dim>    &points,
                       PointArrays<dim>       &of_step);

    /** This rank's Σ_p |V_p τ:Δε| of the step, in dynamics plus the kinetic
     * energy (J). */
    double
    energy() const
    {
      return step_energy;
    }

    /** In the u-p form, by point of the last transfer(): θ^e - p/K. */
    const std::vector<double> &
    volume_excess() const
    {
      return excesses;
    }

  private:
    std::vector<double> excesses;
    UnseenVolume<dim>   unseen_volume;
    bool                measures_energy = false;
    double              step_energy     = 0;
  };
} // namespace isochor

#endif
