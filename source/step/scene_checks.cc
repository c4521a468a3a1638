/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_points/bare_cells.h>
#include <isochor/scene/scene.h>
#include <isochor/step/scene_checks.h>

namespace isochor
{
  template <int dim>
  void
  check_first_step(const Scene<dim> &scene, const StepContext<dim> &step)
  {
    step.grid.check_motion();
    scene.shape.check_mesh();
    assert_in_one_piece(step.grid, step.points);
    for (const auto &condition : scene.boundary_conditions)
      condition->check_scene(step);
    for (const auto &postprocessor : scene.postprocessors)
      postprocessor->check_scene(step);
  }



  template void
  check_first_step<2>(const Scene<2> &, const StepContext<2> &);
  template void
  check_first_step<3>(const Scene<3> &, const StepContext<3> &);
} // namespace isochor
