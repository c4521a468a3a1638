/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/boundary_points.h>
#include <isochor/mesh_reader.h>
#include <isochor/seeding.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** The occupied cells of all ranks, ascending. */
    std::vector<unsigned int>
    all_occupied(const std::vector<unsigned int> &mine, const MPI_Comm comm)
    {
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        return mine;
      std::vector<unsigned int> all;
      for (const auto &cells : Utilities::MPI::all_gather(comm, mine))
        all.insert(all.end(), cells.begin(), cells.end());
      std::sort(all.begin(), all.end());
      return all;
    }



    bool
    contains(const std::vector<unsigned int> &ascending,
             const unsigned int               cell)
    {
      return std::binary_search(ascending.begin(), ascending.end(), cell);
    }



    /** Places in a face and fractions of its area. */
    template <int dim>
    Quadrature<dim - 1>
    face_rule(const unsigned int n_points)
    {
      if constexpr (dim == 2)
        {
          std::vector<Point<1>> places;
          for (unsigned int i = 0; i < n_points; ++i)
            places.emplace_back((i + 0.5) / n_points);
          return Quadrature<1>(places,
                               std::vector<double>(n_points, 1. / n_points));
        }
      else
        return material_point_rule<dim - 1>(n_points);
    }



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
  {}



  template <int dim>
  void
  BoundaryPoints<dim>::seed(const PointArrays<dim>              &body,
                            const std::vector<BodySurface<dim>> &surfaces,
                            const unsigned int points_per_face,
                            const std::string &body_mesh)
  {
    const MPI_Comm            comm = grid.communicator();
    std::vector<unsigned int> n_faces;
    if (body_mesh.empty())
      n_faces = seed_faces_of(grid.geometry(),
                              all_occupied(body.cell, comm),
                              surfaces,
                              points_per_face,
                              true);
    else
      {
        Triangulation<dim> mesh;
        read_mesh<dim>(body_mesh,
                       "Boundary conditions/Mesh of body surfaces",
                       mesh);
        const SimplexGeometry<dim> geometry(mesh);
        std::vector<unsigned int>  all_cells(geometry.n_cells());
        std::iota(all_cells.begin(), all_cells.end(), 0);
        n_faces =
          seed_faces_of(geometry, all_cells, surfaces, points_per_face, false);
      }
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      AssertThrow(n_faces[s] > 0,
                  ExcMessage("The body's surface <" + surfaces[s].name +
                             "> of the parameter <Boundary conditions/Surfaces "
                             "of body> has no face. Its condition must hold at "
                             "the centres of faces of the cells that the body "
                             "fills at t = 0."));
    // one rank hands them to the others when they are located
    if (Utilities::MPI::this_mpi_process(comm) != 0)
      records = PointRecords<dim>(n_entries);
  }



  template <int dim>
  std::vector<unsigned int>
  BoundaryPoints<dim>::seed_faces_of(
    const SimplexGeometry<dim>          &geometry,
    const std::vector<unsigned int>     &occupied,
    const std::vector<BodySurface<dim>> &surfaces,
    const unsigned int                   points_per_face,
    const bool                           of_grid)
  {
    std::vector<Expression<dim>> conditions;
    for (const auto &surface : surfaces)
      conditions.emplace_back(surface.on_grid_boundary ? "0" :
                                                         surface.condition,
                              "Boundary conditions/Surfaces of body",
                              FormulaVariables::space);
    std::map<std::pair<unsigned int, unsigned int>, types::boundary_id>
      boundary_id;
    if (of_grid)
      for (const BoundaryFace &face : grid.boundary_faces())
        boundary_id[{face.cell, face.opposite_vertex}] = face.id;

    std::vector<unsigned int> n_faces(surfaces.size(), 0);
    for (const unsigned int cell : occupied)
      for (unsigned int v = 0; v <= dim; ++v)
        {
          const unsigned int behind = geometry.neighbours(cell)[v];
          if (behind != SimplexGeometry<dim>::no_cell &&
              contains(occupied, behind))
            continue;
          std::array<Point<dim>, dim> corners;
          Point<dim>                  centre;
          for (unsigned int i = 0; i < dim; ++i)
            {
              corners[i] =
                geometry
                  .vertices()[geometry.vertex_indices(cell)[i < v ? i : i + 1]];
              centre += corners[i] / static_cast<double>(dim);
            }
          // |face| = dim |cell| |∇λ_v|, and ∇λ_v points inwards
          const Tensor<1, dim> area =
            -(dim * geometry.measure(cell)) * geometry.gradients(cell)[v];
          const auto side = boundary_id.find({cell, v});
          for (unsigned int s = 0; s < surfaces.size(); ++s)
            if (surfaces[s].on_grid_boundary ?
                  (side != boundary_id.end() &&
                   side->second == surfaces[s].id) :
                  conditions[s](centre, 0.) > 0)
              {
                ++n_faces[s];
                seed_face(
                  corners, area, s, points_per_face, of_grid ? cell : 0);
              }
        }
    return n_faces;
  }



  template <int dim>
  void
  BoundaryPoints<dim>::seed_face(const std::array<Point<dim>, dim> &corners,
                                 const Tensor<1, dim>              &area,
                                 const unsigned int                 surface,
                                 const unsigned int points_per_face,
                                 const unsigned int cell)
  {
    const Quadrature<dim - 1> rule = face_rule<dim>(points_per_face);
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        Point<dim> location = corners[0];
        for (unsigned int d = 0; d + 1 < dim; ++d)
          location += rule.point(q)[d] * (corners[d + 1] - corners[0]);
        std::array<double, n_entries> payload{};
        payload[surface_entry] = surface;
        for (unsigned int d = 0; d < dim; ++d)
          {
            payload[area_entry + d]        = rule.weight(q) * area[d];
            payload[F_entry + d * dim + d] = 1.;
          }
        records.push_back(cell,
                          records.size(),
                          location,
                          ArrayView<const double>(payload.data(), n_entries));
      }
  }



  template <int dim>
  void
  BoundaryPoints<dim>::locate(const StepContext<dim> &step)
  {
    const SimplexGeometry<dim>     &geometry = grid.geometry();
    const std::vector<unsigned int> occupied =
      all_occupied({step.points.cell.begin(),
                    step.points.cell.begin() + step.points.n_occupied_cells},
                   grid.communicator());
    for (unsigned int b = 0; b < size(); ++b)
      {
        const Point<dim>  &x     = records.locations[b];
        const auto         place = locator->locate(x, records.cells[b]);
        const unsigned int cell  = place.found ? place.cell : records.cells[b];
        records.cells[b]         = place.found && contains(occupied, cell) ?
                                     cell :
                                     nearest_occupied(x, cell, occupied);
      }
    std::size_t n_shipped;
    // in an order that does not depend on how the points came here
    records = sorted_by_id(exchange_points(records, geometry, n_shipped));
    shapes.resize(size());
    for (unsigned int b = 0; b < size(); ++b)
      shapes[b] = geometry.barycentric(records.cells[b], records.locations[b]);
  }



  template <int dim>
  unsigned int
  BoundaryPoints<dim>::nearest_occupied(
    const Point<dim>                &x,
    const unsigned int               start,
    const std::vector<unsigned int> &occupied) const
  {
    // Rings of face neighbours around the start. After the first ring that
    // holds an occupied cell a few more are searched: the distance decides.
    constexpr unsigned int      max_rings = 30, more_rings = 3;
    const SimplexGeometry<dim> &geometry = grid.geometry();
    std::set<unsigned int>      seen     = {start};
    std::vector<unsigned int>   ring     = {start};
    unsigned int                best     = SimplexGeometry<dim>::no_cell;
    double       best_distance           = std::numeric_limits<double>::max();
    unsigned int last                    = max_rings;
    for (unsigned int r = 0; r <= last && !ring.empty(); ++r)
      {
        std::vector<unsigned int> next;
        for (const unsigned int cell : ring)
          {
            if (contains(occupied, cell))
              {
                const auto lambda   = geometry.barycentric(cell, x);
                double     distance = 0;
                for (unsigned int v = 0; v <= dim; ++v)
                  distance =
                    std::max(distance,
                             -lambda[v] / geometry.gradients(cell)[v].norm());
                if (best == SimplexGeometry<dim>::no_cell)
                  last = std::min(max_rings, r + more_rings);
                if (distance < best_distance ||
                    (distance == best_distance && cell < best))
                  {
                    best          = cell;
                    best_distance = distance;
                  }
              }
            for (const unsigned int other : geometry.neighbours(cell))
              if (other != SimplexGeometry<dim>::no_cell &&
                  seen.insert(other).second)
                next.push_back(other);
          }
        ring.swap(next);
      }
    std::ostringstream place;
    place << x;
    AssertThrow(best != SimplexGeometry<dim>::no_cell,
                ExcMessage(
                  "A boundary point at (" + place.str() + ") is " +
                  std::to_string(max_rings) +
                  " cells away from the body whose surface it marks."));
    return best;
  }



  template <int dim>
  void
  BoundaryPoints<dim>::advance(const StepContext<dim> &step,
                               const NodalField       &unknowns)
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    for (unsigned int b = 0; b < size(); ++b)
      {
        const unsigned int cell = records.cells[b];
        const auto        &gradients =
          step.points.gradients(geometry, step.points.position(cell));
        Tensor<1, dim> increment;
        Tensor<2, dim> F_increment = unit_symmetric_tensor<dim>();
        for (unsigned int I = 0; I <= dim; ++I)
          {
            const unsigned int entry =
              step.nodes.node(geometry.vertex_indices(cell)[I]) *
              step.n_components;
            Tensor<1, dim> nodal;
            for (unsigned int a = 0; a < dim; ++a)
              nodal[a] = unknowns.local_element(entry + a);
            increment += shapes[b][I] * nodal;
            F_increment += outer_product(nodal, gradients[I]);
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



  template <int dim>
  std::string
  BoundaryPoints<dim>::save_state() const
  {
    std::map<types::particle_index, std::string> lines;
    for (unsigned int b = 0; b < size(); ++b)
      {
        std::ostringstream line;
        line.precision(std::numeric_limits<double>::max_digits10);
        line << records.ids[b] << ' ' << records.cells[b] << ' '
             << records.locations[b];
        for (const double value : records.payload(b))
          line << ' ' << value;
        for (const double value : shapes[b])
          line << ' ' << value;
        lines[records.ids[b]] = line.str();
      }
    std::map<types::particle_index, std::string> all_lines;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), lines))
      all_lines.insert(of_rank.begin(), of_rank.end());
    std::string state = std::to_string(all_lines.size()) + '\n';
    for (const auto &line : all_lines)
      state += line.second + '\n';
    return state;
  }



  template <int dim>
  void
  BoundaryPoints<dim>::load_state(const std::string &state)
  {
    records = PointRecords<dim>(n_entries);
    shapes.clear();
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::istringstream text(state);
    std::size_t        n = 0;
    text >> n;
    for (std::size_t b = 0; b < n; ++b)
      {
        types::particle_index                      id;
        unsigned int                               cell;
        Point<dim>                                 location;
        std::array<double, n_entries>              payload;
        typename SimplexGeometry<dim>::Barycentric shape;
        text >> id >> cell;
        for (unsigned int d = 0; d < dim; ++d)
          text >> location[d];
        for (double &value : payload)
          text >> value;
        for (double &value : shape)
          text >> value;
        AssertThrow(text,
                    ExcMessage("The saved state of the boundary points is "
                               "damaged."));
        if (grid.geometry().owner(cell) != rank)
          continue;
        shapes.push_back(shape);
        records.push_back(cell,
                          id,
                          location,
                          ArrayView<const double>(payload.data(), n_entries));
      }
  }



  template class BoundaryPoints<2>;
  template class BoundaryPoints<3>;
} // namespace isochor
