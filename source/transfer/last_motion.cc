/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/transfer/last_motion.h>

namespace isochor
{
  namespace
  {
    /** Give the displacements of nodes whose entry in @p is_known is 0 the mean
     * of those of their known neighbours, if they have any. Collective. */
    template <int dim>
    void
    follow_neighbours(const ActiveNodes<dim> &nodes,
                      const ElementNodes     &elements,
                      const NodalField       &is_known,
                      const unsigned int      n_components,
                      NodalField             &values)
    {
      NodalField sums; // of displacements, and of how many
      nodes.initialize(sums, dim + 1);
      for (unsigned int e = 0; e < elements.size(); ++e)
        for (std::size_t k = elements.start[e]; k < elements.start[e + 1]; ++k)
          {
            const unsigned int node = elements.node[k];
            if (is_known.local_element(node) != 0)
              continue;
            for (std::size_t l = elements.start[e]; l < elements.start[e + 1];
                 ++l)
              {
                const unsigned int neighbour = elements.node[l];
                if (is_known.local_element(neighbour) == 0 ||
                    nodes.control_node(neighbour) != nullptr)
                  continue;
                for (unsigned int a = 0; a < dim; ++a)
                  sums.local_element(node * (dim + 1) + a) +=
                    values.local_element(neighbour * n_components + a);
                sums.local_element(node * (dim + 1) + dim) += 1;
              }
          }
      sums.compress(VectorOperation::add);
      for (unsigned int node = 0; node < nodes.n_owned(); ++node)
        {
          const double n = sums.local_element(node * (dim + 1) + dim);
          for (unsigned int a = 0; a < dim && n > 0; ++a)
            values.local_element(node * n_components + a) =
              sums.local_element(node * (dim + 1) + a) / n;
        }
      values.update_ghost_values();
    }
  } // namespace



  template <int dim>
  void
  LastMotion::remember(const ActiveNodes<dim> &nodes,
                       const unsigned int      n_components,
                       const double            size,
                       const NodalField       &values)
  {
    step_size = size;
    vertices.clear();
    unknowns.clear();
    for (unsigned int node = 0; node < nodes.n_local(); ++node)
      {
        vertices.push_back(nodes.vertex(node));
        for (unsigned int a = 0; a < n_components; ++a)
          unknowns.push_back(values.local_element(node * n_components + a));
      }
  }



  template <int dim>
  void
  LastMotion::extrapolate(const ActiveNodes<dim> &nodes,
                          const ElementNodes     &elements,
                          const unsigned int      n_components,
                          const double            ratio,
                          NodalField             &values) const
  {
    NodalField is_known;
    nodes.initialize(is_known, 1);
    unsigned int n_known = 0;
    for (unsigned int i = 0; i < vertices.size(); ++i)
      {
        const unsigned int node = nodes.node(vertices[i]);
        if (node >= nodes.n_owned())
          continue;
        for (unsigned int a = 0; a < n_components; ++a)
          values.local_element(node * n_components + a) =
            (a < dim ? ratio : 1.) * unknowns[i * n_components + a];
        is_known.local_element(node) = 1;
        ++n_known;
      }
    values.update_ghost_values();
    const int any_new = n_known < nodes.n_owned() ? 1 : 0;
    if (Utilities::MPI::max(any_new, nodes.grid.communicator()) == 0)
      return;
    is_known.update_ghost_values();
    follow_neighbours(nodes, elements, is_known, n_components, values);
  }



  template <int dim>
  void
  LastMotion::restore_pressure(const ActiveNodes<dim> &nodes,
                               const unsigned int      n_components,
                               NodalField             &values) const
  {
    for (unsigned int i = 0; i < vertices.size(); ++i)
      values.local_element(nodes.node(vertices[i]) * n_components + dim) =
        unknowns[i * n_components + dim];
    values.update_ghost_values();
  }



  template void
  LastMotion::remember(const ActiveNodes<2> &,
                       const unsigned int,
                       const double,
                       const NodalField &);
  template void
  LastMotion::extrapolate(const ActiveNodes<2> &,
                          const ElementNodes &,
                          const unsigned int,
                          const double,
                          NodalField &) const;
  template void
  LastMotion::restore_pressure(const ActiveNodes<2> &,
                               const unsigned int,
                               NodalField &) const;
  template void
  LastMotion::remember(const ActiveNodes<3> &,
                       const unsigned int,
                       const double,
                       const NodalField &);
  template void
  LastMotion::extrapolate(const ActiveNodes<3> &,
                          const ElementNodes &,
                          const unsigned int,
                          const double,
                          NodalField &) const;
  template void
  LastMotion::restore_pressure(const ActiveNodes<3> &,
                               const unsigned int,
                               NodalField &) const;
} // namespace isochor
