/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_gap_h
#define isochor_surface_gap_h

#include <isochor/boundary_condition/surface_forces.h>

#include <array>
#include <string>

namespace isochor
{
  /**
   * How far surfaces of the body stay behind the displacements that are
   * prescribed there: they follow by springs. In statics a gap that is a
   * considerable part of what deforms the body makes forces too small by as
   * much, and is warned of. (In dynamics a body that has just been hit has
   * hardly moved, and the gap that comes with its inertia is a large part of
   * that.)
   */
  template <int dim>
  class SurfaceGap
  {
  public:
    /** At the end of a step that has converged, before the points advance.
     * @p penalty_parameter is the name of the parameter, for the message.
     * Collective. */
    void
    check(const StepContext<dim>       &step,
          const NodalField             &unknowns,
          const BoundaryPoints<dim>    &points,
          const SurfaceForces<dim>     &forces,
          const SurfaceConditions<dim> &conditions,
          const std::string            &penalty_parameter);

    /** One line. */
    std::string
    save_state() const;
    void
    load_state(const std::string &state);

  private:
    /** Let deformation follow the targets of this step. */
    void
    find_deformation(const StepContext<dim>       &step,
                     const NodalField             &unknowns,
                     const BoundaryPoints<dim>    &points,
                     const SurfaceForces<dim>     &forces,
                     const SurfaceConditions<dim> &conditions);

    /** By component, the largest in the run (m): by how much the displacements
     * prescribed on all surfaces differ; or, if they don't, their size. */
    std::array<double, dim> deformation{};
    /** By component: how far the nodes have gone that move most, summed over
     * the steps (m). Where surfaces are held in place, what counts is this. */
    std::array<double, dim> way{};
  };
} // namespace isochor

#endif
