/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_fields_h
#define isochor_grid_fields_h

#include <isochor/equations/equation_term.h>
#include <isochor/postprocess/field_output.h>

namespace isochor
{
  /**
   * The cells of this rank with material, as they are at the start of the step,
   * with the nodal displacement increment and pressure in @p unknowns and, if
   * given, the @p residual of forces (N) and of the pressure equation. Both
   * with ghosts updated.
   */
  template <int dim>
  FieldPatches<dim, dim>
  grid_fields(const StepContext<dim> &step,
              const NodalField       &unknowns,
              const NodalField       *residual = nullptr);
} // namespace isochor

#endif
