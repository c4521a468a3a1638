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
  BoundaryPoints<dim>::BoundaryPoints(const BackgroundGrid<dim> &grid)
    : grid(grid)
    , locator(std::make_unique<PointLocator<dim>>(grid.geometry()))
    , records(n_entries)
  {
    clear_stencils();
  }



  template <int dim>
  void
  BoundaryPoints<dim>::seed(const std::vector<SurfacePoint<dim>> &seeds)
  {
    records = PointRecords<dim>(n_entries);
    // one rank hands them to the others when they are located
    if (Utilities::MPI::this_mpi_process(grid.communicator()) != 0)
      return;
    for (const SurfacePoint<dim> &point : seeds)
      {
        std::array<double, n_entries> payload{};
        payload[surface_entry] = point.surface;
        for (unsigned int d = 0; d < dim; ++d)
          {
            payload[area_entry + d]        = point.area[d];
            payload[F_entry + d * dim + d] = 1.;
          }
        records.push_back(point.cell,
                          records.size(),
                          point.location,
                          ArrayView<const double>(payload.data(), n_entries));
      }
  }



  template <int dim>
  void
  BoundaryPoints<dim>::change_grid()
  {
    for (unsigned int &cell : records.cells)
      cell = grid.cells_after_change()[cell];
    // parts may still be too large
    constexpr unsigned int most_rounds = 12;
    for (unsigned int round = 0; round < most_rounds; ++round)
      if (Utilities::MPI::sum(split(), grid.communicator()) == 0)
        return;
  }



  template <int dim>
  unsigned int
  BoundaryPoints<dim>::split()
  {
    // as many as three points on the side of a cell
    constexpr double          share = 0.5;
    constexpr unsigned int    n_new = (1u << (dim - 1)) - 1;
    std::vector<unsigned int> too_large;
    std::vector<std::array<Tensor<1, dim>, dim - 1>> sides; // now
    for (unsigned int b = 0; b < size(); ++b)
      {
        // two or one tangents of the undeformed surface, as long as its part
        std::array<Tensor<1, dim>, dim - 1> tangents;
        const Tensor<1, dim>                A = reference_area(b);
        if constexpr (dim == 2)
          tangents[0] = cross_product_2d(A);
        else
          {
            Tensor<1, 3> axis; // the one that is least along the normal
            unsigned int d = 0;
            for (unsigned int e = 1; e < 3; ++e)
              if (std::abs(A[e]) < std::abs(A[d]))
                d = e;
            axis[d]     = 1;
            tangents[0] = cross_product_3d(A, axis);
            tangents[0] *= std::sqrt(A.norm()) / tangents[0].norm();
            tangents[1] = cross_product_3d(A, tangents[0]) / A.norm();
          }
        double longest = 0;
        for (Tensor<1, dim> &side : tangents)
          {
            side    = F(b) * side;
            longest = std::max(longest, side.norm());
          }
        const auto place =
          locator->locate(records.locations[b], records.cells[b]);
        const double h = cell_size(grid.geometry(),
                                   place.found ? place.cell : records.cells[b]);
        if (longest > share * h)
          {
            too_large.push_back(b);
            sides.push_back(tangents);
          }
      }

    const auto first_and_sum =
      exclusive_and_total_sum(too_large.size(), grid.communicator());
    types::particle_index next =
      records.ids.empty() ?
        0 :
        *std::max_element(records.ids.begin(), records.ids.end()) + 1;
    next = Utilities::MPI::max(next, grid.communicator()) +
           n_new * first_and_sum.first;
    for (unsigned int i = 0; i < too_large.size(); ++i)
      {
        const unsigned int            b       = too_large[i];
        const Tensor<2, dim>          inverse = invert(F(b));
        const Point<dim>              x       = records.locations[b];
        std::array<double, n_entries> old;
        std::copy_n(records.payload(b).begin(), n_entries, old.begin());
        for (unsigned int part = 0; part <= n_new; ++part)
          {
            Tensor<1, dim> shift;
            for (unsigned int s = 0; s + 1 < dim; ++s)
              shift += (((part >> s) & 1u) ? 0.25 : -0.25) * sides[i][s];
            const Tensor<1, dim> stretch = shift - inverse * shift;
            auto                 payload = old;
            for (unsigned int d = 0; d < dim; ++d)
              {
                payload[area_entry + d] /= n_new + 1;
                payload[displacement_entry + d] += stretch[d];
              }
            if (part == 0)
              {
                records.locations[b] = x + shift;
                std::copy(payload.begin(),
                          payload.end(),
                          records.payloads.begin() + b * n_entries);
              }
            else
              records.push_back(records.cells[b],
                                next++,
                                x + shift,
                                ArrayView<const double>(payload.data(),
                                                        n_entries));
          }
      }
    return too_large.size();
  }



  template <int dim>
  void
  BoundaryPoints<dim>::locate(const PointArrays<dim> &body)
  {
    const Candidates candidates(grid, body);
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      {
        for (unsigned int b = 0; b < size(); ++b)
          records.cells[b] = find_cells(b, candidates).front();
        std::size_t n_shipped;
        // in an order that does not depend on how the points came here
        records =
          sorted_by_id(exchange_points(records, grid.geometry(), n_shipped));
      }
    clear_stencils();
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
    cell_sizes.clear();
  }



  template <int dim>
  void
  BoundaryPoints<dim>::add_stencil(const unsigned int               b,
                                   const std::vector<unsigned int> &cells)
  {
    const SimplexGeometry<dim>          &geometry = grid.geometry();
    const std::size_t                    begin    = stencil_start.back();
    double                               size     = 0;
    typename ShapeFunctions<dim>::Values at;
    for (const unsigned int cell : cells)
      {
        grid.shape_functions().evaluate(
          cell, geometry.barycentric(cell, records.locations[b]), at);
        size += cell_size(geometry, cell) / cells.size();
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
    cell_sizes.push_back(size);
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
