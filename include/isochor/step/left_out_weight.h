/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_left_out_weight_h
#define isochor_left_out_weight_h

#include <isochor/step/step_setup.h>

namespace isochor
{
  /** What the stabilisation takes for the body's weight, whose pressure it
   * leaves out. */
  template <int dim>
  class LeftOutWeight
  {
  public:
    /** Gravity at the end of the step; with inertia only if conditions hold
     * bodies up that never were apart, as @p were_apart remembers. Collective.
     */
    void
    set(Scene<dim>             &scene,
        const StepSetup<dim>   &setup,
        const NodalConstraints &constraints,
        bool                   &were_apart);

  private:
    /** How many bodies apart from each other the active nodes form (0: not
     * counted yet). */
    unsigned int n_parts = 0;
  };
} // namespace isochor

#endif
