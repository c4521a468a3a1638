/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_checks_h
#define isochor_surface_checks_h

#include <isochor/boundary_condition/surface_conditions.h>
#include <isochor/boundary_condition/surface_forces.h>
#include <isochor/equations/equation_term.h>

#include <string>
#include <vector>

namespace isochor
{
  /** Warn of surfaces of which only the part @p covered (by surface; empty
   * where there is nothing to check) belongs to the body. @p mesh_parameter
   * names the parameter for the mesh of the surfaces. */
  template <int dim>
  void
  warn_of_surfaces_off_the_body(const StepContext<dim>       &step,
                                const SurfaceConditions<dim> &conditions,
                                const std::vector<double>    &covered,
                                const std::string            &mesh_parameter);

  /** Warn of surfaces whose places are formulas that compare nothing, seen at
   * the vertices of the cells that hold points. Collective. */
  template <int dim>
  void
  warn_of_places_without_comparison(const StepContext<dim>       &step,
                                    const SurfaceConditions<dim> &conditions);
} // namespace isochor

#endif
