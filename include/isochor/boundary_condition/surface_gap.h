/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_gap_h
#define isochor_surface_gap_h

#include <isochor/boundary_condition/surface_forces.h>

#include <array>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * How far surfaces of the body stay behind the displacements that are
   * prescribed there: they follow by springs. In statics a gap that is a
   * considerable part of what deforms the body makes forces too small by as
   * much, and is warned of. (In dynamics a body that has just been hit has
   * hardly moved, and the gap that comes with its inertia is a large part of
   * that.)
   *
   * Springs that are too stiff are told of, too: where functions linear in a
   * cell can't follow what is prescribed, gaps alternate along the surface, and
   * the springs take up work that the body does not. Of the work of the forces
   * t = k g of the springs of all surfaces, Σ t·ū, that is
   *   Σ k g·g - (Σ k g·ū)²/(Σ k ū·ū),
   * by surface, without the part of the gap g that goes like ū, as a soft
   * spring's does. Forces are too large by about that share.
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
    /** The work of the springs of a surface, in sums over its points (J). */
    struct Work
    {
      double of_targets = 0; ///< Σ t·ū
      double of_gaps    = 0; ///< Σ t·g
      double scale      = 0; ///< Σ k ū·ū
    };
    /** Warn of springs that are too stiff, where none is too @p soft. */
    void
    check_work(const StepContext<dim>       &step,
               const std::vector<Work>      &work,
               const SurfaceConditions<dim> &conditions,
               const bool                    soft,
               const std::string            &penalty_parameter);
    /** By surface. Collective. */
    std::vector<Work>
    find_work(const StepContext<dim>       &step,
              const NodalField             &unknowns,
              const BoundaryPoints<dim>    &points,
              const SurfaceForces<dim>     &forces,
              const SurfaceConditions<dim> &conditions) const;
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
    /** The largest work of all targets in the run (J). */
    double largest_work = 0;
  };
} // namespace isochor

#endif
