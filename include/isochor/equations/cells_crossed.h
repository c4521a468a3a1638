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
#include <cmath>

namespace isochor
{
  /** How many sizes of the cell that it is in the body moves in the step with
   * these @p unknowns, where it is most. Collective. */
  template <int dim>
  double
  cells_crossed(const StepContext<dim> &step, const NodalField &unknowns)
  {
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    double                      most     = 0;
    for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
      {
        const unsigned int cell = step.points.cell[k];
        double             way  = 0;
        for (const unsigned int vertex : geometry.vertex_indices(cell))
          {
            const unsigned int first =
              step.nodes.node(vertex) * step.n_components;
            double square = 0;
            for (unsigned int d = 0; d < dim; ++d)
              square += unknowns.local_element(first + d) *
                        unknowns.local_element(first + d);
            way = std::max(way, std::sqrt(square));
          }
        most = std::max(most, way / cell_size(geometry, cell));
      }
    return Utilities::MPI::max(most, step.grid.communicator());
  }
} // namespace isochor

#endif
