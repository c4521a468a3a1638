/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_yielded_share_h
#define isochor_yielded_share_h

#include <isochor/equations/mixed_kernel.h>
#include <isochor/material_points/material_points.h>

namespace isochor
{
  /** The share of the reference volume that has yielded so far; negative if no
   * material has a plastic strain. Collective. */
  template <int dim>
  double
  yielded_share(const MaterialPoints<dim> &points,
                const MixedKernel<dim>    &kernel,
                const MPI_Comm             comm);
} // namespace isochor

#endif
