/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/cut_cells/nodal_support.h>

#include <algorithm>
#include <map>
#include <utility>

namespace isochor
{
  template <int dim>
  void
  NodalSupport<dim>::find(const PointArrays<dim> &points)
  {
    for (const unsigned int v : summed)
      volume_at[v] = 0;
    volume_at.resize(grid.triangulation().n_vertices(), 0.);
    summed.clear();
    const auto add = [this](const unsigned int vertex, const double volume) {
      if (volume_at[vertex] == 0 && volume != 0)
        summed.push_back(vertex);
      volume_at[vertex] += volume;
    };
    // points of a cell share its nodes, unless each has a stencil of its own
    std::vector<double> volumes;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const double volume  = determinant(points.F[q]) * points.weight[q];
          const auto   stencil = points.stencil(grid.geometry(), k, q);
          if (q == points.cell_start[k] || points.has_stencils())
            volumes.assign(stencil.n_nodes, 0.);
          // functions that are continued beyond their cell may be below 0
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            volumes[I] += std::max(stencil.shape[I], 0.) * volume;
          if (q + 1 < points.cell_start[k + 1] && !points.has_stencils())
            continue;
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            add(stencil.vertex[I], volumes[I]);
        }
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) == 1)
      return;

    // every rank adds up the parts of all ranks in the same order, so that all
    // come to the same decisions
    std::map<unsigned int, std::vector<std::pair<unsigned int, double>>> parts;
    const unsigned int                                                   rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    for (const unsigned int v : summed)
      {
        for (const unsigned int other : occupancy.ranks_near(v))
          parts[other].emplace_back(v, volume_at[v]);
        parts[rank].emplace_back(v, volume_at[v]);
        volume_at[v] = 0;
      }
    const auto own = parts[rank];
    parts.erase(rank);
    auto received  = Utilities::MPI::some_to_some(grid.communicator(), parts);
    received[rank] = own;
    summed.clear();
    for (const auto &part : received)
      for (const auto &volume : part.second)
        add(volume.first, volume.second);
  }



  template <int dim>
  double
  NodalSupport<dim>::operator()(const unsigned int vertex) const
  {
    AssertIndexRange(vertex, volume_at.size());
    double full = 0;
    for (const unsigned int cell : occupancy.cells_at(vertex))
      full += grid.geometry().measure(cell) / (dim + 1);
    return volume_at[vertex] / full;
  }



  template class NodalSupport<2>;
  template class NodalSupport<3>;
} // namespace isochor
