/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/step/why_to_reset.h>

namespace isochor
{
  template <int dim>
  std::string
  why_to_reset(const Scene<dim> &scene, const bool splits_points)
  {
    if (!scene.has_inertia())
      return "without inertia";
    if (!scene.quadrature->forces_jump())
      return "with a <Quadrature/Type> whose forces don't jump";
    if (scene.grid.source().is_adaptive() &&
        scene.adaptation.has_more_changes())
      return "with an adaptive grid that changes";
    if (scene.grid.is_moving())
      return "with <Grid/Stretch>";
    if (splits_points)
      return "with <Material points/Split at share of cell>";
    return {};
  }



  template std::string
  why_to_reset(const Scene<2> &, const bool);
  template std::string
  why_to_reset(const Scene<3> &, const bool);
} // namespace isochor
