/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_law.h>

namespace isochor
{
  /** Contact without friction: f = max(0, w·n) n. */
  template <int dim>
  class Unilateral : public InteractionLaw<dim>
  {
  public:
    typename InteractionLaw<dim>::Projection
    project(const Tensor<1, dim> &w,
            const Tensor<1, dim> &n,
            const double /*area_ratio*/) const override
    {
      typename InteractionLaw<dim>::Projection result;
      internal::project_normal<dim>(w, n, result);
      return result;
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(InteractionLaw, Unilateral, "unilateral")
} // namespace isochor
