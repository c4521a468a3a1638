/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/step/why_to_reset.h>

namespace isochor
{
  template <int dim>
  std::string
  why_to_reset(const Scene<dim> &scene)
  {
    if (!scene.has_inertia())
      return "without inertia";
    if (!scene.quadrature->forces_jump())
      return "with a <Quadrature/Type> whose forces don't jump";
    if (scene.grid.is_moving())
      return "with <Grid/Stretch>";
    return {};
  }



  template std::string
  why_to_reset(const Scene<2> &);
  template std::string
  why_to_reset(const Scene<3> &);
} // namespace isochor
