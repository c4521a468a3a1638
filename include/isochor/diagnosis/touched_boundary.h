/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_touched_boundary_h
#define isochor_touched_boundary_h

#include <deal.II/base/mpi.h>

#include <isochor/equations/equation_term.h>

namespace isochor
{
  /** Whether material is in cells at the boundary @p id, or at any if
   * @p everywhere. Collective. */
  template <int dim>
  bool
  is_touched(const StepContext<dim>  &step,
             const types::boundary_id id,
             const bool               everywhere = false)
  {
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    bool                        touched  = false;
    for (const BoundaryFace &face : step.grid.boundary_faces())
      if (everywhere || face.id == id)
        for (unsigned int v = 0; v <= dim; ++v)
          touched = touched ||
                    (v != face.opposite_vertex &&
                     step.nodes.node(geometry.vertex_indices(face.cell)[v]) !=
                       numbers::invalid_unsigned_int);
    return Utilities::MPI::max(static_cast<int>(touched),
                               step.grid.communicator()) != 0;
  }
} // namespace isochor

#endif
