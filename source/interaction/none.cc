/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/interaction/interaction_law.h>

namespace isochor
{
  /** No interaction: two bodies that pass through each other. */
  template <int dim>
  class NoInteraction : public InteractionLaw<dim>
  {
  public:
    bool
    acts() const override
    {
      return false;
    }

    typename InteractionLaw<dim>::Projection
    project(const Tensor<1, dim> & /*w*/,
            const Tensor<1, dim> & /*n*/,
            const double /*area_ratio*/) const override
    {
      Assert(false, ExcInternalError());
      return {};
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(InteractionLaw, NoInteraction, "none")
} // namespace isochor
