/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A quadrature of one's own: the sum over points, but the points of a cell
// integrate no more than the cell, V_p <- V_p min(1, |e| / Σ_q J_q V_q). Where
// points have gathered the body is then not too stiff; where they are missing
// it is as soft as with 'points'.

#include <isochor/base/plugin_registry.h>
#include <isochor/body_quadrature/body_quadrature.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  class AtMostFull : public BodyQuadrature<dim>
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
    start_step(PointArrays<dim>        &points,
               const PointLocator<dim> &locator,
               const MixedKernel<dim>  &kernel,
               const bool               with_occupancy,
               CellOccupancy<dim>      &occupancy) const override
    {
      if (with_occupancy)
        occupancy.update(points, kernel, false);
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        {
          const unsigned int begin = points.cell_start[k],
                             end   = points.cell_start[k + 1];
          double volume            = 0;
          for (unsigned int q = begin; q < end; ++q)
            volume += determinant(points.F[q]) * points.volume[q];
          const double factor =
            std::min(1., locator.geometry().measure(points.cell[k]) / volume);
          for (unsigned int q = begin; q < end; ++q)
            points.weight[q] *= factor;
        }
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BodyQuadrature, AtMostFull, "at most full")
} // namespace isochor
