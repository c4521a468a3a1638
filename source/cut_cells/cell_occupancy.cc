/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/cut_cells/cell_occupancy.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Ranks that some vertices know of. */
    class RanksOfVertices
    {
    public:
      using Entries =
        std::vector<std::pair<unsigned int, std::vector<unsigned int>>>;

      explicit RanksOfVertices(const unsigned int n_vertices)
        : number(n_vertices, numbers::invalid_unsigned_int)
      {}

      void
      add(const unsigned int vertex, const unsigned int rank)
      {
        if (number[vertex] == numbers::invalid_unsigned_int)
          {
            number[vertex] = entries.size();
            entries.push_back({vertex, {}});
            n_taken.push_back(0);
          }
        auto &ranks = entries[number[vertex]].second;
        if (std::find(ranks.begin(), ranks.end(), rank) == ranks.end())
          ranks.push_back(rank);
      }

      /** What has been added since the last call. */
      Entries
      take_new()
      {
        Entries result;
        for (std::size_t i = 0; i < entries.size(); ++i)
          {
            const auto &[vertex, ranks] = entries[i];
            if (n_taken[i] < ranks.size())
              result.push_back(
                {vertex, {ranks.begin() + n_taken[i], ranks.end()}});
            n_taken[i] = ranks.size();
          }
        return result;
      }

      const Entries &
      all() const
      {
        return entries;
      }

    private:
      std::vector<unsigned int> number; ///< by vertex, of its entry
      Entries                   entries;
      std::vector<std::size_t>  n_taken;
    };
  } // namespace



  template <int dim>
  CellOccupancy<dim>::CellOccupancy(const BackgroundGrid<dim> &grid)
    : grid(grid)
  {}



  template <int dim>
  void
  CellOccupancy<dim>::find_cells_at_vertices()
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    n_cells_at.assign(grid.triangulation().n_vertices(), 0);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      for (const unsigned int v : geometry.vertex_indices(cell))
        ++n_cells_at[v];
    cells_at_start.assign(n_cells_at.size() + 1, 0);
    std::partial_sum(n_cells_at.begin(),
                     n_cells_at.end(),
                     cells_at_start.begin() + 1);
    cells_at_vertices.resize(cells_at_start.back());
    std::vector<unsigned int> next(cells_at_start.begin(),
                                   cells_at_start.end() - 1);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      for (const unsigned int v : geometry.vertex_indices(cell))
        cells_at_vertices[next[v]++] = cell;
  }



  template <int dim>
  void
  CellOccupancy<dim>::find_near_ranks()
  {
    near_ranks.clear();
    near_number.clear();
    const MPI_Comm     comm    = grid.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return;
    const unsigned int this_rank = Utilities::MPI::this_mpi_process(comm);
    const SimplexGeometry<dim> &geometry = grid.geometry();
    RanksOfVertices             near(n_cells_at.size());
    std::vector<unsigned int>   owners(n_cells_at.size());
    near_number.assign(owners.size(), 0);
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      near_ranks.push_back({rank});
    for (unsigned int v = 0; v < owners.size(); ++v)
      if (n_cells_at[v] > 0)
        {
          owners[v]      = owner_at(v);
          near_number[v] = owners[v] == this_rank ? 0 : owners[v] + 1;
        }
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      for (const unsigned int v : geometry.vertex_indices(cell))
        if (geometry.owner(cell) != owners[v])
          {
            near.add(v, owners[v]);
            near.add(v, geometry.owner(cell));
          }
    for (unsigned int layer = 0; layer < n_near_layers; ++layer)
      {
        // (those that are new are handed on in the next layer)
        for (const auto &[v, ranks] : near.take_new())
          for (const unsigned int c : cells_at(v))
            for (const unsigned int w : geometry.vertex_indices(c))
              {
                for (const unsigned int rank : ranks)
                  near.add(w, rank);
                near.add(w, owner_at(w));
              }
      }
    for (const auto &[v, ranks] : near.all())
      {
        near_ranks.emplace_back();
        near_number[v]                    = near_ranks.size();
        std::vector<unsigned int> &others = near_ranks.back();
        std::remove_copy(ranks.begin(),
                         ranks.end(),
                         std::back_inserter(others),
                         this_rank);
        std::sort(others.begin(), others.end());
      }
  }



  template <int dim>
  void
  CellOccupancy<dim>::clear()
  {
    for (const Content &content : contents)
      entry_of_cell[content.cell] = numbers::invalid_unsigned_int;
    for (const unsigned int v : active_list)
      vertex_active[v] = 0;
    contents.clear();
    active_list.clear();
  }



  template <int dim>
  void
  CellOccupancy<dim>::activate(const unsigned int vertex)
  {
    AssertIndexRange(vertex, vertex_active.size());
    if (vertex_active[vertex])
      return;
    vertex_active[vertex] = 1;
    active_list.push_back(vertex);
  }



  template <int dim>
  typename CellOccupancy<dim>::Content &
  CellOccupancy<dim>::entry(const unsigned int cell)
  {
    AssertIndexRange(cell, entry_of_cell.size());
    unsigned int &index = entry_of_cell[cell];
    if (index == numbers::invalid_unsigned_int)
      {
        index = contents.size();
        contents.emplace_back();
        contents.back().cell = cell;
      }
    return contents[index];
  }



  template <int dim>
  void
  CellOccupancy<dim>::update(const PointArrays<dim> &points,
                             const MixedKernel<dim> &kernel)
  {
    clear();
    add_own(points, kernel);
    exchange();
  }



  template <int dim>
  void
  CellOccupancy<dim>::add_own(const PointArrays<dim> &points,
                              const MixedKernel<dim> &kernel)
  {
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      {
        Content &content = entry(points.cell[k]);
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const double V0 = points.volume[q];
            content.reference_volume += V0;
            const double G =
              kernel.materials[points.material[q]]->shear_modulus();
            content.volume_over_G += V0 / G;
            const auto stencil = points.stencil(grid.geometry(), k, q);
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              activate(stencil.vertex[I]);
          }
      }
    for (const auto &corner : points.domain_corners.cells)
      entry(corner.second);
  }



  template <int dim>
  std::vector<unsigned int>
  CellOccupancy<dim>::ranks_near_cell(const unsigned int cell) const
  {
    std::vector<unsigned int> ranks; // of most cells none
    for (const unsigned int v : grid.geometry().vertex_indices(cell))
      for (const unsigned int rank : ranks_near(v))
        if (std::find(ranks.begin(), ranks.end(), rank) == ranks.end())
          ranks.push_back(rank);
    std::sort(ranks.begin(), ranks.end());
    return ranks;
  }



  template <int dim>
  void
  CellOccupancy<dim>::exchange()
  {
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) == 1)
      return;

    // per rank: the number of active vertices, these, and the cells
    std::map<unsigned int, std::vector<double>> messages, cells;
    for (const unsigned int v : active_list)
      for (const unsigned int rank : ranks_near(v))
        messages[rank].push_back(v);
    for (const Content &content : contents)
      {
        for (const unsigned int rank : ranks_near_cell(content.cell))
          {
            std::vector<double> &out = cells[rank];
            out.insert(out.end(),
                       {double(content.cell),
                        content.reference_volume,
                        content.volume_over_G});
          }
      }
    for (auto &cell : cells)
      messages[cell.first];
    for (auto &message : messages)
      {
        message.second.insert(message.second.begin(), message.second.size());
        const auto &of_cells = cells[message.first];
        message.second.insert(message.second.end(),
                              of_cells.begin(),
                              of_cells.end());
      }
    for (const auto &received :
         Utilities::MPI::some_to_some(grid.communicator(), messages))
      add_received(received.second);
  }



  template <int dim>
  void
  CellOccupancy<dim>::add_received(const std::vector<double> &message)
  {
    Assert(!message.empty(), ExcInternalError());
    AssertDimension(
      (message.size() - 1 - static_cast<std::size_t>(message[0])) % 3, 0u);
    const std::size_t n_vertices = message[0];
    for (std::size_t i = 1; i <= n_vertices; ++i)
      activate(static_cast<unsigned int>(message[i]));
    for (std::size_t i = 1 + n_vertices; i < message.size(); i += 3)
      {
        const double *in = &message[i];
        Content      &to = entry(static_cast<unsigned int>(in[0]));
        to.reference_volume += in[1];
        to.volume_over_G += in[2];
      }
  }



  template <int dim>
  bool
  CellOccupancy<dim>::is_closed(const unsigned int cell) const
  {
    for (const unsigned int v : grid.geometry().vertex_indices(cell))
      if (!is_active(v))
        return false;
    return true;
  }



  template class CellOccupancy<2>;
  template class CellOccupancy<3>;
} // namespace isochor
