/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/body_quadrature/body_quadrature.h>

namespace isochor
{
  /** ∫ a dv = Σ_p J_p V0_p a_p, the Material Point Method as it is. */
  template <int dim>
  class PlainSum : public BodyQuadrature<dim>
  {
  public:
    bool
    needs_occupancy() const override
    {
      return false;
    }

    bool
    ties_cut_cells() const override
    {
      return false;
    }

    void
    start_step(PointArrays<dim> &points,
               const PointLocator<dim> & /*locator*/,
               const MixedKernel<dim> &kernel,
               const bool              with_occupancy,
               CellOccupancy<dim>     &occupancy) const override
    {
      if (with_occupancy)
        occupancy.update(points, kernel);
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BodyQuadrature, PlainSum, "points")
} // namespace isochor
