/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/invariants.h>
#include <isochor/equations/pressure_mapping.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void
  map_pressure_to_nodes(const StepContext<dim> &step, NodalField &unknowns)
  {
    Assert(step.mixed(), ExcMessage("There are no pressures."));
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(invariants::is_consistent(step.points),
           ExcMessage("The arrays are of different points."));
    const PointArrays<dim> &points       = step.points;
    const unsigned int      n_components = step.n_components;
    NodalField              mass;
    step.nodes.initialize(mass, 1);
    const bool massless =
      std::any_of(step.kernel.materials.begin(),
                  step.kernel.materials.end(),
                  [](const auto &m) { return m->density() == 0; });
    // points of a cell share its nodes, unless each has a stencil of its own
    std::vector<double> m_at_nodes, m_p_at_nodes;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto   stencil = points.stencil(step.grid.geometry(), k, q);
          const double m       = massless ? points.volume[q] : points.mass[q];
          const double p       = points.pressure[q];
          if (q == points.cell_start[k] || points.has_stencils())
            {
              m_at_nodes.assign(stencil.n_nodes, 0.);
              m_p_at_nodes.assign(stencil.n_nodes, 0.);
            }
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const double Nm = std::max(stencil.shape[I], 0.) * m;
              m_at_nodes[I] += Nm;
              m_p_at_nodes[I] += Nm * p;
            }
          if (q + 1 < points.cell_start[k + 1] && !points.has_stencils())
            continue;
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const unsigned int node = step.nodes.node(stencil.vertex[I]);
              mass.local_element(node) += m_at_nodes[I];
              unknowns.local_element(node * n_components + dim) +=
                m_p_at_nodes[I];
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
