/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** What the seeding made of the region and the zones. */
  template <int dim>
  class SeededBody : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/) override
    {
      scene.points.check_seeding(scene.quadrature->needs_domains(),
                                 *this->warnings);
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    SeededBody,
    "a region that is finer than the points",
    ISOCHOR_ESSENTIAL,
    "`Material points/Region`, seeded in the cells of the grid: four places in "
    "each cell are looked at, away from the surface that the points show. It "
    "does not hold at some though all points around are in it (a gap that is "
    "filled), or the other way round (a part that is left out). Not with "
    "`Lattice spacing` or a `Body mesh`; a single gap that goes through few "
    "cells or is thinner than a hundredth of them may be missed",
    "smaller cells, `Points per cell in zones`, a body mesh")
} // namespace isochor
