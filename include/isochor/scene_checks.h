/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_scene_checks_h
#define isochor_scene_checks_h

#include <isochor/equation_term.h>
#include <isochor/sparse_system.h>

#include <set>
#include <string>

namespace isochor
{
  template <int dim>
  class Scene;
  struct NewtonReport;

  /**
   * Warn if no active node is on the boundary called @p name, whose id is
   * @p id (any if @p everywhere), so that the entry of @p parameter for it has
   * no effect now. A wall that the body reaches later is a case in which it may
   * be meant. Collective.
   */
  template <int dim>
  void
  warn_if_untouched(const StepContext<dim>  &step,
                    const std::string       &parameter,
                    const std::string       &name,
                    const types::boundary_id id,
                    const bool               everywhere = false);

  /** Warn of a body that is much smaller than the cells it is in, and of
   * materials that no point is made of. At the start. Collective. */
  template <int dim>
  void
  check_body(const StepContext<dim> &step);

  /** Warn of bodies that nothing holds, with the matrix of the first iteration
   * of a static scene. Collective. */
  void
  check_supports(const SparseSystem &matrix, Warnings &warnings);

  /** The first step of @p scene is set up, with its @p matrix: warn of what
   * can't be meant. Collective. */
  template <int dim>
  void
  check_first_step(const Scene<dim>       &scene,
                   const StepContext<dim> &step,
                   const SparseSystem     &matrix);

  /** Warn if the first step needed no iteration, as nothing moved. */
  template <int dim>
  void
  warn_if_nothing_moves(Scene<dim>         &scene,
                        const NewtonReport &newton,
                        const NodalField   &unknowns);
} // namespace isochor

#endif
