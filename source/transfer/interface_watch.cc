/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/transfer/interface_watch.h>

namespace isochor
{
  void
  warn_of_interfaces_in_cells(const InterfaceCrossing &worst,
                              const MPI_Comm           comm,
                              const double             time,
                              Warnings                &warnings)
  {
    constexpr double much   = 0.2; // 3 % of the stress
    const double     weight = Utilities::MPI::max(worst.weight(), comm);
    if (weight < much)
      return;
    // of ranks that have found the same the same is told
    const bool   is_mine = worst.weight() == weight;
    const double depth = Utilities::MPI::max(is_mine ? worst.depth : 0., comm);
    warnings.add(
      "materials that meet within cells",
      "At t = " + rounded(time) +
        " s materials whose stiffnesses differ by up to " +
        rounded(1 + weight / depth) +
        " to 1, or whose strengths differ, meet within cells, " +
        rounded(depth) +
        " of a cell away from its faces, and no cell nearby holds the one "
        "only, as where layers or grains are hardly a cell thick. Both are "
        "strained alike there: stresses are wrong, the more the larger both "
        "numbers are (100 to 1, 0.006 and 0.06 of a cell: by 9 and 74 % in the "
        "stiff material), and neither more points nor smaller steps help. Take "
        "cells that are smaller than the layers.");
  }
} // namespace isochor
