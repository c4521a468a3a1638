/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_scene_checks_h
#define isochor_scene_checks_h

#include <isochor/equations/equation_term.h>
#include <isochor/linear_solver/sparse_system.h>

#include <set>
#include <string>

namespace isochor
{
  template <int dim>
  class Scene;
  struct NewtonReport;

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

  /** Warn if @p newton has taken for zero what is more than one per cent of
   * the forces, though strains have larger ones than @p zero_force (N), that
   * of their rounding errors. */
  template <int dim>
  void
  warn_of_rounding(Scene<dim>         &scene,
                   const NewtonReport &newton,
                   const double        zero_force);

  /** Warn that in the equilibrium which @p step has found the body is not
   * stable in @p n_modes modes. */
  template <int dim>
  void
  warn_of_instability(Scene<dim>             &scene,
                      const StepContext<dim> &step,
                      const long              n_modes);

  /** Warn if the first step needed no iteration, as nothing moved. */
  template <int dim>
  void
  warn_if_nothing_moves(Scene<dim>         &scene,
                        const NewtonReport &newton,
                        const NodalField   &unknowns);
} // namespace isochor

#endif
