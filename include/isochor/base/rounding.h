/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rounding_h
#define isochor_rounding_h

namespace isochor
{
  /** What rounding may leave of a number that should be zero, relative to the
   * numbers it was computed from. Results mustn't depend on these values: what
   * is real is larger than them by orders of magnitude. */
  namespace rounding
  {
    /** Of numbers as they are stored: some tens of the machine's. */
    constexpr double numbers = 1e-14;
    /** After some dozens of operations. */
    constexpr double arithmetic = 1e-12;
    /** Where sums, inverses or iterations have piled it up: sums over a body,
     * solutions of systems, places in cells that are slivers. */
    constexpr double accumulated = 1e-9;
    /** Of places that were written to a file with some digits, or were moved
     * in many steps. */
    constexpr double places = 1e-6;
  } // namespace rounding
} // namespace isochor

#endif
