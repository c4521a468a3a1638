/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_cells_crossed_h
#define isochor_cells_crossed_h

#include <deal.II/base/mpi.h>

#include <isochor/equations/equation_term.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>

namespace isochor
{
  /** How many sizes of its cell a point moves in the step with these @p
   * unknowns, the largest number of all points. Collective. */
  template <int dim>
  double
  cells_crossed(const StepContext<dim> &step, const NodalField &unknowns)
  {
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    double                      most     = 0;
    for (unsigned int k = 0; k < step.points.cell.size(); ++k)
      {
        double way = 0;
        for (unsigned int q = step.points.cell_start[k];
             q < step.points.cell_start[k + 1];
             ++q)
          {
            const auto     stencil = step.points.stencil(geometry, k, q);
            Tensor<1, dim> u;
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              for (unsigned int d = 0; d < dim; ++d)
                u[d] +=
                  stencil.shape[I] *
                  unknowns.local_element(
                    step.nodes.node(stencil.vertex[I]) * step.n_components + d);
            way = std::max(way, u.norm());
          }
        most = std::max(most, way / cell_size(geometry, step.points.cell[k]));
      }
    return Utilities::MPI::max(most, step.grid.communicator());
  }
} // namespace isochor

#endif
