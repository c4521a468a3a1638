/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/condition.h>
#include <isochor/base/explanation.h>
#include <isochor/base/expression.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/surface_checks.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  warn_of_surfaces_off_the_body(const StepContext<dim>       &step,
                                const SurfaceConditions<dim> &conditions,
                                const std::vector<double>    &covered,
                                const std::string            &mesh_parameter)
  {
    for (unsigned int s = 0; s < covered.size(); ++s)
      if (const SurfaceRegion<dim> &place = conditions.surfaces[s].place;
          covered[s] <= 0.99 && !place.on_grid_boundary)
        step.warnings.add("surface in part off the body",
                          "only " + rounded(100 * covered[s]) +
                            " % of the area of <" + place.name + "> of <" +
                            place.parameter +
                            "> belong to the body; its load acts on this part "
                            "alone, however small the cells. Give <Material "
                            "points/Body mesh> and <" +
                            mesh_parameter + ">.");
  }



  template <int dim>
  void
  warn_of_places_without_comparison(const StepContext<dim>       &step,
                                    const SurfaceConditions<dim> &conditions)
  {
    const auto is_doubtful = [&step](const SurfaceRegion<dim> &place) {
      return step.grid.boundary_names().count(place.condition) == 0 &&
             compares_nothing(place.condition);
    };
    if (std::none_of(conditions.named.begin(),
                     conditions.named.end(),
                     is_doubtful))
      return;
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    std::vector<unsigned char>  touched(geometry.vertices().size(), 0);
    for (const unsigned int cell :
         union_over_ranks(step.points.cell, step.grid.communicator()))
      for (const unsigned int vertex : geometry.vertex_indices(cell))
        touched[vertex] = 1;
    for (const SurfaceRegion<dim> &place : conditions.named)
      if (is_doubtful(place))
        {
          std::vector<double> values;
          try
            {
              const Expression<dim> formula(place.condition, place.parameter);
              for (unsigned int v = 0; v < touched.size(); ++v)
                if (touched[v])
                  values.push_back(formula(geometry.vertices()[v], 0.));
            }
          catch (const StandardExceptions::ExcMessage &)
            {
              continue; // it need have values at the surface only
            }
          warn_of_formula_for_condition(place.condition,
                                        place.parameter,
                                        values,
                                        step.warnings);
        }
  }



  ISOCHOR_EXPLAIN(
    surface_off_body,
    "surface in part off the body",
    ISOCHOR_ESSENTIAL,
    "the faces of cells that a surface of `Boundary conditions/Surfaces of "
    "body` with a load consists of belong to the body by less than 99 % of "
    "their area: its loads act on this part and are too small by the rest, "
    "however small the cells (a bore with pressure whose surface is steps of "
    "cells: half of the load). Not with CPDI, where loads act on the outer "
    "faces of subdomains",
    "`Quadrature/Type = CPDI`; the body's mesh in `Body mesh` and `Mesh of "
    "body surfaces`")



  template void
  warn_of_surfaces_off_the_body(const StepContext<2> &,
                                const SurfaceConditions<2> &,
                                const std::vector<double> &,
                                const std::string &);
  template void
  warn_of_places_without_comparison(const StepContext<2> &,
                                    const SurfaceConditions<2> &);
  template void
  warn_of_surfaces_off_the_body(const StepContext<3> &,
                                const SurfaceConditions<3> &,
                                const std::vector<double> &,
                                const std::string &);
  template void
  warn_of_places_without_comparison(const StepContext<3> &,
                                    const SurfaceConditions<3> &);
} // namespace isochor
