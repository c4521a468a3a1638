/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/equations/active_nodes.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  ActiveNodes<dim>::ActiveNodes(const BackgroundGrid<dim> &grid)
    : grid(grid)
  {}



  template <int dim>
  bool
  ActiveNodes<dim>::update(std::vector<unsigned int> touched)
  {
    const MPI_Comm comm = grid.communicator();
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    const bool changed = (touched != last_touched) || n_global_nodes == 0 ||
                         last_mesh != grid.mesh_number();
    if (Utilities::MPI::max(static_cast<unsigned int>(changed), comm) == 0)
      return false;
    last_touched = touched;
    partitioners.clear();

    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    if (last_mesh != grid.mesh_number())
      node_at_vertex.assign(control_vertex(control.size()),
                            numbers::invalid_unsigned_int);
    else
      for (const unsigned int vertex : vertices)
        node_at_vertex[vertex] = numbers::invalid_unsigned_int;
    last_mesh = grid.mesh_number();

    vertices                  = collect_owned(touched);
    n_owned_nodes             = vertices.size();
    const auto offset_and_sum = exclusive_and_total_sum(n_owned_nodes, comm);
    first_owned               = offset_and_sum.first;
    n_global_nodes            = offset_and_sum.second;
    for (unsigned int node = 0; node < n_owned_nodes; ++node)
      node_at_vertex[vertices[node]] = node;

    // ask the owners for the global numbers of the ghosts
    std::map<unsigned int, std::vector<unsigned int>> questions;
    for (const unsigned int vertex : touched)
      if (owner(vertex) != rank)
        questions[owner(vertex)].push_back(vertex);
    std::vector<std::pair<types::global_dof_index, unsigned int>> ghost_nodes;
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        std::map<unsigned int, std::vector<types::global_dof_index>> answers;
        for (const auto &question :
             Utilities::MPI::some_to_some(comm, questions))
          for (const unsigned int vertex : question.second)
            answers[question.first].push_back(first_owned +
                                              node_at_vertex[vertex]);
        for (const auto &answer : Utilities::MPI::some_to_some(comm, answers))
          for (unsigned int i = 0; i < answer.second.size(); ++i)
            ghost_nodes.emplace_back(answer.second[i],
                                     questions[answer.first][i]);
        std::sort(ghost_nodes.begin(), ghost_nodes.end());
      }
    ghosts.clear();
    for (const auto &ghost : ghost_nodes)
      {
        node_at_vertex[ghost.second] = vertices.size();
        vertices.push_back(ghost.second);
        ghosts.push_back(ghost.first);
      }
    return true;
  }



  template <int dim>
  std::vector<unsigned int>
  ActiveNodes<dim>::collect_owned(
    const std::vector<unsigned int> &touched) const
  {
    const MPI_Comm     comm = grid.communicator();
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return touched;

    std::vector<unsigned int>                         owned;
    std::map<unsigned int, std::vector<unsigned int>> foreign;
    for (const unsigned int vertex : touched)
      if (owner(vertex) == rank)
        owned.push_back(vertex);
      else
        foreign[owner(vertex)].push_back(vertex);
    for (const auto &received : Utilities::MPI::some_to_some(comm, foreign))
      owned.insert(owned.end(), received.second.begin(), received.second.end());
    std::sort(owned.begin(), owned.end());
    owned.erase(std::unique(owned.begin(), owned.end()), owned.end());
    return owned;
  }



  template <int dim>
  std::vector<unsigned int>
  ActiveNodes<dim>::control_entries(const unsigned int n_components) const
  {
    Assert(n_components >= dim, ExcInternalError());
    std::vector<unsigned int> entries;
    for (unsigned int k = 0; k < control.size(); ++k)
      if (const unsigned int i = node(control_vertex(k));
          i != numbers::invalid_unsigned_int)
        for (unsigned int a = 0; a < n_components; ++a)
          entries.push_back(i * n_components + a);
    return entries;
  }



  template <int dim>
  void
  ActiveNodes<dim>::initialize(NodalField        &field,
                               const unsigned int n_components) const
  {
    Assert(n_components > 0, ExcInternalError());
    Assert(n_owned_nodes <= n_global_nodes, ExcInternalError());
    auto &partitioner = partitioners[n_components];
    if (!partitioner)
      {
        IndexSet owned(n_global_nodes * n_components);
        owned.add_range(first_owned * n_components,
                        (first_owned + n_owned_nodes) * n_components);
        IndexSet ghost(n_global_nodes * n_components);
        for (const types::global_dof_index node : ghosts)
          ghost.add_range(node * n_components, (node + 1) * n_components);
        ghost.compress();
        partitioner = std::make_shared<const Utilities::MPI::Partitioner>(
          owned, ghost, grid.communicator());
      }
    field.reinit(partitioner);
  }



  template class ActiveNodes<2>;
  template class ActiveNodes<3>;
} // namespace isochor
