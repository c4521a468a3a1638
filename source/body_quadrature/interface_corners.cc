/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/body_quadrature/interface_corners.h>
#include <isochor/body_quadrature/walls_at_place.h>
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
    using Entry = std::array<double, dim + 2>; // X, the group, the layer
    std::vector<Entry>                         foreign;
    std::map<unsigned int, std::vector<Entry>> sent;
    for (const Corner &corner : corners)
      if (corner.group > 0 && content(corner.place.cell).meets_others)
        {
          Entry entry;
          for (unsigned int d = 0; d < dim; ++d)
            entry[d] = corner.X[d];
          entry[dim]     = corner.group;
          entry[dim + 1] = locator.geometry().layer_of_cell(corner.place.cell);
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
    const unsigned int        n_layers = locator.geometry().n_layers();
    std::vector<unsigned int> groups; // by place and layer
    for (const Entry &entry : foreign)
      {
        Point<dim> X;
        for (unsigned int d = 0; d < dim; ++d)
          X[d] = entry[d];
        const unsigned int number = table.find_or_add(X) * n_layers +
                                    static_cast<unsigned int>(entry[dim + 1]);
        groups.resize(table.size() * n_layers, 0);
        groups[number] =
          std::max(groups[number], static_cast<unsigned int>(entry[dim]));
      }
    for (Corner &corner : corners)
      if (const unsigned int number = table.find(corner.X);
          number != PlaceTable<dim>::none)
        corner.owner =
          std::max(corner.owner,
                   groups[number * n_layers +
                          locator.geometry().layer_of_cell(corner.place.cell)]);
  }



  template <int dim>
  void
  InterfaceCorners<dim>::find_layers_of_one_domain(
    const PointArrays<dim> &points)
  {
    const auto has_corner = [&](const unsigned int q) {
      const auto first = corners.begin() + q * (dim + 1);
      return std::any_of(first, first + dim + 1, [](const Corner &corner) {
        return corner.owner == corner.group;
      });
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
      // one that is a cell has nodes that strain nothing else
      if (points.cell_start[k + 1] - points.cell_start[k] == 1 || has_corner(q))
        contents[element(points.cell[k])].moving |= Groups(1) << group;
    });
    exchange_contents();
    const auto is_alone = [&](const unsigned int k, const unsigned int group) {
      for (const unsigned int v :
           locator.geometry().vertex_indices(points.cell[k]))
        for (const unsigned int cell : occupancy.cells_at(v))
          if ((content(cell).moving >> group) & 1)
            return false;
      return true;
    };
    // the volume of the body, and by group that of its points and of such ones
    std::vector<double> volumes(1 + 2 * materials.size());
    std::vector<std::pair<unsigned int, unsigned int>> alone; // cells, points
    for_each_point([&](const unsigned int k,
                       const unsigned int q,
                       const unsigned int group) {
      volumes[0] += points.volume[q];
      volumes[1 + 2 * group] += points.volume[q];
      if (!is_alone(k, group))
        return;
      volumes[2 + 2 * group] += points.volume[q];
      alone.emplace_back(k, q);
    });
    Utilities::MPI::sum(volumes, locator.geometry().communicator(), volumes);
    constexpr double of_body = 0.01, of_group = 0.5;
    for (const auto &[k, q] : alone)
      {
        const unsigned int group = corners[q * (dim + 1)].group;
        if (volumes[2 + 2 * group] < of_body * volumes[0] &&
            volumes[2 + 2 * group] < of_group * volumes[1 + 2 * group])
          continue;
        const double size =
          std::pow(determinant(points.F[q]) * points.volume[q] /
                     locator.geometry().measure(points.cell[k]),
                   1. / dim);
        const InterfaceCrossing crossing = {
          size, materials.ratio(group, corners[q * (dim + 1)].owner)};
        if (crossing.weight() > worst.weight())
          worst = crossing;
      }
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
    const WallsAtPlace<dim> walls(occupancy, corner.place.cell, corner.x);
    const auto              on_walls = [&](const unsigned int cell) {
      return walls.are_those_of(cell);
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
    // of a layer of a cell at the body's surface, hardly filled
    if (other == no_cell)
      other = nearest(
        corner.x,
        corner.place.cell,
        [&](const unsigned int cell) {
          return holds_one(cell) && on_walls(cell);
        },
        reach);
    if (other == no_cell) // of a thin layer
      {
        other = nearest(
          corner.x,
          corner.place.cell,
          [&](const unsigned int cell) {
            const Content there = content(cell);
            return ((there.groups >> corner.owner) & 1) != 0 &&
                   there.most == corner.owner && on_walls(cell);
          },
          reach);
        // beside walls that no cell has, as curved ones
        if (other == no_cell &&
            walls.distance() >
              near_face * cell_size(geometry, corner.place.cell))
          other = nearest(
            corner.x,
            corner.place.cell,
            [&](const unsigned int cell) { return is_own(cell, corner.owner); },
            reach);
        else
          remember(corner, here);
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
