/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nodal_constraints_h
#define isochor_nodal_constraints_h

#include <vector>

namespace isochor
{
  /**
   * Prescribed increments of nodal unknowns over a step: entry
   * n_components * node + component, nodes as in ActiveNodes. If several
   * conditions name the same unknown, the last one counts.
   */
  struct NodalConstraints
  {
    std::vector<unsigned char> constrained;
    std::vector<double>        increment;

    void
    reinit(const unsigned int n_entries)
    {
      constrained.assign(n_entries, 0);
      increment.assign(n_entries, 0.);
    }

    void
    constrain(const unsigned int entry, const double value)
    {
      constrained[entry] = 1;
      increment[entry]   = value;
    }
  };
} // namespace isochor

#endif
