/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_seeded_cells_h
#define isochor_seeded_cells_h

#include <isochor/base/rounding.h>
#include <isochor/grid/mesh_reader.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/body_seeding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace isochor
{
  template <int dim>
  std::array<Point<dim>, dim + 1>
  corners_of(const SimplexGeometry<dim> &geometry, const unsigned int cell)
  {
    std::array<Point<dim>, dim + 1> corners;
    for (unsigned int v = 0; v <= dim; ++v)
      corners[v] = geometry.vertices()[geometry.vertex_indices(cell)[v]];
    return corners;
  }

  /** The @p i th of places spread evenly over cells, in that with the @p
   * corners. If each cell is looked at in n of them, they are those from n
   * times its number on: a part of the cell that is the same in each would miss
   * a slit along the cells. */
  template <int dim>
  Point<dim>
  spread_place(const std::array<Point<dim>, dim + 1> &corners,
               const std::size_t                      i)
  {
    // the sequence of Kronecker with the root of x^(dim+1) = x + 1; cuts of
    // the unit interval, sorted, are barycentric coordinates
    constexpr double root =
      dim == 2 ? 1.32471795724474602596 : 1.22074408460575947536;
    std::array<double, dim + 2> cuts;
    cuts[0] = 0;
    for (unsigned int d = 0; d < dim; ++d)
      cuts[d + 1] = std::fmod(0.5 + (i + 1) * std::pow(root, -1. - d), 1.);
    cuts[dim + 1] = 1;
    std::sort(cuts.begin(), cuts.end());
    Point<dim> x;
    for (unsigned int v = 0; v <= dim; ++v)
      x += (cuts[v + 1] - cuts[v]) * corners[v];
    return x;
  }

  /** The places that say which part of a cell is body, with @p zones: those of
   * the points that are seeded in it or, where these have domains, the corners
   * of these, as seen from within. */
  template <int dim>
  std::vector<Point<dim>>
  places_in_cell(const SimplexGeometry<dim>                         &geometry,
                 const unsigned int                                  cell,
                 const std::vector<typename BodySeeding<dim>::Zone> &zones)
  {
    auto                    corners = corners_of(geometry, cell);
    std::vector<Point<dim>> places;
    order_for_subdivision<dim>(corners);
    const auto add = [&](const Point<dim> &x) {
      places.push_back(corners[0]);
      for (unsigned int d = 0; d < dim; ++d)
        places.back() += x[d] * (corners[d + 1] - corners[0]);
    };
    const auto &zone =
      zones[BodySeeding<dim>::find_zone(zones, cell_centroid(geometry, cell))];
    for (unsigned int q = 0; q < zone.rule.size(); ++q)
      if (zone.domains.empty())
        add(zone.rule.point(q));
      else
        for (const Tensor<1, dim> &corner : zone.domains[q])
          add(zone.rule.point(q) + (1 - rounding::accumulated) * corner);
    return places;
  }

  /** Call @p look with the cells that the body is seeded in, those of its mesh
   * or of the @p grid, and the names of their groups. */
  template <int dim, typename Look>
  void
  look_at_cells_of_body(const BodySeeding<dim>    &seeding,
                        const BackgroundGrid<dim> &grid,
                        const Look                &look)
  {
    const std::string &mesh = seeding.parameters_read().body_mesh;
    if (mesh.empty())
      return look(grid.geometry(), grid.group_ids());
    Triangulation<dim> body;
    const MeshGroups   names =
      read_mesh<dim>(mesh, "Material points/Body mesh", body);
    look(SimplexGeometry<dim>(body), names.cells);
  }
} // namespace isochor

#endif
