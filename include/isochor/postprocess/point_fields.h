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
  /** The material points of this rank with all they carry, to be written.
   * Values that a point's material doesn't have, as the history of another one,
   * are NaN. */
  template <int dim>
  FieldPatches<0, dim>
  point_fields(const MaterialPoints<dim> &points,
               const MixedKernel<dim>    &kernel);
} // namespace isochor

#endif
