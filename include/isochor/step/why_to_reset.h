/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_why_to_reset_h
#define isochor_why_to_reset_h

#include <isochor/scene/scene.h>

#include <string>

namespace isochor
{
  /**
   * What in the @p scene asks for a grid that is put back in each step, where
   * `Grid reset/Steps between resets` is `auto`: a phrase for messages, empty
   * if the grid is to be kept.
   *
   * Only dynamics gains by a grid that is kept, with quadratures whose forces
   * jump when points change cells. In statics, and with CPDI, resets have no
   * such price. What needs them all the same is what happens at a reset only:
   * `Grid/Stretch` moves the grid. Periodic sides are not in the list, since
   * they take the body along, which a grid that is put back can't follow.
   *
   * After the parameters of the scene were read. From them alone, so that a run
   * that continues decides alike.
   */
  template <int dim>
  std::string
  why_to_reset(const Scene<dim> &scene);
} // namespace isochor

#endif
