/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/adaptation/cell_size_criterion.h>
#include <isochor/base/rounding.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  unsigned int
  LevelRule<dim>::level(const AdaptiveGrid<dim> &grid,
                        const Leaf<dim>         &leaf,
                        const double             size) const
  {
    Assert(size > 0, ExcInternalError());
    const double needed = std::log2(grid.size(leaf.tree) / size);
    const double finer  = std::ceil(needed - rounding::accumulated);
    const double coarser =
      std::ceil(needed + hysteresis - rounding::accumulated);
    double level = leaf.level;
    if (finer > level)
      level = finer;
    else if (coarser < level)
      level = coarser;
    return std::min<double>(maximum, std::max<double>(minimum, level));
  }



  template struct LevelRule<2>;
  template struct LevelRule<3>;
} // namespace isochor
