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
   * prescribed there: they follow by springs, whose mean a SurfaceCorrection
   * takes care of. In statics a gap that is a considerable part of what deforms
   * the body is warned of. (In dynamics a body that has just been hit has
   * hardly moved, and the gap that comes with its inertia is a large part of
   * that.)
   *
   * Springs that are too stiff are told of, too: where functions linear in a
   * cell can't follow what is prescribed, gaps alternate along the surface, and
   * the springs take up work that the body does not, Σ t·g of the work Σ t·ū
   * of their forces t on all surfaces, g the gap; of its affine part, which is
   * corrected, there is none. Forces are too large by about that share.
   */
  template <int dim>
  class SurfaceGap
  {
  public:
    /** What gaps are measured by at the end of the step, by component (m): by
     * how much displacements prescribed on all surfaces have differed; if they
     * don't differ their size, and where surfaces are held in place how far the
     * body has moved. Collective. */
    std::array<double, dim>
    scale(const StepContext<dim>       &step,
          const NodalField             &unknowns,
          const BoundaryPoints<dim>    &points,
          const SurfaceForces<dim>     &forces,
          const SurfaceConditions<dim> &conditions) const;

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
    };
    struct SpringWork
    {
      std::vector<Work> by_surface;
      /** Whether nothing else loads the body, but for loads elsewhere that are
       * in balance. */
      bool alone = false;
    };
    /** Collective. */
    SpringWork
    find_work(const StepContext<dim>       &step,
              const NodalField             &unknowns,
              const BoundaryPoints<dim>    &points,
              const SurfaceForces<dim>     &forces,
              const SurfaceConditions<dim> &conditions) const;
    /** Warn of springs that are too stiff or too soft. */
    void
    check_work(const StepContext<dim>       &step,
               const SpringWork             &work,
               const SurfaceConditions<dim> &conditions,
               const std::string            &penalty_parameter);

    struct Motion
    {
      /** By component, the largest in the run (m): by how much the
       * displacements prescribed on all surfaces differ; or, if they don't,
       * their size. */
      std::array<double, dim> deformation{};
      /** By component: how far the nodes have gone that move most, summed over
       * the steps (m). Where surfaces are held in place, what counts is this.
       */
      std::array<double, dim> way{};

      std::array<double, dim>
      scale() const;
    };

    /** motion, and what this step adds to it. */
    Motion
    motion_at_end(const StepContext<dim>       &step,
                  const NodalField             &unknowns,
                  const BoundaryPoints<dim>    &points,
                  const SurfaceForces<dim>     &forces,
                  const SurfaceConditions<dim> &conditions) const;

    /** Up to the start of the step. */
    Motion motion;
    /** The largest work of all targets in the run (J). */
    double largest_work = 0;
  };
} // namespace isochor

#endif
