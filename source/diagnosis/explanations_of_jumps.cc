/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/explanation.h>

// Of the warnings of prescribed motions that jump.
namespace isochor
{
  ISOCHOR_EXPLAIN(
    sudden_start,
    "a sudden start that fails",
    ISOCHOR_ESSENTIAL,
    "dynamics: where a prescribed motion jumps after t = 0 the trial steps "
    "that look for what follows at once did not converge",
    "let the motion begin and end smoothly, over some steps")
  ISOCHOR_EXPLAIN(
    many_jumps,
    "a motion of many jumps",
    ISOCHOR_ESSENTIAL,
    "dynamics: four steps in succession have begun where a prescribed motion "
    "jumps, as with a record given by straight lines that are shorter than the "
    "steps",
    "smaller steps, a tenth of the time between jumps, or a smoother motion")
  ISOCHOR_EXPLAIN(
    jump,
    "a motion that jumps",
    ISOCHOR_ESSENTIAL,
    "dynamics: the place that a prescribed motion (`Displacement`, `Walls`, "
    "`Rigid body`, `Interaction: name - place`) prescribes jumps at the time "
    "given (at t = 0: isn't the one that the body is in), or its velocity has "
    "no bounds there (as that of t^0.5 at 0; not of t^0.7 and steeper powers). "
    "Velocities and accelerations may jump: a step ends there, and the body "
    "follows at once",
    "let it move there over some steps")
} // namespace isochor
