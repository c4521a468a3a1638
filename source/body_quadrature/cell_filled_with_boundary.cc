/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plugin_registry.h>
#include <isochor/base/rounding.h>
#include <isochor/body_quadrature/body_quadrature.h>
#include <isochor/body_quadrature/cell_filling.h>
#include <isochor/grid/simplex_overlap.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace isochor
{
  /** As CellFilled; in addition cells at the surface are scaled to the part of
   * them that the body fills, the sum of their overlaps with the points'
   * convected domains; by a factor in [0.02, 5], or larger as far as it takes
   * to fill the cell. What the domains fill of cells without points is
   * integrated by a massless point with the state of those around, as holes
   * are. */
  template <int dim>
  class CellFilledWithBoundary : public BodyQuadrature<dim>
  {
  public:
    bool
    needs_domains() const override
    {
      return true;
    }

    void
    start_step(PointArrays<dim> &points,
               const PointLocator<dim> & /*locator*/,
               const MixedKernel<dim> &kernel,
               const bool /*with_occupancy*/,
               CellOccupancy<dim> &occupancy) const override
    {
      occupancy.update(points, kernel, true);
      fill_interior_cells(points, occupancy);
      const auto bare = fill_boundary_cells(points, occupancy);
      occupancy.add_cells(bare);
      add_hole_points(points, occupancy, kernel, bare);
    }

  private:
    /** Returns what the body fills of cells without points, of this rank and
     * near it. */
    std::map<unsigned int, double>
    fill_boundary_cells(PointArrays<dim>         &points,
                        const CellOccupancy<dim> &occupancy) const;
    std::map<unsigned int, double>
    fill_of_boundary_cells(const PointArrays<dim>   &points,
                           const CellOccupancy<dim> &occupancy) const;
  };



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
     * The domains in cells that are full whatever they say don't add up to
     * the cells' measures, by the @p excess: domains overlap or leave gaps.
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
  } // namespace



  template <int dim>
  std::map<unsigned int, double>
  CellFilledWithBoundary<dim>::fill_boundary_cells(
    PointArrays<dim>         &points,
    const CellOccupancy<dim> &occupancy) const
  {
    // further away from the points' own volume the domains are not to be
    // trusted, unless they fill the cell: where points have been split, a cell
    // may hold a single small one, and parts of many others
    constexpr double smallest = 0.02, largest = 5;

    const BackgroundGrid<dim> &grid = occupancy.grid;
    const unsigned int         rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    // without points, at the surface, behind it
    std::map<unsigned int, double> empty, filled, excess;
    for (const auto &cell : fill_of_boundary_cells(points, occupancy))
      if (grid.geometry().owner(cell.first) != rank)
        continue;
      else if (occupancy.content(cell.first) == nullptr)
        {
          if (cell.second >
              rounding::accumulated * grid.geometry().measure(cell.first))
            empty.insert(cell);
        }
      else if (!is_full(cell.first, occupancy))
        filled.insert(cell);
      else if (is_next_to_boundary(cell.first, occupancy))
        excess[cell.first] = cell.second - grid.geometry().measure(cell.first);
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      if (!occupancy.is_interior(points.cell[k]))
        filled.emplace(points.cell[k], 0.);
    occupancy.share(empty);
    occupancy.share(filled);
    occupancy.share(excess);
    pass_on(occupancy, excess, filled);

    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        const unsigned int cell = points.cell[k];
        if (occupancy.is_interior(cell))
          continue;
        const double volume = occupancy.content(cell)->volume;
        const double factor =
          std::max(smallest,
                   std::min(std::max(largest,
                                     grid.geometry().measure(cell) / volume),
                            filled[cell] / volume));
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          points.weight[q] *= factor;
      }
    return empty;
  }



  namespace
  {
    /** Whether points act on a node of @p cell. */
    template <int dim>
    bool
    is_within_reach(const unsigned int        cell,
                    const CellOccupancy<dim> &occupancy)
    {
      const auto &vertices = occupancy.grid.geometry().vertex_indices(cell);
      return std::any_of(vertices.begin(),
                         vertices.end(),
                         [&](const unsigned int v) {
                           return occupancy.is_active(v);
                         });
    }



    /** The volumes that the simplex with @p corners shares with cells, found
     * face by face from @p start on, in which it has its centroid. */
    template <int dim>
    void
    find_overlaps(const SimplexGeometry<dim>            &geometry,
                  const std::array<Point<dim>, dim + 1> &corners,
                  const unsigned int                     start,
                  std::map<unsigned int, double>        &overlaps)
    {
      std::vector<unsigned int> to_follow = {start};
      std::set<unsigned int>    seen      = {start};
      SimplexInCell<dim>        simplex;
      overlaps.clear();
      while (!to_follow.empty())
        {
          const unsigned int cell = to_follow.back();
          to_follow.pop_back();
          for (unsigned int c = 0; c <= dim; ++c)
            simplex[c] = geometry.barycentric(cell, corners[c]);
          const double overlap =
            geometry.measure(cell) * overlap_with_cell<dim>(simplex);
          if (cell != start && !(overlap > 0))
            continue;
          overlaps[cell] = overlap;
          for (unsigned int f = 0; f <= dim; ++f)
            {
              const unsigned int next = geometry.neighbours(cell)[f];
              // only across faces that the simplex reaches
              if (next != SimplexGeometry<dim>::no_cell &&
                  std::any_of(simplex.begin(),
                              simplex.end(),
                              [&](const auto &lambda) {
                                return lambda[f] < 0;
                              }) &&
                  seen.insert(next).second)
                to_follow.push_back(next);
            }
        }
    }
  } // namespace



  template <int dim>
  std::map<unsigned int, double>
  CellFilledWithBoundary<dim>::fill_of_boundary_cells(
    const PointArrays<dim>   &points,
    const CellOccupancy<dim> &occupancy) const
  {
    const BackgroundGrid<dim>  &grid     = occupancy.grid;
    const SimplexGeometry<dim> &geometry = grid.geometry();

    // domains in the cells around a cell may reach into it
    std::set<unsigned int> near;
    for (const auto &content : occupancy.occupied_cells())
      if (!is_full(content.cell, occupancy) ||
          is_next_to_boundary(content.cell, occupancy))
        for (const unsigned int v : geometry.vertex_indices(content.cell))
          near.insert(v);

    std::map<unsigned int, double>  filled;
    std::array<Point<dim>, dim + 1> corners;
    std::map<unsigned int, double>  overlaps;
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
            const Point<dim> centre = points.location(geometry, k, q);
            for (unsigned int c = 0; c <= dim; ++c)
              corners[c] = centre + points.F[q] * points.domain[q][c];
            find_overlaps(geometry, corners, cell, overlaps);
            // what is out of reach of the nodes counts for the own cell
            const double V       = determinant(points.F[q]) * points.volume[q];
            double       outside = V;
            for (const auto &overlap : overlaps)
              if (is_within_reach(overlap.first, occupancy))
                {
                  filled[overlap.first] += overlap.second;
                  outside -= overlap.second;
                }
            filled[cell] += outside;
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



  ISOCHOR_REGISTER_FOR_DIMENSION(BodyQuadrature,
                                 CellFilledWithBoundary,
                                 "cell-filled + boundary")
} // namespace isochor
