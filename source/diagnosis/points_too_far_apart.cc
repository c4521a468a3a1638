/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/material_points/bare_cells.h>

namespace isochor
{
  /**
   * Material points that lie too far apart for the grid. A cell inside of the
   * body that holds no point resists nothing, so that the body is too soft or
   * falls apart.
   */
  template <int dim>
  class PointsTooFarApart : public Diagnosis<dim>
  {
  public:
    void
    grid_reset(const Scene<dim> & /*scene*/,
               const StepContext<dim> &step,
               const ElementNodes & /*elements*/,
               const bool /*is_kept*/) override
    {
      const BareCells bare = find_bare_cells(step.grid, step.points);
      if (bare.n > 0)
        this->warn("at t = " + rounded(step.old_time) + " " + rounded(bare.n) +
                   " cells inside of the body, " + rounded(100 * bare.part) +
                   " % of its volume, hold no points and resist nothing; the "
                   "largest point has " +
                   rounded(bare.largest_point) +
                   " times the volume of its cell. Use more points (<Points "
                   "per cell>, <Lattice spacing>).");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    PointsTooFarApart,
    "material points too far apart for the grid",
    ISOCHOR_ESSENTIAL,
    "at a reset of the grid a point is larger than half of its cell, and cells "
    "without material points whose centroids lie in the "
    "deformed ball of a point's volume make up more than 1 % of the body; an "
    "error at the start if the body then falls into pieces",
    "more points (`Material points/Points per cell`, `Lattice spacing`, a "
    "finer `Body mesh`), or larger cells")
} // namespace isochor
