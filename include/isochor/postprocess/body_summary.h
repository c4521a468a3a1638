/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_summary_h
#define isochor_body_summary_h

#include <isochor/material_points/material_points.h>

#include <string>

namespace isochor
{
  /** Volume at t = 0, mass and extent of the body, as a line for the terminal:
   * a region or a unit that isn't what was meant shows there. Collective. */
  template <int dim>
  std::string
  body_summary(const MaterialPoints<dim> &points, const MPI_Comm comm);
} // namespace isochor

#endif
