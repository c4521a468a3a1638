/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/body_quadrature/interface_corners.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/place_table.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  namespace
  {
    /** Below this, a barycentric coordinate is one of a point on a face. */
    constexpr double near_face = 1e-6;

    /** The part of a cell by which a corner may have left the grid's boundary
     * inwards, with a wall that moves, and still is at it. */
    constexpr double near_wall = 0.3;

    template <int dim>
    double
    depth(const LocateResult<dim> &place)
    {
      return *std::min_element(place.barycentric.begin(),
                               place.barycentric.end());
    }

    /** Of the @p cells nearest to @p x, the one that the way from x leads into.
     * If there are several, the way leads along what they have in common, and
     * functions are continued to x alike from all of them. */
    template <int dim>
    unsigned int
    cell_ahead(const SimplexGeometry<dim>      &geometry,
               const std::vector<unsigned int> &cells,
               const Point<dim>                &x)
    {
      constexpr double on_face = 1e-9, same = 1e-6;
      unsigned int     ahead = cells.front();
      double           most  = std::numeric_limits<double>::lowest();
      for (const unsigned int cell : cells)
        {
          const Tensor<1, dim> way = way_to_cell(geometry, cell, x);
          if (way.norm() < near_face * cell_size(geometry, cell)) // inside
            return cell;
          const auto at_foot = geometry.barycentric(cell, x + way);
          double     into = std::numeric_limits<double>::max(), size = 0;
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const double change = way * geometry.gradients(cell)[v];
              size                = std::max(size, std::abs(change));
              if (at_foot[v] < on_face)
                into = std::min(into, change);
            }
          into /= size;
          if (into > most + same)
            {
              most  = into;
              ahead = cell;
            }
        }
      return ahead;
    }

    /** Faces of the grid's boundary at a corner of a domain. */
    template <int dim>
    struct WallsAt
    {
      std::vector<Tensor<1, dim>> normals;
      Point<dim>                  place; ///< the corner's, moved onto them
    };

    /** Those that @p x in @p cell lies on, or beside by a part of a cell: a
     * wall moves with the body, and a grid that is put back does not. */
    template <int dim>
    WallsAt<dim>
    walls_at(const CellOccupancy<dim> &occupancy,
             const unsigned int        cell,
             const Point<dim>         &x)
    {
      const SimplexGeometry<dim> &geometry = occupancy.grid.geometry();
      WallsAt<dim>                walls;
      walls.place = x;
      for (const unsigned int v : geometry.vertex_indices(cell))
        for (const unsigned int other : occupancy.cells_at(v))
          for (unsigned int f = 0; f <= dim; ++f)
            if (geometry.neighbours(other)[f] == SimplexGeometry<dim>::no_cell)
              {
                const Tensor<1, dim> g      = geometry.gradients(other)[f];
                const auto           lambda = geometry.barycentric(other, x);
                if (std::abs(lambda[f]) > near_wall)
                  continue;
                const auto on_face =
                  geometry.barycentric(other,
                                       x - lambda[f] / g.norm_square() * g);
                if (*std::min_element(on_face.begin(), on_face.end()) <
                    -near_face)
                  continue;
                walls.normals.push_back(g / g.norm());
                walls.place -= geometry.barycentric(other, walls.place)[f] /
                               g.norm_square() * g;
              }
      return walls;
    }

    /** Whether the functions of @p cell, continued to the @p walls, are there
     * those of nodes on these: what holds the nodes has to hold the corner. */
    template <int dim>
    bool
    stays_on_walls(const SimplexGeometry<dim> &geometry,
                   const unsigned int          cell,
                   const WallsAt<dim>         &walls)
    {
      if (walls.normals.empty())
        return true;
      const auto   lambda = geometry.barycentric(cell, walls.place);
      const double size   = cell_size(geometry, cell);
      for (unsigned int v = 0; v <= dim; ++v)
        if (std::abs(lambda[v]) > near_face)
          for (const Tensor<1, dim> &n : walls.normals)
            if (std::abs(
                  n * (geometry.vertices()[geometry.vertex_indices(cell)[v]] -
                       walls.place)) > near_face * size)
              return false;
      return true;
    }
  } // namespace



  template <int dim>
  InterfaceCorners<dim>::InterfaceCorners(const PointArrays<dim>   &points,
                                          const PointLocator<dim>  &locator,
                                          const CellOccupancy<dim> &occupancy,
                                          const MixedKernel<dim>   &kernel)
    : locator(locator)
    , occupancy(occupancy)
    , materials(kernel, nearly_alike)
  {
    if (!is_needed())
      return;
    locate_corners(points);
    collect_contents(points);
    add_overlaps(points);
    exchange_contents();
    find_own_functions();
    exchange_contents();
    find_thin_layers();
    exchange_contents();
    give_pressures_to_thin_layers();
    exchange_contents();
    find_cells_that_keep_nodes();
    exchange_contents();
    give_cells_to_stiffest();
    exchange_contents();
    take_nodes_of_stiffest();
    exchange_contents();
    find_owners(points);
    find_layers_of_one_domain(points);
    // In dynamics not: pressures that are continued over two cells leave
    // changes of volume along the interface to the points, and each time the
    // grid is put back these would make energy.
    const bool separates = kernel.has_pressures && points.velocity.empty();
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        find_cell(i);
        if (separates)
          find_pressure_cell(i);
      }
  }



  template <int dim>
  void
  InterfaceCorners<dim>::locate_corners(const PointArrays<dim> &points)
  {
    corners.reserve(points.domain.size() * (dim + 1));
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const Point<dim> x = points.location(locator.geometry(), k, q);
          for (const Tensor<1, dim> &of_start : points.domain[q])
            {
              Tensor<1, dim> r = points.F[q] * of_start;
              Corner         corner;
              corner.place = locator.locate_nearest(x, points.cell[k], r);
              corner.x     = x + r;
              corner.X     = x - points.displacement[q] + of_start;
              corner.group = materials.of_material[points.material[q]];
              corner.owner = corner.group;
              corners.push_back(corner);
            }
        }
  }



  template <int dim>
  void
  InterfaceCorners<dim>::find_owners(const PointArrays<dim> &points)
  {
    // those of all but the softest in cells that aren't of theirs only
    using Entry = std::array<double, dim + 1>; // X and the group
    std::vector<Entry>                         foreign;
    std::map<unsigned int, std::vector<Entry>> sent;
    for (const Corner &corner : corners)
      if (corner.group > 0 && content(corner.place.cell).meets_others)
        {
          Entry entry;
          for (unsigned int d = 0; d < dim; ++d)
            entry[d] = corner.X[d];
          entry[dim] = corner.group;
          foreign.push_back(entry);
          for (const unsigned int rank :
               occupancy.ranks_near_cell(corner.place.cell))
            sent[rank].push_back(entry);
        }
    const MPI_Comm comm = locator.geometry().communicator();
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      for (const auto &received : Utilities::MPI::some_to_some(comm, sent))
        foreign.insert(foreign.end(),
                       received.second.begin(),
                       received.second.end());

    if (foreign.empty() || corners.empty())
      return;
    double length = std::numeric_limits<double>::max();
    for (const auto &domain : points.domain)
      for (unsigned int c = 1; c <= dim; ++c)
        length = std::min(length, (domain[c] - domain[0]).norm());
    // the same place but for rounding
    PlaceTable<dim>           table({corners.front().X, 1e-4 * length});
    std::vector<unsigned int> groups;
    for (const Entry &entry : foreign)
      {
        Point<dim> X;
        for (unsigned int d = 0; d < dim; ++d)
          X[d] = entry[d];
        const unsigned int number = table.find_or_add(X);
        groups.resize(table.size(), 0);
        groups[number] =
          std::max(groups[number], static_cast<unsigned int>(entry[dim]));
      }
    for (Corner &corner : corners)
      if (const unsigned int number = table.find(corner.X);
          number != PlaceTable<dim>::none)
        corner.owner = std::max(corner.owner, groups[number]);
  }



  template <int dim>
  void
  InterfaceCorners<dim>::find_layers_of_one_domain(
    const PointArrays<dim> &points)
  {
    // by group: the volume of its points, and that of those without a corner
    std::vector<double> volumes(2 * materials.size());
    const auto          has_corner = [&](const unsigned int q) {
      const auto first = corners.begin() + q * (dim + 1);
      return std::any_of(first, first + dim + 1, [](const Corner &corner) {
        return corner.owner == corner.group;
      });
    };
    // one that is a cell has nodes that strain nothing else
    const auto is_cell = [&](const unsigned int k) {
      return points.cell_start[k + 1] - points.cell_start[k] == 1;
    };
    const auto for_each_point = [&](const auto &action) {
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          action(k, q, materials.of_material[points.material[q]]);
    };
    for_each_point([&](const unsigned int k,
                       const unsigned int q,
                       const unsigned int group) {
      volumes[2 * group] += points.volume[q];
      if (!has_corner(q) && !is_cell(k))
        volumes[2 * group + 1] += points.volume[q];
    });
    Utilities::MPI::sum(volumes, locator.geometry().communicator(), volumes);
    // where layers meet with steps some domains have none
    constexpr double most = 0.5;
    for_each_point([&](const unsigned int k,
                       const unsigned int q,
                       const unsigned int group) {
      if (volumes[2 * group + 1] < most * volumes[2 * group] || has_corner(q) ||
          is_cell(k))
        return;
      const double size = std::pow(determinant(points.F[q]) * points.volume[q] /
                                     locator.geometry().measure(points.cell[k]),
                                   1. / dim);
      const InterfaceCrossing crossing = {
        size, materials.ratio(group, corners[q * (dim + 1)].owner)};
      if (crossing.weight() > worst.weight())
        worst = crossing;
    });
  }



  template <int dim>
  void
  InterfaceCorners<dim>::find_cell(const unsigned int i)
  {
    const SimplexGeometry<dim> &geometry = locator.geometry();
    const Corner               &corner   = corners[i];
    if (is_own(corner.place.cell, corner.owner) ||
        !content(corner.place.cell).meets_others)
      return;
    Groups here = content(corner.place.cell).groups;
    if (depth<dim>(corner.place) < near_face)
      for (const unsigned int cell : nearest_cells<dim>(
             geometry,
             corner.x,
             corner.place.cell,
             [](const unsigned int) { return true; },
             std::numeric_limits<double>::max()))
        {
          if (is_own(cell, corner.owner))
            return;
          here |= content(cell).groups;
        }
    const WallsAt<dim> walls =
      walls_at<dim>(occupancy, corner.place.cell, corner.x);
    const auto on_walls = [&](const unsigned int cell) {
      return stays_on_walls(geometry, cell, walls);
    };
    const auto is_own_here = [&](const unsigned int cell) {
      return is_own(cell, corner.owner) && on_walls(cell);
    };
    const auto holds_one = [&](const unsigned int cell) {
      return content(cell).groups == Groups(1) << corner.owner;
    };
    unsigned int other =
      nearest(corner.x, corner.place.cell, is_own_here, reach);
    // of others that have given their nodes to the stiffest
    if (other == no_cell &&
        nearest(corner.x, corner.place.cell, holds_one, reach) != no_cell)
      other =
        nearest(corner.x, corner.place.cell, is_own_here, reach_without_nodes);
    // beside walls that no such cell has, as curved ones
    if (other == no_cell &&
        walls.place.distance(corner.x) >
          near_face * cell_size(geometry, corner.place.cell))
      other = nearest(
        corner.x,
        corner.place.cell,
        [&](const unsigned int cell) { return is_own(cell, corner.owner); },
        reach);
    if (other == no_cell) // of a thin layer
      {
        remember(corner, here);
        other = nearest(
          corner.x,
          corner.place.cell,
          [&](const unsigned int cell) {
            const Content there = content(cell);
            return ((there.groups >> corner.owner) & 1) != 0 &&
                   there.most == corner.owner && on_walls(cell);
          },
          reach);
      }
    if (other != no_cell)
      others[i] = other;
  }



  template <int dim>
  unsigned int
  InterfaceCorners<dim>::nearest(
    const Point<dim>                              &x,
    const unsigned int                             start,
    const std::function<bool(const unsigned int)> &is_candidate,
    const double                                   reach) const
  {
    const SimplexGeometry<dim>     &geometry = locator.geometry();
    const std::vector<unsigned int> cells    = nearest_cells<dim>(
      geometry, x, start, is_candidate, reach * cell_size(geometry, start));
    return cells.empty() ? no_cell : cell_ahead(geometry, cells, x);
  }



  template <int dim>
  void
  InterfaceCorners<dim>::find_pressure_cell(const unsigned int i)
  {
    const Corner      &corner = corners[i];
    const unsigned int cell   = corner.place.cell;
    if (has_pressures_of(cell, corner.group))
      {
        // displacements of the stiffest, pressures of its own
        if (others.count(i) > 0)
          others_of_pressure[i] = cell;
        return;
      }
    if (!content(cell).meets_others)
      return;
    unsigned int other = nearest(
      corner.x,
      cell,
      [&](const unsigned int candidate) {
        return has_pressures_of(candidate, corner.group);
      },
      reach_without_nodes);
    if (other == no_cell)
      other = nearest(
        corner.x,
        cell,
        [&](const unsigned int candidate) {
          return content(candidate).groups == Groups(1) << corner.group;
        },
        reach);
    if (other != no_cell)
      others_of_pressure[i] = other;
  }



  template <int dim>
  void
  InterfaceCorners<dim>::remember(const Corner &corner, const Groups groups)
  {
    for (unsigned int g = 0; g < materials.size(); ++g)
      if ((groups >> g) & 1)
        {
          const InterfaceCrossing crossing = {depth<dim>(corner.place),
                                              materials.ratio(g, corner.owner)};
          if (crossing.weight() > worst.weight())
            worst = crossing;
        }
  }



  template class InterfaceCorners<2>;
  template class InterfaceCorners<3>;
} // namespace isochor
