/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/cut_cells/cell_occupancy.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void
  CellOccupancy<dim>::find_hole_cells()
  {
    constexpr unsigned int none = SimplexGeometry<dim>::no_cell;
    std::set<unsigned int> candidates;
    for (const Content &content : contents)
      for (const unsigned int cell : grid.geometry().neighbours(content.cell))
        if (cell != none && this->content(cell) == nullptr)
          candidates.insert(cell);

    has_cavity = false;
    std::vector<Content> holes;
    while (!candidates.empty())
      {
        const std::set<unsigned int> gap =
          empty_cells_around(*candidates.begin());
        const Content hole = fill_of_gap(gap);
        for (const unsigned int cell : gap)
          {
            candidates.erase(cell);
            if (hole.is_hole)
              {
                const double measure = grid.geometry().measure(cell);
                holes.push_back(hole);
                holes.back().cell   = cell;
                holes.back().volume = measure;
                holes.back().reference_volume *= measure;
                holes.back().volume_times_G *= measure;
              }
          }
      }
    for (const Content &hole : holes)
      {
        entry_of_cell[hole.cell] = contents.size();
        contents.push_back(hole);
        for (const unsigned int v : grid.geometry().vertex_indices(hole.cell))
          ++n_occupied_at[v];
      }
  }



  template <int dim>
  std::set<unsigned int>
  CellOccupancy<dim>::empty_cells_around(const unsigned int cell) const
  {
    Assert(content(cell) == nullptr, ExcMessage("The cell holds points."));
    const unsigned int most = compares_with_seeding ? most_cells : largest_hole;
    std::set<unsigned int>    gap       = {cell};
    std::vector<unsigned int> to_follow = {cell};
    while (!to_follow.empty() && gap.size() <= most)
      {
        const unsigned int next = to_follow.back();
        to_follow.pop_back();
        for (const unsigned int other : grid.geometry().neighbours(next))
          if (other != SimplexGeometry<dim>::no_cell &&
              content(other) == nullptr && gap.insert(other).second)
            to_follow.push_back(other);
      }
    return gap;
  }



  template <int dim>
  typename CellOccupancy<dim>::Content
  CellOccupancy<dim>::fill_of_gap(const std::set<unsigned int> &gap)
  {
    Assert(!gap.empty(), ExcInternalError());
    const SimplexGeometry<dim> &geometry = grid.geometry();
    Content                     hole;
    if (gap.size() > (compares_with_seeding ? most_cells : largest_hole))
      return hole; // the gap may be larger than what was looked at
    unsigned int n_neighbours = 0;
    double       J = 0, G = 0, volume = 0, volume_times_seeded = 0;
    for (const unsigned int cell : gap)
      for (unsigned int i = 0; i <= dim; ++i)
        {
          const unsigned int other = geometry.neighbours(cell)[i];
          if (other == SimplexGeometry<dim>::no_cell)
            {
              for (unsigned int v = 0; v <= dim; ++v)
                if (v != i &&
                    is_at_open_boundary(geometry.vertex_indices(cell)[v]))
                  return hole;
              continue;
            }
          if (gap.count(other) != 0)
            continue;
          const Content &neighbour = *content(other);
          if (!(neighbour.reference_volume > 0))
            return hole;
          ++n_neighbours;
          J += neighbour.volume / neighbour.reference_volume;
          G += neighbour.volume_times_G / neighbour.reference_volume;
          volume += neighbour.volume;
          volume_times_seeded += neighbour.volume_times_seeded;
        }
    if (n_neighbours < dim)
      return hole;
    hole.is_hole = is_small(gap, volume_times_seeded / volume);
    if (hole.is_hole)
      {
        hole.reference_volume = n_neighbours / J;
        hole.volume_times_G   = G / J;
      }
    else
      has_cavity = true;
    return hole;
  }



  template <int dim>
  double
  CellOccupancy<dim>::volume_of(const std::set<unsigned int> &gap) const
  {
    double volume = 0;
    for (const unsigned int cell : gap)
      volume += grid.geometry().measure(cell);
    return volume;
  }



  template <int dim>
  bool
  CellOccupancy<dim>::has_cavities() const
  {
    return Utilities::MPI::max(has_cavity ? 1 : 0, grid.communicator()) == 1;
  }



  template <int dim>
  bool
  CellOccupancy<dim>::is_small(const std::set<unsigned int> &gap,
                               const double                  point) const
  {
    if (gap.size() <= largest_hole)
      return true;
    if (!compares_with_seeding || !large_holes_are_allowed)
      return false;
    return volume_of(gap) <= most_points * point && is_compact(gap);
  }



  template <int dim>
  bool
  CellOccupancy<dim>::is_compact(const std::set<unsigned int> &gap) const
  {
    Assert(!gap.empty(), ExcInternalError());
    for (const unsigned int start : gap)
      {
        std::set<unsigned int>    reached = {start};
        std::vector<unsigned int> last    = {start};
        for (unsigned int step = 0; step < largest_extent; ++step)
          {
            std::vector<unsigned int> next;
            for (const unsigned int cell : last)
              for (const unsigned int other : grid.geometry().neighbours(cell))
                if (gap.count(other) != 0 && reached.insert(other).second)
                  next.push_back(other);
            last.swap(next);
          }
        if (reached.size() < gap.size())
          return false;
      }
    return true;
  }



  template void
  CellOccupancy<2>::find_hole_cells();
  template bool
  CellOccupancy<2>::has_cavities() const;
  template void
  CellOccupancy<3>::find_hole_cells();
  template bool
  CellOccupancy<3>::has_cavities() const;
} // namespace isochor
