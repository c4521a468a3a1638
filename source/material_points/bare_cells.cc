/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/disjoint_sets.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/bare_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace isochor
{
  namespace
  {
    /** @p cells, each brought to the rank that owns it. */
    template <int dim>
    std::set<unsigned int>
    send_to_owners(const std::set<unsigned int> &cells,
                   const SimplexGeometry<dim>   &geometry)
    {
      const MPI_Comm comm = geometry.communicator();
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        return cells;
      std::map<unsigned int, std::vector<unsigned int>> messages;
      for (const unsigned int cell : cells)
        messages[geometry.owner(cell)].push_back(cell);
      std::set<unsigned int> own;
      for (const auto &received : Utilities::MPI::some_to_some(comm, messages))
        own.insert(received.second.begin(), received.second.end());
      return own;
    }

    /** Add the cells around a point that it covers. */
    template <int dim>
    void
    add_covered_cells(const SimplexGeometry<dim> &geometry,
                      const PointArrays<dim>     &points,
                      const unsigned int          k,
                      const unsigned int          q,
                      std::set<unsigned int>     &covered)
    {
      AssertIndexRange(k, points.cell.size());
      AssertIndexRange(q, points.n_points());
      const Tensor<2, dim> inverse = invert(points.F[q]);
      const double         radius =
        std::pow(points.volume[q] * (dim == 2 ? 1. : 0.75) / numbers::PI,
                 1. / dim);
      Point<dim> x;
      for (unsigned int v = 0; v <= dim; ++v)
        x += points.shape[q][v] * points.corner(geometry, k, v);

      // face by face from the point's own cell
      std::vector<unsigned int> to_follow = {points.cell[k]};
      std::set<unsigned int>    seen      = {points.cell[k]};
      while (!to_follow.empty())
        {
          const unsigned int cell = to_follow.back();
          to_follow.pop_back();
          for (const unsigned int next : geometry.neighbours(cell))
            if (next != SimplexGeometry<dim>::no_cell &&
                seen.insert(next).second &&
                (inverse * (cell_centroid(geometry, next) - x)).norm() < radius)
              {
                covered.insert(next);
                to_follow.push_back(next);
              }
        }
    }

    /** The largest J V_0 / |e| of this rank's points. */
    template <int dim>
    double
    largest_share(const BackgroundGrid<dim> &grid,
                  const PointArrays<dim>    &points)
    {
      double share = 0;
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        {
          double largest = 0;
          for (unsigned int q = points.cell_start[k];
               q < points.cell_start[k + 1];
               ++q)
            largest =
              std::max(largest, determinant(points.F[q]) * points.volume[q]);
          share =
            std::max(share, largest / grid.geometry().measure(points.cell[k]));
        }
      return share;
    }

    /** Into how many pieces, not connected by any face, the cells of all ranks
     * fall. */
    template <int dim>
    unsigned int
    n_pieces(const BackgroundGrid<dim>       &grid,
             const std::vector<unsigned int> &own_cells)
    {
      const SimplexGeometry<dim>     &geometry = grid.geometry();
      const std::vector<unsigned int> cells =
        union_over_ranks(own_cells, grid.communicator());
      DisjointSets pieces(cells.size());
      for (unsigned int k = 0; k < cells.size(); ++k)
        for (const unsigned int other : geometry.neighbours(cells[k]))
          {
            const auto place =
              std::lower_bound(cells.begin(), cells.begin() + k, other);
            if (place != cells.begin() + k && *place == other)
              pieces.merge(k, place - cells.begin());
          }
      return pieces.size();
    }
  } // namespace



  template <int dim>
  BareCells
  find_bare_cells(const BackgroundGrid<dim> &grid,
                  const PointArrays<dim>    &points)
  {
    // points up to this share of their cell leave no cell empty that matters;
    // where cells without points are twice as much of the body a tube needed a
    // tenth less of pressure
    constexpr double            harmless_share = 0.5, tolerated_part = 0.01;
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const MPI_Comm              comm     = grid.communicator();
    BareCells                   bare;
    bare.largest_point = Utilities::MPI::max(largest_share(grid, points), comm);
    if (bare.largest_point <= harmless_share)
      return bare;
    std::set<unsigned int> covered, with_corners;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        add_covered_cells(geometry, points, k, q, covered);
    bare.cells = send_to_owners(covered, geometry);
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      bare.cells.erase(points.cell[k]);
    for (const auto &corner : points.domain_corners.cells)
      with_corners.insert(corner.second);
    for (const unsigned int cell : send_to_owners(with_corners, geometry))
      bare.cells.erase(cell);

    std::array<double, 3> sums{}; // bare cells, their volume, the body's
    for (const unsigned int cell : bare.cells)
      {
        sums[0] += 1;
        sums[1] += geometry.measure(cell);
      }
    for (unsigned int q = 0; q < points.n_points(); ++q)
      sums[2] += determinant(points.F[q]) * points.volume[q];
    sum_over_ranks(sums, comm);
    if (sums[1] <= tolerated_part * sums[2])
      bare.cells.clear();
    else
      {
        bare.n    = sums[0];
        bare.part = sums[1] / sums[2];
      }
    return bare;
  }



  template <int dim>
  void
  assert_in_one_piece(const BackgroundGrid<dim> &grid,
                      const PointArrays<dim>    &points)
  {
    const BareCells bare = find_bare_cells(grid, points);
    if (bare.n == 0)
      return;
    std::set<unsigned int> held(points.cell.begin(), points.cell.end());
    for (const auto &corner : points.domain_corners.cells)
      held.insert(corner.second);
    std::set<unsigned int> body = held;
    body.insert(bare.cells.begin(), bare.cells.end());
    const unsigned int n_held = n_pieces(grid, {held.begin(), held.end()}),
                       n_body = n_pieces(grid, {body.begin(), body.end()});
    AssertThrow(
      n_held <= n_body,
      ExcMessage("The material points are too far apart for the grid: the body "
                 "falls apart, into " +
                 std::to_string(n_held) +
                 " pieces that share no face, with the empty cells " +
                 std::to_string(n_body) + ". The largest point has " +
                 rounded(bare.largest_point) +
                 " times the volume of its cell: use more points (<Points per "
                 "cell>, <Lattice spacing>)."));
  }



  template BareCells
  find_bare_cells(const BackgroundGrid<2> &, const PointArrays<2> &);
  template void
  assert_in_one_piece(const BackgroundGrid<2> &, const PointArrays<2> &);
  template BareCells
  find_bare_cells(const BackgroundGrid<3> &, const PointArrays<3> &);
  template void
  assert_in_one_piece(const BackgroundGrid<3> &, const PointArrays<3> &);
} // namespace isochor
