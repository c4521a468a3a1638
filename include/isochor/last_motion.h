/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_last_motion_h
#define isochor_last_motion_h

#include <vector>

namespace isochor
{
  /** The nodal unknowns of the last step at this rank's active
   * nodes: what the next step's start is extrapolated from. */
  struct LastMotion
  {
    std::vector<unsigned int> vertices;
    std::vector<double>       unknowns;      ///< n_components per vertex
    double                    step_size = 0; ///< 0: there was no step yet

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &vertices &unknowns &step_size;
    }
  };
} // namespace isochor

#endif
