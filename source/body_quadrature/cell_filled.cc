/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/body_quadrature.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace isochor
{
  template <int dim>
  void
  BodyQuadrature<dim>::fill_interior_cells(
    PointArrays<dim>         &points,
    const CellOccupancy<dim> &occupancy) const
  {
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        const unsigned int cell = points.cell[k];
        if (!occupancy.is_interior(cell))
          continue;
        const double factor =
          grid.geometry().measure(cell) / occupancy.content(cell)->volume;
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          points.weight[q] *= factor;
      }
  }



  namespace
  {
    /** Whether the body fills the occupied @p cell, or a hole is integrated as
     * if it did. */
    template <int dim>
    bool
    is_full(const unsigned int cell, const CellOccupancy<dim> &occupancy)
    {
      return occupancy.is_interior(cell) || occupancy.content(cell)->is_hole;
    }

    /** Whether an occupied cell at the surface shares a vertex with @p cell. */
    template <int dim>
    bool
    is_next_to_boundary(const unsigned int        cell,
                        const CellOccupancy<dim> &occupancy)
    {
      for (const unsigned int v :
           occupancy.grid.geometry().vertex_indices(cell))
        for (const unsigned int other : occupancy.cells_at(v))
          if (occupancy.content(other) != nullptr && !is_full(other, occupancy))
            return true;
      return false;
    }

    /** The cells that share a vertex with @p cell, each once. */
    template <int dim>
    void
    find_cells_around(const unsigned int         cell,
                      const CellOccupancy<dim>  &occupancy,
                      std::vector<unsigned int> &around)
    {
      around.clear();
      for (const unsigned int v :
           occupancy.grid.geometry().vertex_indices(cell))
        for (const unsigned int other : occupancy.cells_at(v))
          if (other != cell)
            around.push_back(other);
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
    }

    /**
     * The samples of cells that are full whatever they say, by cell in
     * @p excess, don't add up to their measures: domains overlap or leave gaps.
     * What is too much or too little there is too little or too much nearby:
     * the cells of @p filled around them get it, in proportion to what they
     * hold.
     */
    template <int dim>
    void
    pass_on(const CellOccupancy<dim>             &occupancy,
            const std::map<unsigned int, double> &excess,
            std::map<unsigned int, double>       &filled)
    {
      std::vector<unsigned int>      around;
      std::map<unsigned int, double> change;
      for (const auto &from : excess)
        {
          double sum = 0;
          find_cells_around(from.first, occupancy, around);
          for (const unsigned int cell : around)
            {
              const auto to = filled.find(cell);
              sum += to == filled.end() ? 0. : to->second;
            }
          // a cell gives at most half of what it holds
          const double factor =
            sum > 0 ? std::max(from.second / sum, -0.5) : 0.;
          for (const unsigned int cell : around)
            {
              const auto to = filled.find(cell);
              if (to != filled.end())
                change[cell] += factor * to->second;
            }
        }
      for (const auto &cell : change)
        filled[cell.first] =
          std::max(filled[cell.first] + cell.second, 0.5 * filled[cell.first]);
    }

    /**
     * What the cells of @p filled hold beyond their measure goes to those
     * around them that have room, in proportion to the room; what finds none
     * stays. Domains that overlap in one place leave gaps nearby: cutting off
     * what is too much without filling the gaps would lose volume in each step.
     */
    template <int dim>
    void
    level(const CellOccupancy<dim>       &occupancy,
          std::map<unsigned int, double> &filled)
    {
      const SimplexGeometry<dim> &geometry = occupancy.grid.geometry();
      const auto room = [&](const std::pair<const unsigned int, double> &cell) {
        return geometry.measure(cell.first) - cell.second;
      };
      // what full cells offer, and how much of it each other cell is offered
      std::vector<unsigned int>      around;
      std::map<unsigned int, double> room_around, offered;
      for (const auto &from : filled)
        if (room(from) < 0)
          {
            double sum = 0;
            find_cells_around(from.first, occupancy, around);
            for (const unsigned int cell : around)
              {
                const auto to = filled.find(cell);
                if (to != filled.end())
                  sum += std::max(0., room(*to));
              }
            room_around[from.first] = sum;
            for (const unsigned int cell : around)
              {
                const auto to = filled.find(cell);
                if (to != filled.end() && room(*to) > 0)
                  offered[cell] -= room(from) * room(*to) / sum;
              }
          }
      // no cell takes more than it has room for
      std::map<unsigned int, double> change;
      for (const auto &from : room_around)
        {
          const double excess = -room(*filled.find(from.first));
          find_cells_around(from.first, occupancy, around);
          for (const unsigned int cell : around)
            {
              const auto to = filled.find(cell);
              if (to == filled.end() || !(room(*to) > 0))
                continue;
              const double part = excess * room(*to) / from.second *
                                  std::min(1., room(*to) / offered[cell]);
              change[cell] += part;
              change[from.first] -= part;
            }
        }
      for (const auto &cell : change)
        filled[cell.first] += cell.second;
    }
  } // namespace



  template <int dim>
  void
  BodyQuadrature<dim>::fill_boundary_cells(
    PointArrays<dim>         &points,
    const CellOccupancy<dim> &occupancy,
    const PointLocator<dim>  &locator) const
  {
    // further away from the points' own volume the samples are not to be
    // trusted
    constexpr double smallest = 0.2, largest = 5;

    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::map<unsigned int, double> filled, excess; // at the surface, behind it
    for (const auto &cell : sample_boundary_cells(points, occupancy, locator))
      if (grid.geometry().owner(cell.first) != rank)
        continue;
      else if (!is_full(cell.first, occupancy))
        filled.insert(cell);
      else if (is_next_to_boundary(cell.first, occupancy))
        excess[cell.first] = cell.second - grid.geometry().measure(cell.first);
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      if (!occupancy.is_interior(points.cell[k]))
        filled.emplace(points.cell[k], 0.);
    occupancy.share(filled);
    occupancy.share(excess);
    pass_on(occupancy, excess, filled);
    level(occupancy, filled);

    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        const unsigned int cell = points.cell[k];
        if (occupancy.is_interior(cell))
          continue;
        const double factor =
          std::max(smallest,
                   std::min(largest,
                            filled[cell] / occupancy.content(cell)->volume));
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          points.weight[q] *= factor;
      }
  }



  template <int dim>
  std::map<unsigned int, double>
  BodyQuadrature<dim>::sample_boundary_cells(
    const PointArrays<dim>   &points,
    const CellOccupancy<dim> &occupancy,
    const PointLocator<dim>  &locator) const
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const Quadrature<dim>       samples =
      material_point_rule<dim>(dim == 2 ? 36 : 64);

    // domains in the cells around a cell may reach into it
    std::set<unsigned int> near;
    for (const auto &content : occupancy.occupied_cells())
      if (!is_full(content.cell, occupancy) ||
          is_next_to_boundary(content.cell, occupancy))
        for (const unsigned int v : geometry.vertex_indices(content.cell))
          near.insert(v);

    std::map<unsigned int, double> filled;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        const unsigned int cell     = points.cell[k];
        const auto        &vertices = geometry.vertex_indices(cell);
        if (std::none_of(vertices.begin(),
                         vertices.end(),
                         [&](const unsigned int v) { return near.count(v); }))
          continue;
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const Point<dim> centre = location(points, k, q);
            const double     V = determinant(points.F[q]) * points.volume[q];
            for (unsigned int s = 0; s < samples.size(); ++s)
              {
                Tensor<1, dim> r = points.domain[q][0];
                for (unsigned int d = 0; d < dim; ++d)
                  r += samples.point(s)[d] *
                       (points.domain[q][d + 1] - points.domain[q][0]);
                const auto place =
                  locator.locate(centre + points.F[q] * r, cell);
                // where the grid or the points end it counts for the own cell
                const bool in_body =
                  place.found && occupancy.content(place.cell) != nullptr;
                filled[in_body ? place.cell : cell] += samples.weight(s) * V;
              }
          }
      }

    // what lies in cells of other ranks goes to these
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::map<unsigned int, std::vector<std::pair<unsigned int, double>>> sent;
    for (const auto &fill : filled)
      if (geometry.owner(fill.first) != rank)
        sent[geometry.owner(fill.first)].push_back(fill);
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      for (const auto &received :
           Utilities::MPI::some_to_some(grid.communicator(), sent))
        for (const auto &fill : received.second)
          filled[fill.first] += fill.second;
    return filled;
  }



  template class BodyQuadrature<2>;
  template class BodyQuadrature<3>;
} // namespace isochor
