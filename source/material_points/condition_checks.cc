/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of BodySeeding that look for formulas which are hardly meant as
// conditions.
#include <isochor/base/condition.h>
#include <isochor/base/expression.h>
#include <isochor/grid/mesh_reader.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/body_seeding.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void
  BodySeeding<dim>::check_conditions(const BackgroundGrid<dim> &grid,
                                     Warnings                  &warnings) const
  {
    check_region(grid, warnings);
    const auto is_doubtful = [](const std::string &zones) {
      const auto list = split_named_list(zones, "");
      return std::any_of(list.begin(), list.end(), [](const auto &zone) {
        return compares_nothing(zone.second);
      });
    };
    if (!is_doubtful(parameters.material_zones) &&
        !is_doubtful(parameters.zones))
      return;
    check_cells_of_body(grid, [&](const auto &geometry, const auto &group_ids) {
      check_zones(geometry, group_ids, warnings);
    });
  }



  template <int dim>
  void
  BodySeeding<dim>::check_cells_of_body(
    const BackgroundGrid<dim> &grid,
    const std::function<void(const SimplexGeometry<dim> &,
                             const std::map<std::string, types::material_id> &)>
      &check) const
  {
    if (parameters.body_mesh.empty())
      return check(grid.geometry(), grid.group_ids());
    Triangulation<dim> body;
    const MeshGroups   names =
      read_mesh<dim>(parameters.body_mesh, "Material points/Body mesh", body);
    check(SimplexGeometry<dim>(body), names.cells);
  }



  template <int dim>
  void
  BodySeeding<dim>::check_region(const BackgroundGrid<dim> &grid,
                                 Warnings                  &warnings) const
  {
    // the formula need not have values beside a mesh of the body
    if (!parameters.body_mesh.empty() || !compares_nothing(parameters.region))
      return;
    const Expression<dim> in_body(parameters.region, "Material points/Region");
    std::vector<double>   values;
    for (unsigned int cell = 0; cell < grid.geometry().n_cells_of_first_layer();
         ++cell)
      values.push_back(in_body(cell_centroid(grid.geometry(), cell), 0.));
    warn_of_formula_for_condition(parameters.region,
                                  "Material points/Region",
                                  values,
                                  warnings);
  }



  template <int dim>
  void
  BodySeeding<dim>::check_zones(
    const SimplexGeometry<dim>                      &geometry,
    const std::map<std::string, types::material_id> &group_ids,
    Warnings                                        &warnings) const
  {
    const Expression<dim> in_body(parameters.region, "Material points/Region");
    std::vector<Point<dim>> places;
    for (unsigned int cell = 0; cell < geometry.n_cells_of_first_layer();
         ++cell)
      if (in_groups(geometry.cell_iterator(cell)->material_id(),
                    parameters.groups,
                    group_ids))
        if (const Point<dim> centroid = cell_centroid(geometry, cell);
            in_body(centroid, 0.) > 0)
          places.push_back(centroid);

    const auto check = [&](const std::string &zones, const std::string &name) {
      for (const auto &zone : split_named_list(zones, name))
        if (compares_nothing(zone.second))
          {
            const Expression<dim> condition(zone.second, name);
            std::vector<double>   values;
            for (const Point<dim> &place : places)
              values.push_back(condition(place, 0.));
            warn_of_formula_for_condition(zone.second, name, values, warnings);
          }
    };
    check(parameters.material_zones, "Material points/Materials in zones");
    check(parameters.zones, "Material points/Points per cell in zones");
  }



  template void
  BodySeeding<2>::check_conditions(const BackgroundGrid<2> &, Warnings &) const;
  template void
  BodySeeding<3>::check_conditions(const BackgroundGrid<3> &, Warnings &) const;
  template void
  BodySeeding<2>::check_cells_of_body(
    const BackgroundGrid<2> &,
    const std::function<void(const SimplexGeometry<2> &,
                             const std::map<std::string, types::material_id> &)>
      &) const;
  template void
  BodySeeding<3>::check_cells_of_body(
    const BackgroundGrid<3> &,
    const std::function<void(const SimplexGeometry<3> &,
                             const std::map<std::string, types::material_id> &)>
      &) const;
} // namespace isochor
