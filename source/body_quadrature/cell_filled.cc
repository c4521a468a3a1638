/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/body_quadrature/body_quadrature.h>
#include <isochor/body_quadrature/hole_points.h>

namespace isochor
{
  /** Within the step, the points of each interior cell share its measure, and
   * holes are integrated. Masses, and with them external forces, are not
   * scaled. */
  template <int dim>
  class CellFilled : public BodyQuadrature<dim>
  {
  public:
    void
    start_step(PointArrays<dim> &points,
               const PointLocator<dim> & /*locator*/,
               const MixedKernel<dim> &kernel,
               const bool /*with_occupancy*/,
               CellOccupancy<dim> &occupancy) const override
    {
      occupancy.update(points, kernel, true);
      fill_interior_cells(points, occupancy);
      add_hole_points(points, occupancy, kernel);
    }

  private:
    /** The weights of the points of each interior cell e share its measure:
     * V0_p ← V0_p |e| / Σ_{q∈e} J_q V0_q, with J at t_n. */
    static void
    fill_interior_cells(PointArrays<dim>         &points,
                        const CellOccupancy<dim> &occupancy)
    {
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        {
          const unsigned int cell = points.cell[k];
          if (!occupancy.is_interior(cell))
            continue;
          const double factor = occupancy.grid.geometry().measure(cell) /
                                occupancy.content(cell)->volume;
          for (unsigned int q = points.cell_start[k];
               q < points.cell_start[k + 1];
               ++q)
            points.weight[q] *= factor;
        }
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BodyQuadrature, CellFilled, "cell-filled")

} // namespace isochor
