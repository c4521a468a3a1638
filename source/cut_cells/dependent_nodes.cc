/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <isochor/base/rounding.h>
#include <isochor/cut_cells/dependent_nodes.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <vector>

namespace isochor
{
  namespace
  {
    /** What is left of the last diagonal entry of the symmetric, positive
     * semidefinite @p matrix after the others have been eliminated, relative to
     * it. */
    double
    last_pivot(FullMatrix<double> &matrix)
    {
      AssertDimension(matrix.m(), matrix.n());
      Assert(matrix.m() > 0, ExcInternalError());
      const unsigned int  n = matrix.m();
      std::vector<double> diagonal(n);
      for (unsigned int i = 0; i < n; ++i)
        diagonal[i] = matrix(i, i);
      for (unsigned int k = 0; k + 1 < n; ++k)
        if (matrix(k, k) > rounding::arithmetic * diagonal[k])
          for (unsigned int i = k + 1; i < n; ++i)
            for (unsigned int j = k + 1; j < n; ++j)
              matrix(i, j) -= matrix(i, k) * matrix(k, j) / matrix(k, k);
      return matrix(n - 1, n - 1) / diagonal[n - 1];
    }
  } // namespace



  template <int dim>
  DependentNodes<dim>::DependentNodes(const CellOccupancy<dim> &occupancy)
    : occupancy(occupancy)
  {}



  template <int dim>
  void
  DependentNodes<dim>::update(const PointArrays<dim>  &points,
                              const NodalSupport<dim> &support,
                              const double             smallest_part)
  {
    dependent.clear();
    if (!points.has_stencils())
      return;
    Entries entries = collect(points, support);
    exchange(entries);

    std::map<unsigned int, std::vector<unsigned int>> neighbours;
    for (const auto &entry : entries)
      {
        const auto [I, J] = entry.first;
        if (I == J)
          continue;
        if (support(J) <= (1 + rounding::places) * support(I))
          neighbours[I].push_back(J);
        if (support(I) <= (1 + rounding::places) * support(J))
          neighbours[J].push_back(I);
      }
    for (auto &node : neighbours)
      {
        std::vector<unsigned int> &nodes = node.second;
        nodes.push_back(node.first);
        FullMatrix<double> matrix(nodes.size());
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int j = 0; j < nodes.size(); ++j)
            {
              const auto entry =
                entries.find(std::minmax({nodes[i], nodes[j]}));
              if (entry != entries.end())
                matrix(i, j) = entry->second;
            }
        if (last_pivot(matrix) < smallest_part)
          dependent.insert(node.first);
      }
  }



  template <int dim>
  typename DependentNodes<dim>::Entries
  DependentNodes<dim>::collect(const PointArrays<dim>  &points,
                               const NodalSupport<dim> &support) const
  {
    Entries                                entries;
    std::unordered_map<unsigned int, bool> at_surface;
    std::vector<unsigned int>              members;
    const SimplexGeometry<dim>            &geometry = occupancy.grid.geometry();
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = points.stencil(geometry, k, q);
          members.clear();
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const unsigned int vertex = stencil.vertex[I];
              auto               place  = at_surface.find(vertex);
              if (place == at_surface.end())
                // nodes of a flat surface along faces have a support of one
                // half; those with more can't depend on others
                place =
                  at_surface
                    .emplace(vertex,
                             support(vertex) < 0.5 * (1 - rounding::places))
                    .first;
              if (place->second)
                members.push_back(I);
            }
          const double V = determinant(points.F[q]) * points.weight[q];
          for (const unsigned int I : members)
            for (const unsigned int J : members)
              if (stencil.vertex[I] <= stencil.vertex[J])
                entries[{stencil.vertex[I], stencil.vertex[J]}] +=
                  V * (stencil.gradient[I] * stencil.gradient[J]);
        }
    return entries;
  }



  template <int dim>
  void
  DependentNodes<dim>::exchange(Entries &entries) const
  {
    const MPI_Comm comm = occupancy.grid.communicator();
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    // every rank adds up the parts of all in the same order
    const unsigned int me = Utilities::MPI::this_mpi_process(comm);
    std::map<unsigned int, std::vector<std::array<double, 3>>> parts;
    for (const auto &entry : entries)
      {
        const std::array<double, 3> part = {{double(entry.first.first),
                                             double(entry.first.second),
                                             entry.second}};
        for (const unsigned int other : occupancy.ranks_near(entry.first.first))
          parts[other].push_back(part);
        parts[me].push_back(part);
      }
    const auto own = parts[me];
    parts.erase(me);
    auto received = Utilities::MPI::some_to_some(comm, parts);
    received[me]  = own;
    entries.clear();
    for (const auto &of_rank : received)
      for (const auto &part : of_rank.second)
        entries[{static_cast<unsigned int>(part[0]),
                 static_cast<unsigned int>(part[1])}] += part[2];
  }



  template class DependentNodes<2>;
  template class DependentNodes<3>;
} // namespace isochor
