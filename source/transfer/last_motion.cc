/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/equations/invariants.h>
#include <isochor/transfer/last_motion.h>

#include <map>

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
      Assert(invariants::fits(is_known, nodes, 1), ExcOtherNodes());
      Assert(invariants::fits(values, nodes, n_components), ExcOtherNodes());
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
    Assert(size > 0, ExcInternalError());
    Assert(invariants::fits(values, nodes, n_components), ExcOtherNodes());
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
    Assert(step_size > 0, ExcMessage("There is no last step."));
    Assert(invariants::fits(values, nodes, n_components), ExcOtherNodes());
    AssertDimension(unknowns.size(), vertices.size() * n_components);
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
    Assert(invariants::fits(values, nodes, n_components), ExcOtherNodes());
    AssertDimension(unknowns.size(), vertices.size() * n_components);
    for (unsigned int i = 0; i < vertices.size(); ++i)
      values.local_element(nodes.node(vertices[i]) * n_components + dim) =
        unknowns[i * n_components + dim];
    values.update_ghost_values();
  }



  template <int dim>
  void
  LastMotion::send_to_owners(const BackgroundGrid<dim> &grid)
  {
    Assert(vertices.empty() || unknowns.size() % vertices.size() == 0,
           ExcInternalError());
    const MPI_Comm     comm = grid.communicator();
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    const unsigned int n    = Utilities::MPI::max(
      vertices.empty() ? 0 : unknowns.size() / vertices.size(), comm);
    const std::size_t length = n + 1; // the vertex, its unknowns

    // control nodes have the owner they had
    const std::size_t n_vertices = grid.geometry().vertices().size();
    std::map<unsigned int, std::vector<double>> messages;
    for (unsigned int i = 0; i < vertices.size(); ++i)
      {
        const unsigned int   v = vertices[i];
        std::vector<double> &message =
          messages[v < n_vertices ? grid.vertex_owner(v) : rank];
        message.push_back(v);
        message.insert(message.end(),
                       unknowns.begin() + i * std::size_t(n),
                       unknowns.begin() + (i + 1) * std::size_t(n));
      }
    vertices.clear();
    unknowns.clear();
    const std::vector<double> own = messages[rank];
    messages.erase(rank);
    auto received  = Utilities::MPI::some_to_some(comm, messages);
    received[rank] = own;
    // several ranks may have known a vertex
    std::vector<unsigned char> is_known(n_vertices, 0);
    for (const auto &of_rank : received)
      for (std::size_t i = 0; i < of_rank.second.size(); i += length)
        {
          const double      *entry = &of_rank.second[i];
          const unsigned int v     = static_cast<unsigned int>(entry[0]);
          if (v < n_vertices && is_known[v])
            continue;
          if (v < n_vertices)
            is_known[v] = 1;
          vertices.push_back(v);
          unknowns.insert(unknowns.end(), entry + 1, entry + length);
        }
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
  LastMotion::send_to_owners(const BackgroundGrid<2> &);
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
  template void
  LastMotion::send_to_owners(const BackgroundGrid<3> &);
} // namespace isochor
