/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_law.h>

namespace isochor
{
  /** The surface stays at its place on the partner: f = w. */
  template <int dim>
  class Tie : public InteractionLaw<dim>
  {
  public:
    typename InteractionLaw<dim>::Projection
    project(const Tensor<1, dim> &w,
            const Tensor<1, dim> & /*n*/,
            const double /*area_ratio*/) const override
    {
      typename InteractionLaw<dim>::Projection result;
      result.state  = SurfaceState::sticks;
      result.f      = w;
      result.f_by_w = unit_symmetric_tensor<dim>();
      return result;
    }
    bool
    is_unilateral() const override
    {
      return false;
    }
    bool
    constrains_tangent() const override
    {
      return true;
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(InteractionLaw, Tie, "tie")
} // namespace isochor
