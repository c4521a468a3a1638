/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/grid/mesh_reader.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/body_shape.h>
#include <isochor/material_points/mesh_overlap.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  BodyShape<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    region          = prm.get("Region");
    groups          = Utilities::split_string_list(prm.get("Physical groups"));
    body_mesh       = prm.get("Body mesh");
    lattice_spacing = prm.get_double("Lattice spacing");
    prm.leave_subsection();
    everywhere = Utilities::trim(region) == "1" && groups.empty() &&
                 body_mesh.empty() && !(lattice_spacing > 0);
  }



  template <int dim>
  void
  BodyShape<dim>::initialize(const BackgroundGrid<dim> &grid,
                             const bool                 with_domains,
                             const Bodies<dim>         &bodies)
  {
    this->grid         = &grid;
    this->bodies       = &bodies;
    this->with_domains = with_domains;
    if (everywhere)
      return;
    in_region =
      std::make_unique<Expression<dim>>(region, "Material points/Region");
    if (!body_mesh.empty())
      {
        mesh = std::make_unique<Triangulation<dim>>();
        mesh_groups =
          read_mesh<dim>(body_mesh, "Material points/Body mesh", *mesh).cells;
        mesh_geometry = std::make_unique<SimplexGeometry<dim>>(*mesh);
        locator       = std::make_unique<PointLocator<dim>>(*mesh_geometry);
      }
    else if (lattice_spacing > 0)
      {
        locator        = std::make_unique<PointLocator<dim>>(grid.geometry());
        lattice_origin = grid.geometry().vertices().front();
        for (const Point<dim> &vertex : grid.geometry().vertices())
          for (unsigned int d = 0; d < dim; ++d)
            lattice_origin[d] = std::min(lattice_origin[d], vertex[d]);
      }
  }



  template <int dim>
  bool
  BodyShape<dim>::contains(const Point<dim> &x, const unsigned int cell) const
  {
    Assert(grid != nullptr && bodies != nullptr,
           ExcMessage("initialize() comes first."));
    return any_contains(x, cell) &&
           (bodies->size() == 1 || bodies->at(x) == grid->layer_of_cell(cell));
  }



  template <int dim>
  bool
  BodyShape<dim>::any_contains(const Point<dim>  &x,
                               const unsigned int cell) const
  {
    if (everywhere)
      return true;
    constexpr unsigned int no_cell = SimplexGeometry<dim>::no_cell;
    if (mesh)
      {
        const auto place = locator->locate(x, no_cell);
        return place.found &&
               belongs(*mesh_geometry, place.cell, mesh_groups) &&
               (*in_region)(x, 0.) > 0;
      }
    if (lattice_spacing > 0)
      {
        const Point<dim> point = lattice_point(x);
        const auto       place = locator->locate(point, cell);
        return (*in_region)(with_domains ? x : point, 0.) > 0 && place.found &&
               belongs(grid->geometry(), place.cell, grid->group_ids());
      }
    return belongs(grid->geometry(), cell, grid->group_ids()) &&
           (*in_region)(x, 0.) > 0;
  }



  template <int dim>
  void
  BodyShape<dim>::check_mesh() const
  {
    if (!mesh)
      return;
    std::vector<unsigned char> is_in(mesh_geometry->n_cells(), 0);
    double                     volume = 0;
    for (unsigned int cell = 0; cell < is_in.size(); ++cell)
      if (belongs(*mesh_geometry, cell, mesh_groups) &&
          (*in_region)(cell_centroid(*mesh_geometry, cell), 0.) > 0)
        {
          is_in[cell] = 1;
          volume += mesh_geometry->measure(cell);
        }
    const MeshOverlap<dim> found = find_overlap(*mesh_geometry, is_in);
    if (found.n_overlapping == 0)
      return;
    std::ostringstream place;
    place << found.place;
    AssertThrow(
      false,
      ExcMessage(
        "Cells of the mesh <" + body_mesh +
        "> of the parameter <Material points/Body mesh> overlap each other, at " +
        std::to_string(found.n_overlapping) + " of the " +
        std::to_string(found.n_faces) + " faces at its surface, as near (" +
        place.str() +
        "). There the body has its mass and its stiffness twice; they add up "
        "to " +
        rounded(volume) + (dim == 2 ? " m^2" : " m^3") +
        ". Bodies that share a place have to be cut out of each other, or made "
        "one (gmsh: BooleanFragments, BooleanDifference, Coherence); name "
        "groups in <Material points/Physical groups> if the file has more than "
        "the body."));
  }



  template <int dim>
  bool
  BodyShape<dim>::belongs(
    const SimplexGeometry<dim>                      &geometry,
    const unsigned int                               cell,
    const std::map<std::string, types::material_id> &group_ids) const
  {
    AssertIndexRange(cell, geometry.n_cells());
    return in_groups(geometry.cell_iterator(cell)->material_id(),
                     groups,
                     group_ids);
  }



  template <int dim>
  Point<dim>
  BodyShape<dim>::lattice_point(const Point<dim> &x) const
  {
    // as MaterialPoints seeds them: one in the middle of each box, or one at
    // the centroid of each simplex 1 >= s_a >= s_b >= ... >= 0 of the box
    std::array<double, dim>       s;
    std::array<unsigned int, dim> axes;
    std::iota(axes.begin(), axes.end(), 0);
    Point<dim> point = lattice_origin;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double boxes = (x[d] - lattice_origin[d]) / lattice_spacing;
        s[d]               = boxes - std::floor(boxes);
        point[d] += lattice_spacing * std::floor(boxes);
      }
    std::sort(axes.begin(), axes.end(), [&](const auto a, const auto b) {
      return s[a] > s[b];
    });
    for (unsigned int k = 0; k < dim; ++k)
      point[axes[k]] +=
        lattice_spacing * (with_domains ? (dim - k) / (dim + 1.) : 0.5);
    return point;
  }



  template class BodyShape<2>;
  template class BodyShape<3>;
} // namespace isochor
