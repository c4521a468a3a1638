/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_smallest_cell_h
#define isochor_smallest_cell_h

#include <deal.II/base/mpi.h>

#include <isochor/equations/equation_term.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  /** The size of the smallest cell that holds points (m). Collective. */
  template <int dim>
  double
  smallest_cell(const StepContext<dim> &step)
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int k = 0; k < step.points.cell.size(); ++k)
      smallest = std::min(smallest,
                          cell_size(step.grid.geometry(), step.points.cell[k]));
    return Utilities::MPI::min(smallest, step.grid.communicator());
  }
} // namespace isochor

#endif
