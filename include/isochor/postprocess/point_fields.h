/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_fields_h
#define isochor_point_fields_h

#include <isochor/equations/mixed_kernel.h>
#include <isochor/material_points/material_points.h>
#include <isochor/postprocess/field_output.h>

namespace isochor
{
  /** The material points of this rank with all they carry, to be written: as
   * points (@p patch_dim = 0), or as their subdomains (@p patch_dim = @p dim;
   * only if PointLayout::with_domains) with the displacement of each corner and
   * all other fields constant within a subdomain.
   * Beside what points carry: mean_stress = tr(sigma)/3 and von_mises_stress =
   * sqrt(3/2) |dev(sigma)| (Pa). Values that a point's material doesn't have,
   * as the history of another one, are NaN. */
  template <int patch_dim, int dim>
  FieldPatches<patch_dim, dim>
  point_fields(const MaterialPoints<dim> &points,
               const MixedKernel<dim>    &kernel);
} // namespace isochor

#endif
