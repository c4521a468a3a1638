/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/equations/pressure_groups.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  PressureGroups::PressureGroups(const StepContext<dim> &step,
                                 const MaterialGroups   &groups)
    : n_groups(groups.size())
    , largest(2 * step.grid.geometry().vertices().size(), 0)
  {
    const PointArrays<dim>     &points   = step.points;
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const unsigned int group   = groups.of_material[points.material[q]];
          const auto         stencil = points.stencil(geometry, k, q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            if (stencil.shape[I] != 0)
              {
                unsigned int *const here = &largest[2 * stencil.vertex[I]];
                here[0]                  = std::max(here[0], group + 1);
                here[1]                  = std::max(here[1], n_groups - group);
              }
        }
    Utilities::MPI::max(largest, step.grid.communicator(), largest);
  }



  template PressureGroups::PressureGroups(const StepContext<2> &,
                                          const MaterialGroups &);
  template PressureGroups::PressureGroups(const StepContext<3> &,
                                          const MaterialGroups &);
} // namespace isochor
