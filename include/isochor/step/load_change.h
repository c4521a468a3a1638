/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_load_change_h
#define isochor_load_change_h

namespace isochor
{
  /** From one time to a later one (s); none if it ends before it starts. */
  struct TimeInterval
  {
    double start = 0, end = -1;

    bool
    empty() const
    {
      return end < start;
    }
  };

  /** How the loads change in a step. */
  struct LoadChange
  {
    /** The sum over nodes and components of the change of their forces (N),
     * which hardly depends on the grid, as shape functions are not negative; 0
     * if that is rounding. */
    double size = 0;
    /** The cosine of the angle between these forces of all nodes and those by
     * which the loads change in another interval of time: 1 if it is the same
     * loading, 0 if one of them is zero. */
    double likeness = 0;
  };
} // namespace isochor

#endif
