/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/rounding.h>
#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/equations/invariants.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

namespace isochor
{
  namespace
  {
    template <int dim>
    PointRecords<dim>
    sorted_by_id(const PointRecords<dim> &records)
    {
      std::vector<std::size_t> order(records.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
        return records.ids[a] < records.ids[b];
      });
      PointRecords<dim> sorted(records.n_payload);
      for (const std::size_t i : order)
        sorted.push_back(records.cells[i],
                         records.ids[i],
                         records.locations[i],
                         records.payload(i));
      return sorted;
    }



    /** A boundary point and its nodes, as a checkpoint has them. */
    template <int dim>
    struct SavedPoint
    {
      unsigned int                cell = 0;
      Point<dim>                  location;
      std::vector<double>         payload;
      std::vector<unsigned int>   vertex;
      std::vector<double>         shape;
      std::vector<Tensor<1, dim>> gradient;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &cell &location &payload &vertex &shape &gradient;
      }
    };
  } // namespace



  template <int dim>
  BoundaryPoints<dim>::BoundaryPoints(const BackgroundGrid<dim> &grid,
                                      const unsigned int points_per_face)
    : grid(grid)
    , locator(std::make_unique<PointLocator<dim>>(grid.geometry()))
    , records(n_entries)
    , rule(surface_rule<dim>(points_per_face))
  {
    clear_stencils();
  }



  template <int dim>
  void
  BoundaryPoints<dim>::seed(const std::vector<SurfaceFace<dim>> &faces)
  {
    records = PointRecords<dim>(n_entries);
    // one rank hands them to the others when they are located
    if (Utilities::MPI::this_mpi_process(grid.communicator()) != 0)
      return;
    for (const SurfaceFace<dim> &face : faces)
      for (unsigned int i = 0; i < rule.size(); ++i)
        {
          std::array<double, n_entries> payload{};
          payload[surface_entry] = face.surface;
          for (unsigned int d = 0; d < dim; ++d)
            {
              payload[area_entry + d]        = rule.weight(i) * face.area[d];
              payload[F_entry + d * dim + d] = 1.;
            }
          records.push_back(face.cell,
                            records.size(),
                            place_on_face<dim>(face.corners, rule.point(i)),
                            ArrayView<const double>(payload.data(), n_entries));
        }
  }



  template <int dim>
  void
  BoundaryPoints<dim>::locate(const PointArrays<dim> &body)
  {
    clear_stencils();
    const std::vector<unsigned int> occupied =
      union_over_ranks(body.cell, grid.communicator());
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      {
        for (unsigned int b = 0; b < size(); ++b)
          records.cells[b] = find_cells(b, occupied).front();
        std::size_t n_shipped;
        // in an order that does not depend on how the points came here
        records = sorted_by_id(
          exchange_points(std::move(records), grid.geometry(), n_shipped));
      }
    for (unsigned int b = 0; b < size(); ++b)
      {
        const auto cells = find_cells(b, occupied);
        records.cells[b] = cells.front();
        add_stencil(b, cells);
      }
  }



  template <int dim>
  std::vector<unsigned int>
  BoundaryPoints<dim>::find_cells(
    const unsigned int               b,
    const std::vector<unsigned int> &occupied) const
  {
    AssertIndexRange(b, size());
    Assert(std::is_sorted(occupied.begin(), occupied.end()),
           ExcInternalError());
    const auto is_occupied = [&occupied](const unsigned int cell) {
      return std::binary_search(occupied.begin(), occupied.end(), cell);
    };
    constexpr unsigned int no_cell  = SimplexGeometry<dim>::no_cell;
    constexpr double       furthest = 30; // sizes of a cell
    const auto            &geometry = grid.geometry();
    const Point<dim>      &x        = records.locations[b];
    const auto             place    = locator->locate(x, records.cells[b]);
    const unsigned int     start = place.found ? place.cell : records.cells[b];
    if (place.found && is_occupied(start))
      {
        bool is_inside = true;
        for (unsigned int v = 0; v <= dim; ++v)
          is_inside = is_inside && (place.barycentric[v] > rounding::places ||
                                    geometry.neighbours(start)[v] == no_cell);
        if (is_inside)
          return {start};
      }
    const auto cells = nearest_cells<dim>(
      geometry, x, start, is_occupied, std::numeric_limits<double>::max());
    std::ostringstream where;
    where << x;
    AssertThrow(
      !cells.empty() && distance_to_cell(geometry, cells.front(), x) <=
                          furthest * cell_size(geometry, cells.front()),
      ExcMessage("A boundary point at (" + where.str() +
                 ") is more than 30 cells away from the body whose surface it "
                 "marks. Check <Boundary conditions/Surfaces of body> and "
                 "<Boundary conditions/Mesh of body surfaces>."));
    return cells;
  }



  template <int dim>
  void
  BoundaryPoints<dim>::clear_stencils()
  {
    stencil_start.assign(1, 0);
    stencil_vertex.clear();
    stencil_shape.clear();
    stencil_gradient.clear();
  }



  template <int dim>
  void
  BoundaryPoints<dim>::add_stencil(const unsigned int               b,
                                   const std::vector<unsigned int> &cells)
  {
    AssertDimension(stencil_start.size(), b + 1);
    Assert(!cells.empty(), ExcMessage("The point is far from the body."));
    const SimplexGeometry<dim>          &geometry = grid.geometry();
    const std::size_t                    begin    = stencil_start.back();
    typename ShapeFunctions<dim>::Values at;
    for (const unsigned int cell : cells)
      {
        grid.shape_functions().evaluate(
          cell, geometry.barycentric(cell, records.locations[b]), at);
        for (unsigned int I = 0; I < at.n_nodes; ++I)
          {
            const unsigned int vertex = at.vertex[I];
            const std::size_t  i = std::find(stencil_vertex.begin() + begin,
                                            stencil_vertex.end(),
                                            vertex) -
                                  stencil_vertex.begin();
            if (i == stencil_vertex.size())
              {
                stencil_vertex.push_back(vertex);
                stencil_shape.push_back(0);
                stencil_gradient.emplace_back();
              }
            stencil_shape[i] += at.shape[I] / cells.size();
            stencil_gradient[i] +=
              at.gradient[I] / static_cast<double>(cells.size());
          }
      }
    stencil_start.push_back(stencil_vertex.size());
  }



  template <int dim>
  void
  BoundaryPoints<dim>::touch_vertices(std::vector<unsigned int> &vertices) const
  {
    vertices.insert(vertices.end(),
                    stencil_vertex.begin(),
                    stencil_vertex.end());
  }



  template <int dim>
  void
  BoundaryPoints<dim>::advance(const StepContext<dim> &step,
                               const NodalField       &unknowns)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    AssertDimension(stencil_start.size(), size() + 1);
    const NodalUnknowns<dim> nodal(step, unknowns);
    for (unsigned int b = 0; b < size(); ++b)
      {
        const auto           at          = place(b);
        const Tensor<1, dim> increment   = nodal.increment_at(at);
        const Tensor<2, dim> F_increment = nodal.deformation_at(at);
        // for a step on the grid as it is then; see GridReset
        if (determinant(F_increment) > 0)
          {
            const Tensor<2, dim> inverse = invert(F_increment);
            for (std::size_t i = stencil_start[b]; i < stencil_start[b + 1];
                 ++i)
              stencil_gradient[i] = stencil_gradient[i] * inverse;
          }
        const Tensor<2, dim> new_F = F_increment * at.F;
        records.locations[b] += increment;
        double *const payload = &records.payloads[b * n_entries];
        for (unsigned int d = 0; d < dim; ++d)
          {
            payload[displacement_entry + d] += increment[d];
            for (unsigned int e = 0; e < dim; ++e)
              payload[F_entry + d * dim + e] = new_F[d][e];
          }
      }
  }



  template <int dim>
  typename SurfaceForces<dim>::Place
  BoundaryPoints<dim>::place(const unsigned int b) const
  {
    AssertIndexRange(b + 1, stencil_start.size());
    typename SurfaceForces<dim>::Place at;
    const auto                         payload = records.payload(b);
    for (unsigned int d = 0; d < dim; ++d)
      {
        at.displacement[d] = payload[displacement_entry + d];
        at.area[d]         = payload[area_entry + d];
        for (unsigned int e = 0; e < dim; ++e)
          at.F[d][e] = payload[F_entry + d * dim + e];
      }
    at.X = Point<dim>(records.locations[b] - at.displacement);
    const std::size_t begin = stencil_start[b];
    at.n_nodes              = stencil_start[b + 1] - begin;
    at.vertex               = stencil_vertex.data() + begin;
    at.shape.assign(stencil_shape.begin() + begin,
                    stencil_shape.begin() + stencil_start[b + 1]);
    at.gradient = stencil_gradient.data() + begin;
    return at;
  }



  template <int dim>
  std::string
  BoundaryPoints<dim>::save_state() const
  {
    std::map<types::particle_index, SavedPoint<dim>> points, all;
    for (unsigned int b = 0; b < size(); ++b)
      {
        const auto payload     = records.payload(b);
        const auto at          = place(b);
        points[records.ids[b]] = {records.cells[b],
                                  records.locations[b],
                                  {payload.begin(), payload.end()},
                                  {at.vertex, at.vertex + at.n_nodes},
                                  at.shape,
                                  {at.gradient, at.gradient + at.n_nodes}};
      }
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), points))
      all.insert(of_rank.begin(), of_rank.end());
    const std::vector<char> state = Utilities::pack(all, false);
    return std::string(state.begin(), state.end());
  }



  template <int dim>
  void
  BoundaryPoints<dim>::load_state(const std::string &state)
  {
    records = PointRecords<dim>(n_entries);
    clear_stencils();
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    for (const auto &[id, point] :
         Utilities::unpack<std::map<types::particle_index, SavedPoint<dim>>>(
           std::vector<char>(state.begin(), state.end()), false))
      if (grid.geometry().owner(point.cell) == rank)
        {
          records.push_back(point.cell,
                            id,
                            point.location,
                            make_array_view(point.payload));
          stencil_vertex.insert(stencil_vertex.end(),
                                point.vertex.begin(),
                                point.vertex.end());
          stencil_shape.insert(stencil_shape.end(),
                               point.shape.begin(),
                               point.shape.end());
          stencil_gradient.insert(stencil_gradient.end(),
                                  point.gradient.begin(),
                                  point.gradient.end());
          stencil_start.push_back(stencil_vertex.size());
        }
  }



  template class BoundaryPoints<2>;
  template class BoundaryPoints<3>;
} // namespace isochor
