/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/cut_cells/cavity_watch.h>

#include <algorithm>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  CavityWatch<dim>::look(const CellOccupancy<dim> &occupancy,
                         const double              time,
                         const bool                at_start,
                         Warnings                 &warnings)
  {
    constexpr std::size_t most_places = 5;
    const auto            cavities    = occupancy.all_cavities();
    const unsigned int    n_before    = n_last;
    n_last                            = cavities.size();
    if (at_start)
      {
        // large ones may shrink to what is counted later
        n_small_at_start = n_last;
        n_large_at_start = occupancy.n_large_cavities();
      }
    const unsigned int n_at_start = n_small_at_start + n_large_at_start;
    if (n_last <= n_before || n_last <= n_at_start)
      return;
    std::ostringstream text;
    text << "At t = " << time
         << " the body has cavities inside, without points, that are larger "
            "than a few points as they were seeded: "
         << n_last << ", at t = 0 " << n_at_start << ". The largest: ";
    for (std::size_t i = 0; i < std::min(most_places, cavities.size()); ++i)
      text << (i > 0 ? "; " : "") << cavities[i].n_cells << " cells ("
           << cavities[i].volume << " m^" << dim << ") at ("
           << cavities[i].place << ')';
    text << ". They count as outside: nothing resists there, and volume and "
            "load are lost as they close. If a new one is not meant: seed more "
            "points where cells become smaller than those that they were "
            "seeded in (<Material points/Points per cell>, <Points per cell in "
            "zones>), or larger cells.";
    warnings.add("a cavity has opened", text.str());
  }



  template class CavityWatch<2>;
  template class CavityWatch<3>;
} // namespace isochor
