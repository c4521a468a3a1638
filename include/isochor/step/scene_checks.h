/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_scene_checks_h
#define isochor_scene_checks_h

#include <isochor/equations/equation_term.h>

namespace isochor
{
  template <int dim>
  class Scene;

  /** The first @p step of @p scene is set up. @throws ExcMessage for what can't
   * be meant. Collective. */
  template <int dim>
  void
  check_first_step(const Scene<dim> &scene, const StepContext<dim> &step);
} // namespace isochor

#endif
