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
    const auto       filled = sample_boundary_cells(points, occupancy, locator);
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        const unsigned int cell = points.cell[k];
        if (occupancy.is_interior(cell))
          continue;
        const auto   sampled = filled.find(cell);
        const double fill =
          std::min(sampled == filled.end() ? 0. : sampled->second,
                   grid.geometry().measure(cell));
        const double factor =
          std::max(smallest,
                   std::min(largest, fill / occupancy.content(cell)->volume));
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

    // domains in cells that touch a cell at the surface may reach into it
    std::set<unsigned int> near;
    for (const auto &content : occupancy.occupied_cells())
      if (!occupancy.is_interior(content.cell))
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
                // beyond a wall: in the wall's cell
                filled[place.found ? place.cell : cell] +=
                  samples.weight(s) * V;
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



  namespace
  {
    /** A deformation gradient for a hole, with the mean volume change of the
     * cells around. The mean of F alone would not have it: that of rotated or
     * sheared neighbours may even have a negative determinant. */
    template <int dim>
    Tensor<2, dim>
    mean_deformation(const typename CellOccupancy<dim>::Content &hole)
    {
      const double   J      = hole.volume / hole.reference_volume;
      Tensor<2, dim> F      = hole.volume_times_F / hole.reference_volume;
      double         mean_J = determinant(F);
      if (mean_J < 0.1 * J)
        {
          F      = unit_symmetric_tensor<dim>();
          mean_J = 1;
        }
      return std::pow(J / mean_J, 1. / dim) * F;
    }
  } // namespace



  template <int dim>
  void
  BodyQuadrature<dim>::add_hole_points(
    PointArrays<dim>         &points,
    const CellOccupancy<dim> &occupancy) const
  {
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::map<unsigned int, const typename CellOccupancy<dim>::Content *> holes;
    for (const auto &content : occupancy.occupied_cells())
      if (content.is_hole && grid.geometry().owner(content.cell) == rank)
        holes[content.cell] = &content;

    for (const auto &hole : holes)
      {
        const Tensor<2, dim> F = mean_deformation<dim>(*hole.second);
        points.cell.push_back(hole.first);
        points.cell_start.push_back(points.cell_start.back() + 1);
        points.shape.emplace_back();
        points.shape.back().fill(1. / (dim + 1));
        points.volume.push_back(0);
        points.mass.push_back(0);
        points.weight.push_back(grid.geometry().measure(hole.first) /
                                determinant(F));
        points.pressure.push_back(0);
        points.F.push_back(F);
        points.material.push_back(hole.second->material);
        const double *const history = occupancy.history(*hole.second);
        points.history.insert(points.history.end(),
                              history,
                              history + points.n_history);
        if (!points.velocity.empty())
          {
            points.velocity.emplace_back();
            points.acceleration.emplace_back();
          }
        if (!points.domain.empty())
          points.domain.emplace_back();
      }
  }



  template class BodyQuadrature<2>;
  template class BodyQuadrature<3>;
} // namespace isochor
