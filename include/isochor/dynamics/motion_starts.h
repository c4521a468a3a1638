/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_motion_starts_h
#define isochor_motion_starts_h

#include <isochor/boundary_condition/boundary_condition.h>

#include <memory>
#include <vector>

namespace isochor
{
  /**
   * The times at which prescribed motions may start, stop or change their
   * acceleration at once: where a condition in a formula that depends on the
   * time alone changes between true and false, or the order of the arguments of
   * min() or max(), or the sign of that of abs(), see switches_in_time().
   * The same on all ranks.
   */
  template <int dim>
  class MotionStarts
  {
  public:
    /** Collect the formulas of @p conditions. */
    void
    initialize(
      const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions);

    /** The first such time (s) behind @p from up to @p to, or infinity. A
     * switch that changes twice between them is not seen. */
    double
    next(const double from, const double to) const;

    /** Whether a motion prescribes other displacements at @p to than at @p from
     * anywhere in @p grid. */
    bool
    any_moves(const BackgroundGrid<dim> &grid,
              const double               from,
              const double               to) const;

  private:
    std::vector<Expression<dim>> motions;
    /** Change their sign where the motions start. */
    std::vector<Expression<dim>> switches;
  };
} // namespace isochor

#endif
