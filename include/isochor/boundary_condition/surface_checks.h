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
  /** Warn of surfaces whose faces (@p candidate_area by surface, m^(dim-1))
   * the body has covered in part only (@p covered_area). Both are empty where
   * there is nothing to check. @p mesh_parameter names the parameter for the
   * mesh of the surfaces. */
  template <int dim>
  void
  warn_of_uncovered_faces(const StepContext<dim>       &step,
                          const SurfaceConditions<dim> &conditions,
                          const std::vector<double>    &covered_area,
                          const std::vector<double>    &candidate_area,
                          const std::string            &mesh_parameter);

  /** Warn of loads on surfaces of which only a part, @p share_on_domains by
   * surface, consists of faces of the domains of the material points; empty
   * where there is nothing to check. */
  template <int dim>
  void
  warn_of_loads_beside_domains(const StepContext<dim>       &step,
                               const SurfaceConditions<dim> &conditions,
                               const std::vector<double>    &share_on_domains,
                               const std::string            &mesh_parameter);

  /** Warn of surfaces whose places are formulas that compare nothing, seen at
   * the vertices of the cells that hold points. Collective. */
  template <int dim>
  void
  warn_of_places_without_comparison(const StepContext<dim>       &step,
                                    const SurfaceConditions<dim> &conditions);

  /** Warn of two surfaces that are the same place, where loads of the same
   * kind, and tractions in the same component, act at the end of the step: they
   * count twice. Surfaces that have only a part in common may be meant. At the
   * start. @p points: nullptr without surfaces. Collective. */
  template <int dim>
  void
  warn_of_doubled_loads(const StepContext<dim>       &step,
                        const SurfaceConditions<dim> &conditions,
                        const BoundaryPoints<dim>    *points);

  /** A piece of a surface at t = 0. */
  template <int dim>
  struct SurfacePiece
  {
    Point<dim>     x;
    Tensor<1, dim> n; ///< outward normal
    double         area;
  };

  /** Warn of a surface that is nearly flat but for a few faces at its rim,
   * which point elsewhere, as if a condition such as y > 0.9 were to hold on
   * top and holds at the upper ends of the sides as well. At the start. @p
   * pieces: this rank's. Collective. */
  template <int dim>
  void
  warn_of_faces_round_an_edge(const StepContext<dim>               &step,
                              const SurfaceRegion<dim>             &place,
                              const std::vector<SurfacePiece<dim>> &pieces);

  /** Warn of loads of surfaces that act, in a component, on nodes alone at
   * which
   * @p constraints prescribe this component: they go into the support, and the
   * body doesn't feel them. Collective. */
  template <int dim>
  void
  warn_of_loads_on_supports(const StepContext<dim>       &step,
                            const NodalField             &unknowns,
                            const SurfaceConditions<dim> &conditions,
                            const BoundaryPoints<dim>    &points,
                            const SurfaceForces<dim>     &forces,
                            const NodalConstraints       &constraints);
} // namespace isochor

#endif
