/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_update_h
#define isochor_point_update_h

#include <isochor/inertia_term.h>
#include <isochor/volume_projection.h>

namespace isochor
{
  /**
   * What the points take from the nodes at the end of a step: they move with
   * Σ N_I Δu_I, and get F, stress, history, the pressure Σ N_I p_I, P(38), and
   * in dynamics velocity and acceleration. The only place that changes the
   * points, so that a failed step has nothing to undo.
   *
   * @p inertia is null in statics, @p volume_projection if it isn't used; then
   * it gets each point's excess of volume. @p step_energy, if not null,
   * becomes this rank's Σ_p |V_p τ:Δε|, in dynamics plus the kinetic energy.
   */
  template <int dim>
  void
  update_points(const StepContext<dim> &step,
                const NodalField       &unknowns,
                const InertiaTerm<dim> *inertia,
                VolumeProjection<dim>  *volume_projection,
                MaterialPoints<dim>    &points,
                double                 *step_energy);
} // namespace isochor

#endif
