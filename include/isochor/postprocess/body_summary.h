/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_summary_h
#define isochor_body_summary_h

#include <isochor/material_points/material_points.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** Volume at t = 0, mass and extent of the body, as a line for the terminal:
   * a region or a unit that isn't what was meant shows there. Collective. */
  template <int dim>
  std::string
  body_summary(const MaterialPoints<dim> &points, const MPI_Comm comm);

  /** Of each of the @p materials of a body, a line of its own: points, volume
   * at t = 0, density, the name of its law (@p laws) and its elasticity. A zone
   * or a parameter that was forgotten shows there. Of one material points,
   * volume and density stand with the body. Collective. */
  template <int dim>
  std::string
  material_summary(
    const MaterialPoints<dim>                              &points,
    const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials,
    const std::vector<std::string>                         &laws,
    const MPI_Comm                                          comm);
} // namespace isochor

#endif
