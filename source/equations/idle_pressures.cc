/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/idle_pressures.h>

namespace isochor
{
  template <int dim>
  void
  hold_idle_pressures(const StepContext<dim> &step,
                      NodalConstraints       &constraints)
  {
    if (!step.mixed() || step.has_inertia || step.kernel.materials.size() < 2)
      return;
    const PointArrays<dim> &points = step.points;
    NodalField              felt;
    step.nodes.initialize(felt, 1);
    const auto feel = [&](const unsigned int node) {
      felt.local_element(node) = 1;
    };
    if (!points.has_stencils())
      for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
        feel(node);
    for (unsigned int q = 0; points.has_stencils() && q < points.n_points();
         ++q)
      {
        const auto stencil = points.stencil(step.grid.geometry(), 0, q);
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          if (stencil.pressure_shape[I] != 0)
            feel(step.nodes.node(stencil.vertex[I]));
      }
    for (const auto &cell : points.overlapped_cells)
      for (const unsigned int v :
           step.grid.geometry().vertex_indices(cell.cell))
        feel(step.nodes.node(v));
    felt.compress(VectorOperation::add);
    felt.update_ghost_values();
    // those that a felt one follows feel what it does
    NodalField through_ties;
    step.nodes.initialize(through_ties, 1);
    const NodalTies &ties = constraints.ties;
    for (unsigned int k = 0; k < ties.size(); ++k)
      if (felt.local_element(ties.node[k]) != 0)
        for (std::size_t i = ties.start[k]; i < ties.start[k + 1]; ++i)
          through_ties.local_element(ties.master[i]) = 1;
    through_ties.compress(VectorOperation::add);
    through_ties.update_ghost_values();
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      if (felt.local_element(node) == 0 &&
          through_ties.local_element(node) == 0 &&
          step.nodes.control_node(node) == nullptr)
        constraints.constrain(node * step.n_components + dim, 0.);
  }



  template void
  hold_idle_pressures(const StepContext<2> &, NodalConstraints &);
  template void
  hold_idle_pressures(const StepContext<3> &, NodalConstraints &);
} // namespace isochor
