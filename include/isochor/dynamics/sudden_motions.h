/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_sudden_motions_h
#define isochor_sudden_motions_h

#include <isochor/boundary_condition/boundary_condition.h>

#include <limits>

namespace isochor
{
  /** Where prescribed motions jump. */
  struct Jumps
  {
    static constexpr double never = std::numeric_limits<double>::infinity();

    /** Velocity or acceleration at the start of the step. */
    bool at_start = false;
    /** The next time that they do (s). */
    double next = never;
    /** The next time that the place does, or the velocity has no bounds (s). */
    double of_place = never;
    /** Those of velocities may be so long (s) after these times. */
    double precision = 0;
  };

  /**
   * Jumps of the motion that @p condition prescribes from the start of @p step
   * on, up to a step after its end or, if that is sooner, up to @p end: of
   * velocities, of accelerations by a tenth of the largest one or more of the
   * same unknown, and of places. The formulas are looked at between the ends:
   * what changes as much over ever shorter times jumps, however large
   * derivatives are elsewhere. A velocity that jumps a thousandth of the step
   * or @p start_precision (s) after its start, or less, jumps at the start.
   * Collective.
   */
  template <int dim>
  Jumps
  find_jumps(const StepContext<dim>       &step,
             const BoundaryCondition<dim> &condition,
             const double                  end,
             const double                  start_precision = 0);
} // namespace isochor

#endif
