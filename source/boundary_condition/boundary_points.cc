/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace isochor
{
  /** The cells that boundary points may act on. */
  template <int dim>
  class BoundaryPoints<dim>::Candidates
  {
  public:
    Candidates(const BackgroundGrid<dim> &grid, const PointArrays<dim> &body)
      : functions(grid.shape_functions())
      , by_nodes(body.has_stencils())
    {
      if (by_nodes)
        members = body.stencil_vertex;
      else
        members.assign(body.cell.begin(),
                       body.cell.begin() + body.n_occupied_cells);
      make_unique();
      if (Utilities::MPI::n_mpi_processes(grid.communicator()) == 1)
        return;
      std::vector<unsigned int> all;
      for (const auto &of_rank :
           Utilities::MPI::all_gather(grid.communicator(), members))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      members.swap(all);
      make_unique();
    }

    bool
    contain(const unsigned int cell) const
    {
      if (!by_nodes)
        return is_member(cell);
      const auto vertices = functions.nodes(cell);
      return std::all_of(vertices.begin(),
                         vertices.end(),
                         [this](const unsigned int v) { return is_member(v); });
    }

  private:
    bool
    is_member(const unsigned int i) const
    {
      return std::binary_search(members.begin(), members.end(), i);
    }

    void
    make_unique()
    {
      std::sort(members.begin(), members.end());
      members.erase(std::unique(members.begin(), members.end()), members.end());
    }

    const ShapeFunctions<dim> &functions;
    const bool                 by_nodes;
    /** Occupied cells or active vertices, of all ranks. */
    std::vector<unsigned int> members;
  };



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
  bool
  BoundaryPoints<dim>::are_on_domains(const PointArrays<dim> &body) const
  {
    // a rank may have no points
    return Utilities::MPI::max(body.displacement.empty() ? 0 : 1,
                               grid.communicator()) != 0;
  }



  template <int dim>
  void
  BoundaryPoints<dim>::seed(const std::vector<SurfaceRegion<dim>> &regions,
                            const std::vector<SurfaceFace<dim>>   &faces,
                            const PointArrays<dim>                &body)
  {
    this->regions = regions;
    // a rank may have no points
    on_domains = Utilities::MPI::max(body.displacement.empty() ? 0 : 1,
                                     grid.communicator()) != 0;
    records = PointRecords<dim>(n_entries);
    // one rank hands them to the others when they are located
    if (on_domains ||
        Utilities::MPI::this_mpi_process(grid.communicator()) != 0)
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
    if (on_domains)
      add_points_on_domains(body);
    else
      locate_in_cells(body);
  }



  template <int dim>
  void
  BoundaryPoints<dim>::locate_in_cells(const PointArrays<dim> &body)
  {
    const Candidates candidates(grid, body);
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      {
        for (unsigned int b = 0; b < size(); ++b)
          records.cells[b] = find_cells(b, candidates).front();
        std::size_t n_shipped;
        // in an order that does not depend on how the points came here
        records = sorted_by_id(
          exchange_points(std::move(records), grid.geometry(), n_shipped));
      }
    for (unsigned int b = 0; b < size(); ++b)
      {
        const auto cells = find_cells(b, candidates);
        records.cells[b] = cells.front();
        add_stencil(b, cells);
      }
  }



  template <int dim>
  std::vector<unsigned int>
  BoundaryPoints<dim>::find_cells(const unsigned int b,
                                  const Candidates  &candidates) const
  {
    constexpr unsigned int no_cell  = SimplexGeometry<dim>::no_cell;
    constexpr double       on_face  = 1e-7;
    constexpr double       furthest = 30; // sizes of a cell
    const auto            &geometry = grid.geometry();
    const Point<dim>      &x        = records.locations[b];
    const auto             place    = locator->locate(x, records.cells[b]);
    const unsigned int     start = place.found ? place.cell : records.cells[b];
    if (place.found && candidates.contain(start))
      {
        bool is_inside = true;
        for (unsigned int v = 0; v <= dim; ++v)
          is_inside = is_inside && (place.barycentric[v] > on_face ||
                                    geometry.neighbours(start)[v] == no_cell);
        if (is_inside)
          return {start};
      }
    const auto cells = nearest_cells<dim>(
      geometry,
      x,
      start,
      [&](const unsigned int cell) { return candidates.contain(cell); },
      std::numeric_limits<double>::max());
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
    const NodalUnknowns<dim> nodal(step, unknowns);
    for (unsigned int b = 0; b < size(); ++b)
      {
        const Tensor<1, dim> increment   = nodal.increment_at(stencil(b));
        const Tensor<2, dim> F_increment = nodal.deformation_at(stencil(b));
        // for a step on the grid as it is then; see GridReset
        if (determinant(F_increment) > 0)
          {
            const Tensor<2, dim> inverse = invert(F_increment);
            for (std::size_t i = stencil_start[b]; i < stencil_start[b + 1];
                 ++i)
              stencil_gradient[i] = stencil_gradient[i] * inverse;
          }
        const Tensor<2, dim> new_F = F_increment * F(b);
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
  Tensor<1, dim>
  BoundaryPoints<dim>::displacement(const unsigned int b) const
  {
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = records.payload(b)[displacement_entry + d];
    return u;
  }



  template <int dim>
  Tensor<1, dim>
  BoundaryPoints<dim>::reference_area(const unsigned int b) const
  {
    Tensor<1, dim> A;
    for (unsigned int d = 0; d < dim; ++d)
      A[d] = records.payload(b)[area_entry + d];
    return A;
  }



  template <int dim>
  Tensor<2, dim>
  BoundaryPoints<dim>::F(const unsigned int b) const
  {
    Tensor<2, dim> F;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = 0; e < dim; ++e)
        F[d][e] = records.payload(b)[F_entry + d * dim + e];
    return F;
  }



  template class BoundaryPoints<2>;
  template class BoundaryPoints<3>;
} // namespace isochor
