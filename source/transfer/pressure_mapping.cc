/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/transfer/pressure_mapping.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void
  map_pressure_to_nodes(const StepContext<dim> &step, NodalField &unknowns)
  {
    const PointArrays<dim> &points       = step.points;
    const unsigned int      n_components = step.n_components;
    NodalField              mass;
    step.nodes.initialize(mass, 1);
    const bool massless =
      std::any_of(step.kernel.materials.begin(),
                  step.kernel.materials.end(),
                  [](const auto &m) { return m->density() == 0; });
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = points.stencil(step.grid.geometry(), k, q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const unsigned int node = step.nodes.node(stencil.vertex[I]);
              const double       Nm = std::max(stencil.pressure_shape[I], 0.) *
                                (massless ? points.volume[q] : points.mass[q]);
              mass.local_element(node) += Nm;
              unknowns.local_element(node * n_components + dim) +=
                Nm * points.pressure[q];
            }
        }
    mass.compress(VectorOperation::add);
    unknowns.compress(VectorOperation::add);
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      if (mass.local_element(node) > 0)
        unknowns.local_element(node * n_components + dim) /=
          mass.local_element(node);
    unknowns.update_ghost_values();
  }



  template void
  map_pressure_to_nodes(const StepContext<2> &, NodalField &);
  template void
  map_pressure_to_nodes(const StepContext<3> &, NodalField &);
} // namespace isochor
