/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/equations/connected_parts.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/transfer/approach_watch.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Where point @p q of cell k was when the grid was put back. */
    template <int dim>
    Point<dim>
    place_at_reset(const StepContext<dim> &step,
                   const unsigned int      k,
                   const unsigned int      q)
    {
      const SimplexGeometry<dim> &geometry = step.grid.geometry();
      const auto &vertices = geometry.vertex_indices(step.points.cell[k]);
      Point<dim>  x;
      for (unsigned int v = 0; v <= dim; ++v)
        x += step.points.shape[q][v] * geometry.vertices()[vertices[v]];
      return x;
    }



    template <int dim>
    std::string
    near(const Point<dim> &x)
    {
      std::ostringstream text;
      text << " near (" << x << ')';
      return text.str();
    }



    /** The @p pairs of all ranks. */
    std::set<VertexOfPart>
    of_all_ranks(const MPI_Comm comm, const std::set<VertexOfPart> &pairs)
    {
      std::vector<unsigned int> values;
      for (const VertexOfPart &pair : pairs)
        values.insert(values.end(), {pair.first, pair.second});
      std::set<VertexOfPart> all;
      for (const auto &of_rank : Utilities::MPI::all_gather(comm, values))
        for (std::size_t i = 0; i < of_rank.size(); i += 2)
          all.emplace(of_rank[i], of_rank[i + 1]);
      return all;
    }



    /** For each of the @p cells, the same ones on all ranks, whether a rank has
     * points in it. */
    template <int dim>
    std::vector<int>
    are_filled(const StepContext<dim>          &step,
               const std::vector<unsigned int> &cells)
    {
      std::vector<int> is_filled;
      for (const unsigned int cell : cells)
        is_filled.push_back(step.points.contains_cell(cell) ? 1 : 0);
      Utilities::MPI::max(is_filled, step.grid.communicator(), is_filled);
      return is_filled;
    }



    /** The empty cells that share a face with a cell of the body, sorted. Where
     * only the parts of the body end that ranks have is no surface. */
    template <int dim>
    std::vector<unsigned int>
    empty_neighbours(const StepContext<dim> &step)
    {
      const PointArrays<dim>     &points   = step.points;
      const SimplexGeometry<dim> &geometry = step.grid.geometry();
      std::set<unsigned int>      not_here, of_all;
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        for (const unsigned int n : geometry.neighbours(points.cell[k]))
          if (n != SimplexGeometry<dim>::no_cell && !points.contains_cell(n))
            not_here.insert(n);
      for (const auto &of_rank :
           all_gather_arrays(step.grid.communicator(),
                             std::vector<unsigned int>(not_here.begin(),
                                                       not_here.end())))
        of_all.insert(of_rank.begin(), of_rank.end());

      std::vector<unsigned int> cells(of_all.begin(), of_all.end()), empty;
      const std::vector<int>    is_filled = are_filled(step, cells);
      for (unsigned int i = 0; i < cells.size(); ++i)
        if (is_filled[i] == 0)
          empty.push_back(cells[i]);
      return empty;
    }



  } // namespace



  template <int dim>
  void
  ApproachWatch<dim>::Mark::add(const Mark &other)
  {
    least_part   = std::min(least_part, other.least_part);
    largest_part = std::max(largest_part, other.largest_part);
    cell_size    = std::max(cell_size, other.cell_size);
    // of equals that which comes first, whatever rank it is on
    const auto is_further = [](const unsigned int d,
                               const double       sign,
                               const Point<dim>  &a,
                               const Point<dim>  &b) {
      if (a[d] != b[d])
        return sign * a[d] > sign * b[d];
      for (unsigned int e = 0; e < dim; ++e)
        if (a[e] != b[e])
          return a[e] < b[e];
      return false;
    };
    for (unsigned int i = 0; i < 2 * dim; ++i)
      if (is_further(i / 2,
                     i % 2 == 0 ? -1. : 1.,
                     other.furthest[i].from,
                     furthest[i].from))
        furthest[i] = other.furthest[i];
  }



  template <int dim>
  void
  ApproachWatch<dim>::find_surface(const StepContext<dim> &step,
                                   const ElementNodes     &elements)
  {
    const PointArrays<dim>         &points   = step.points;
    const SimplexGeometry<dim>     &geometry = step.grid.geometry();
    const std::vector<unsigned int> name     = part_names(step, elements);
    const std::vector<unsigned int> empty    = empty_neighbours(step);
    at_surface.assign(points.n_occupied_cells, 0);
    part.assign(points.n_occupied_cells, 0);
    hint.assign(points.n_points(), 0);
    boundary.find_normals(geometry);
    touched.clear();
    has_face.assign(points.n_occupied_cells, 0);
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        const unsigned int c              = points.cell[k];
        const auto        &neighbours     = geometry.neighbours(c);
        bool               is_at_boundary = false;
        for (unsigned int f = 0; f <= dim; ++f)
          if (neighbours[f] == SimplexGeometry<dim>::no_cell)
            is_at_boundary = true;
          else if (std::binary_search(empty.begin(),
                                      empty.end(),
                                      neighbours[f]))
            at_surface[k] = 1;
        has_face[k] = is_at_boundary;
        part[k]     = name[step.nodes.node(
          points.stencil(geometry, k, points.cell_start[k]).vertex[0])];
        for (unsigned int f = 0; is_at_boundary && f <= dim; ++f)
          if (neighbours[f] == SimplexGeometry<dim>::no_cell)
            for (unsigned int v = 0; v <= dim; ++v)
              if (v != f)
                touched.emplace(geometry.vertex_indices(c)[v], part[k]);
        std::fill(hint.begin() + points.cell_start[k],
                  hint.begin() + points.cell_start[k + 1],
                  c);
      }
    touched = of_all_ranks(step.grid.communicator(), touched);
    at_boundary.assign(points.n_occupied_cells, 0);
    boundary_normals.clear();
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (const unsigned int v : geometry.vertex_indices(points.cell[k]))
        if (touched.count({v, part[k]}) > 0)
          {
            boundary_normals.push_back(boundary.touched_normals(
              geometry, touched, points.cell[k], part[k]));
            at_boundary[k] = boundary_normals.size();
            break;
          }
    attached.clear();
    for (const VertexOfPart &one : touched)
      attached.insert(one.second);
    n_parts    = number_of_parts(step, elements);
    is_started = true;
  }



  template <int dim>
  typename ApproachWatch<dim>::Approach
  ApproachWatch<dim>::look(const StepContext<dim>  &step,
                           const ElementNodes      &elements,
                           const PointLocator<dim> &locator,
                           const NodalField        &unknowns,
                           MaterialPoints<dim>     &points)
  {
    place.clear();
    n_apart = 0;
    if (!is_started)
      {
        const unsigned int n_before = n_parts;
        find_surface(step, elements);
        if (n_parts < n_before)
          {
            n_apart = n_before;
            return Approach::of_bodies;
          }
      }
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    const NodalUnknowns<dim>    nodal(step, unknowns);
    Marks                       marks;
    std::set<VertexOfPart>      near_boundary, covered;
    // parts, with 0: where cells with a face at the boundary leave the grid,
    // they take the boundary along, and others of their part follow
    std::set<VertexOfPart> leaving, along;
    bool                   is_gone = false;
    points.for_each([&](const unsigned int k,
                        const unsigned int q,
                        Point<dim>        &location,
                        const ArrayView<double> & /*properties*/) {
      if (at_surface[k] == 0 && at_boundary[k] == 0)
        return;
      const LocateResult<dim> found = locator.locate(location, hint[q]);
      if (!found.found)
        {
          is_gone = is_gone || attached.count(part[k]) == 0;
          if (has_face[k] == 1)
            along.emplace(0, part[k]);
          // others of its part come to the boundary that it has been at
          if (at_boundary[k] != 0)
            boundary.find_own(geometry,
                              step.points.cell[k],
                              boundary_normals[at_boundary[k] - 1],
                              part[k],
                              covered);
          return;
        }
      hint[q]              = found.cell;
      const auto &vertices = geometry.vertex_indices(found.cell);
      std::vector<Tensor<1, dim>> none;
      auto                       &own =
        at_boundary[k] == 0 ? none : boundary_normals[at_boundary[k] - 1];
      boundary.follow(geometry, found.cell, own);
      // another step like this one may go through a cell at the boundary
      const Tensor<1, dim> increment =
        nodal.increment_at(step.points.stencil(geometry, k, q));
      Tensor<1, dim> way   = increment;
      const auto     ahead = locator.locate_towards(location, found.cell, way);
      if (way != increment && boundary.is_at(geometry, ahead))
        (has_face[k] == 1 ? along : leaving).emplace(0, part[k]);
      for (const unsigned int cell : {found.cell, ahead.cell})
        {
          boundary.find_own(geometry, cell, own, part[k], covered);
          if (at_surface[k] == 1)
            boundary.find_others(geometry, cell, own, part[k], near_boundary);
        }
      if (at_surface[k] == 0)
        return;
      Mark mark{part[k], part[k], cell_size(geometry, found.cell), {}};
      mark.furthest.fill({place_at_reset(step, k, q), location});
      for (const unsigned int vertex : vertices)
        {
          const auto inserted = marks.emplace(vertex, mark);
          if (!inserted.second)
            inserted.first->second.add(mark);
        }
    });

    const MPI_Comm comm = step.grid.communicator();
    share(comm, marks);
    for (const auto &[vertex, mark] : marks)
      if (mark.least_part != mark.largest_part)
        {
          place   = near(geometry.vertices()[vertex]);
          n_apart = n_parts;
          return Approach::of_bodies;
        }
    if (any_gap(step, locator, marks))
      return Approach::of_bodies;
    if (step.grid.is_moving())
      return Approach::none;
    bool is_new = !boundary.is_empty() && is_gone;
    covered     = of_all_ranks(comm, covered);
    along       = of_all_ranks(comm, along);
    for (const VertexOfPart &one : leaving)
      is_new = is_new || along.count(one) == 0;
    for (const VertexOfPart &one : near_boundary)
      is_new = is_new || covered.count(one) == 0;
    return Utilities::MPI::max(is_new ? 1 : 0, comm) == 1 ?
             Approach::to_boundary :
             Approach::none;
  }



  template <int dim>
  void
  ApproachWatch<dim>::share(const MPI_Comm comm, Marks &marks)
  {
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    std::vector<double> values;
    for (const auto &[vertex, mark] : marks)
      {
        values.insert(values.end(),
                      {double(vertex),
                       double(mark.least_part),
                       double(mark.largest_part),
                       mark.cell_size});
        for (const typename Mark::Way &way : mark.furthest)
          for (const Point<dim> &x : {way.from, way.to})
            for (unsigned int d = 0; d < dim; ++d)
              values.push_back(x[d]);
      }
    marks.clear();
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, values))
      for (auto v = of_rank.begin(); v != of_rank.end();)
        {
          const unsigned int vertex = *v++;
          Mark               mark;
          mark.least_part   = *v++;
          mark.largest_part = *v++;
          mark.cell_size    = *v++;
          for (typename Mark::Way &way : mark.furthest)
            for (Point<dim> *x : {&way.from, &way.to})
              for (unsigned int d = 0; d < dim; ++d)
                (*x)[d] = *v++;
          const auto inserted = marks.emplace(vertex, mark);
          if (!inserted.second)
            inserted.first->second.add(mark);
        }
  }



  template <int dim>
  bool
  ApproachWatch<dim>::any_gap(const StepContext<dim>  &step,
                              const PointLocator<dim> &locator,
                              const Marks             &marks)
  {
    // nearer to each other there is hardly an empty cell between
    constexpr double far = 2, spacing = 0.5; // cell sizes
    constexpr double nearer = 0.5;           // of what it was
    // all ranks have the same marks
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    std::vector<unsigned int>   cells, at_vertex;
    for (const auto &[vertex, mark] : marks)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto &first        = mark.furthest[2 * d],
                     &last         = mark.furthest[2 * d + 1];
          const Tensor<1, dim> way = last.from - first.from;
          if (way[d] < far * mark.cell_size ||
              (last.to - first.to).norm() > nearer * way.norm())
            continue;
          const unsigned int n     = way.norm() / (spacing * mark.cell_size);
          const unsigned int layer = step.grid.layer_of_vertex(vertex);
          for (unsigned int i = 1; i < n; ++i)
            {
              const unsigned int hint =
                !cells.empty() &&
                    geometry.layer_of_cell(cells.back()) == layer ?
                  cells.back() :
                layer == 0 ? SimplexGeometry<dim>::no_cell :
                             geometry.first_cell(layer);
              const LocateResult<dim> found =
                locator.locate(first.from + double(i) / n * way, hint);
              if (!found.found)
                continue;
              cells.push_back(found.cell);
              at_vertex.push_back(vertex);
            }
        }
    if (cells.empty())
      return false;
    const std::vector<int> is_filled = are_filled(step, cells);
    const auto gap = std::find(is_filled.begin(), is_filled.end(), 0);
    if (gap == is_filled.end())
      return false;
    place =
      near(step.grid.geometry().vertices()[at_vertex[gap - is_filled.begin()]]);
    return true;
  }



  template class ApproachWatch<2>;
  template class ApproachWatch<3>;
} // namespace isochor
