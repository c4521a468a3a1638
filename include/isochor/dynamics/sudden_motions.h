/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_sudden_motions_h
#define isochor_sudden_motions_h

#include <isochor/boundary_condition/boundary_condition.h>

#include <limits>
#include <string>

namespace isochor
{
  /** Of a prescribed motion. */
  struct Jump
  {
    static constexpr double never = std::numeric_limits<double>::infinity();

    double      time        = never; ///< (s)
    double      precision   = 0;     ///< of the time (s)
    bool        is_of_place = false; ///< or of the velocity or acceleration
    std::string parameter;           ///< that prescribes it
  };

  /**
   * Whether a motion that @p condition prescribes starts or stops suddenly, its
   * acceleration jumps by a tenth of the largest one or more, or its place
   * does, from shortly before the start of @p step to shortly before its end.
   * The formulas are looked at between the step's ends: what changes as much
   * over ever shorter times jumps, however large derivatives are elsewhere. Of
   * several jumps the largest one counts. Collective.
   */
  template <int dim>
  Jump
  find_jump(const StepContext<dim>       &step,
            const BoundaryCondition<dim> &condition);
} // namespace isochor

#endif
