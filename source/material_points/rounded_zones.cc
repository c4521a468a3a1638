/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The member of BodySeeding that looks at what points make of the zones of
// materials.
#include <deal.II/base/mpi.h>

#include <isochor/base/expression.h>
#include <isochor/base/plain_message.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/body_seeding.h>
#include <isochor/material_points/places_in_cells.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Volumes of a material (m^dim). */
    struct Volumes
    {
      double points = 0, ///< what its points stand for
        zones       = 0; ///< what its zones have, where points are

      void
      add(const double to_points, const double to_zones)
      {
        points += to_points;
        zones += to_zones;
      }
    };
  } // namespace



  template <int dim>
  void
  BodySeeding<dim>::check_material_zones(const BackgroundGrid<dim> &grid,
                                         const bool with_domains,
                                         Warnings  &warnings) const
  {
    if (parameters.material_zones.empty() || parameters.lattice_spacing > 0)
      return;
    constexpr double        much  = 0.02;
    const MPI_Comm          comm  = grid.communicator();
    const MaterialZones     zones = create_material_zones();
    const std::vector<Zone> rules = create_zones(with_domains);
    const Expression<dim> in_body(parameters.region, "Material points/Region");
    const auto            material = [&](const Point<dim> &x) {
      return material_at(zones, x);
    };
    int n_materials = 1;
    for (const auto &zone : zones)
      n_materials = std::max(n_materials, zone.first);
    std::vector<Volumes> volumes(n_materials);
    const auto look_at_mixed = [&](const SimplexGeometry<dim> &geometry,
                                   const unsigned int          cell,
                                   const unsigned int          n_places) {
      const auto places = places_in_cell(geometry, cell, rules);
      // what a region is rounded to is another matter
      if (!std::all_of(places.begin(), places.end(), [&](const auto &x) {
            return in_body(x, 0.) > 0;
          }))
        return;
      const double size    = geometry.measure(cell);
      const auto   corners = corners_of(geometry, cell);
      for (const Point<dim> &x : places)
        volumes[material(x)].add(size / places.size(), 0.);
      for (unsigned int i = 0; i < n_places; ++i)
        volumes[material(
                  spread_place<dim>(corners, std::size_t(cell) * n_places + i))]
          .add(0., size / n_places);
    };
    const auto look =
      [&](const SimplexGeometry<dim>                      &body,
          const std::map<std::string, types::material_id> &ids) {
        std::vector<int>          at_vertex(body.vertices().size(), -1);
        std::vector<unsigned int> mixed;
        for (unsigned int cell = Utilities::MPI::this_mpi_process(comm);
             cell < body.n_cells_of_first_layer();
             cell += Utilities::MPI::n_mpi_processes(comm))
          {
            const Point<dim> centroid = cell_centroid(body, cell);
            if (!in_groups(body.cell_iterator(cell)->material_id(),
                           parameters.groups,
                           ids) ||
                !(in_body(centroid, 0.) > 0))
              continue;
            const int own      = material(centroid);
            bool      is_mixed = false;
            for (const unsigned int v : body.vertex_indices(cell))
              {
                if (at_vertex[v] < 0)
                  at_vertex[v] = material(body.vertices()[v]);
                is_mixed = is_mixed || at_vertex[v] != own;
              }
            if (is_mixed)
              mixed.push_back(cell);
            else
              volumes[own].add(body.measure(cell), body.measure(cell));
          }
        // enough places for the sum, and for each cell
        constexpr std::size_t in_all = 100000, least = 16, most = 256;
        for (const unsigned int cell : mixed)
          look_at_mixed(body,
                        cell,
                        std::clamp(in_all / mixed.size(), least, most));
      };
    try
      {
        check_cells_of_body(grid, look);
      }
    catch (const StandardExceptions::ExcMessage &)
      {
        // a formula need have values at the points only
        volumes.assign(n_materials, Volumes());
      }
    unsigned int worst = 0;
    double       most  = much;
    for (int k = 0; k < n_materials; ++k)
      {
        Volumes &here = volumes[k];
        here          = {Utilities::MPI::sum(here.points, comm),
                         Utilities::MPI::sum(here.zones, comm)};
        // of no points at all another warning tells
        if (here.points > 0 &&
            std::abs(here.points - here.zones) > most * here.zones)
          {
            worst = k;
            most  = std::abs(here.points - here.zones) / here.zones;
          }
      }
    if (most > much)
      warnings.add(
        "zones that are rounded to the points",
        "The points of material " + std::to_string(worst + 1) + " stand for " +
          rounded(volumes[worst].points) + " m^" + std::to_string(dim) + ", " +
          rounded(100 * most) + " % " +
          (volumes[worst].points > volumes[worst].zones ? "more" : "less") +
          " than <Material points/Materials in zones> gives it: a point is of "
          "one material as a whole, so that materials meet at the sides of "
          "cells or of the parts of them that points stand for, as near to "
          "the zone's side as these are. Put sides of zones on lines of cells "
          "or of these parts, take smaller cells or more points (<Points per "
          "cell>), or a <Body mesh> whose faces lie in them.");
  }



  template void
  BodySeeding<2>::check_material_zones(const BackgroundGrid<2> &,
                                       const bool,
                                       Warnings &) const;
  template void
  BodySeeding<3>::check_material_zones(const BackgroundGrid<3> &,
                                       const bool,
                                       Warnings &) const;
} // namespace isochor
