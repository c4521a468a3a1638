/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/surface_conditions.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void
  SurfaceConditions<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Traction",
      "",
      Patterns::Anything(),
      "Dead loads (Pa) on the surface that the body has on boundaries of the "
      "grid at t = 0: 'boundary: t_x, t_y(, t_z); boundary: ...'. The load "
      "follows the material it was put on, its formulas are in the reference "
      "position x, y(, z) and t, and it is per reference area. As all loads "
      "of this section it is short for a section 'Interaction: name - load' "
      "(with other quadratures than CPDI the only way to write it; of faces "
      "that the body covers in part only this part is loaded then).");
    prm.declare_entry(
      "Surfaces of body",
      "",
      Patterns::Anything(),
      "Parts of the body's surface at t = 0: 'name: place; name: place'. The "
      "place is the name of a boundary of the grid that the body touches, or "
      "a condition in x, y(, z) at the centres of faces. Loads and the sections "
      "'Interaction: name - partner' act on them. With <Quadrature/Type = CPDI> "
      "the faces are the outer ones of the points' subdomains, which move with "
      "the body, those on planes of symmetry among them (their number and size "
      "are printed). With others they are the free faces of the cells that the body "
      "fills (or those of <Mesh of body surfaces>, where the faces on planes of "
      "symmetry belong to its surface, too: leave them out by the condition), "
      "as far as the body covers them; boundary points mark them and follow the "
      "body, and the grid must not adapt.");
    prm.declare_entry(
      "Boundary points per face",
      "3",
      Patterns::Integer(1),
      "With other quadratures than CPDI: the number of boundary points on each "
      "face at t = 0, which are Gauss "
      "points: any number in 2D; 1, 3, 4, 6, 7, 9, 12, 15, 16, ... in 3D. "
      "From 2 (2D) or 3 (3D) on, a traction linear on a face is integrated "
      "exactly.");
    prm.declare_entry(
      "Mesh of body surfaces",
      "",
      Patterns::FileName(),
      "With other quadratures than CPDI: a gmsh .msh file of the body "
      "whose boundary faces are "
      "its surface where 'Surfaces of body' has a condition. "
      "Empty: the cells of the grid that the body fills.");
    prm.declare_entry("Traction on body",
                      "",
                      Patterns::Anything(),
                      "Dead loads (Pa) per reference area on surfaces of the "
                      "body, formulas in the reference position x, y(, z) and "
                      "t: 'surface: t_x, t_y(, t_z); surface: ...'.");
    prm.declare_entry("Pressure on body",
                      "",
                      Patterns::Anything(),
                      "Follower loads (Pa): a pressure against surfaces of the "
                      "body as they are deformed, positive if it pushes: "
                      "'surface: formula; ...', formulas in the reference "
                      "position x, y(, z) and t.");
  }



  template <int dim>
  void
  SurfaceConditions<dim>::parse_parameters(ParameterHandler &prm)
  {
    named           = SurfaceRegion<dim>::parse(prm.get("Surfaces of body"),
                                      section + "/Surfaces of body");
    points_per_face = prm.get_integer("Boundary points per face");
    body_mesh       = prm.get("Mesh of body surfaces");
    parse_loads(prm);
    parse_tractions(prm);
  }



  template <int dim>
  SurfaceCondition<dim> &
  SurfaceConditions<dim>::find_surface(const std::string &name,
                                       const std::string &parameter)
  {
    for (SurfaceCondition<dim> &surface : surfaces)
      if (surface.place.name == name)
        return surface;
    std::string known;
    for (const SurfaceRegion<dim> &region : named)
      {
        if (region.name == name)
          {
            surfaces.push_back({region, {name, region.parameter, "", {}, {}}});
            return surfaces.back();
          }
        known += (known.empty() ? "" : ", ") + region.name;
      }
    AssertThrow(false,
                ExcMessage("The parameter <" + section + "/" + parameter +
                           "> names the surface <" + name + ">. <" + section +
                           "/Surfaces of body> lists: " +
                           (known.empty() ? "none" : known) + "."));
    return surfaces.front();
  }



  template <int dim>
  void
  SurfaceConditions<dim>::parse_tractions(ParameterHandler &prm)
  {
    const std::string name = section + "/Traction";
    for (const auto &entry :
         split_list_of_unique_names(prm.get("Traction"), name))
      {
        SurfaceCondition<dim> surface;
        surface.place.name             = entry.first;
        surface.place.parameter        = name;
        surface.place.on_grid_boundary = true;
        surface.load.surface           = entry.first;
        surface.load.parameter         = name;
        for (const auto &item : split_formulas(entry.second, name))
          surface.load.traction.emplace_back(item, name);
        AssertThrow(surface.load.traction.size() == dim,
                    ExcMessage("The parameter <" + name + "> needs " +
                               std::to_string(dim) + " components on <" +
                               entry.first + ">."));
        surfaces.push_back(surface);
      }
  }



  template <int dim>
  void
  SurfaceConditions<dim>::parse_loads(ParameterHandler &prm)
  {
    for (const std::string parameter : {"Traction on body", "Pressure on body"})
      {
        const std::string name    = section + "/" + parameter;
        const bool        is_dead = parameter == "Traction on body";
        for (const auto &entry :
             split_list_of_unique_names(prm.get(parameter), name))
          {
            auto      &surface  = find_surface(entry.first, parameter).load;
            auto      &load     = is_dead ? surface.traction : surface.pressure;
            const auto formulas = is_dead ?
                                    split_formulas(entry.second, name) :
                                    std::vector<std::string>{entry.second};
            AssertThrow(!is_dead || formulas.size() == dim,
                        ExcMessage("The parameter <" + name + "> needs " +
                                   std::to_string(dim) + " components on <" +
                                   entry.first + ">."));
            for (const auto &formula : formulas)
              load.emplace_back(formula, name);
          }
      }
  }



  template <int dim>
  void
  SurfaceConditions<dim>::find_boundaries(const BackgroundGrid<dim> &grid)
  {
    for (SurfaceCondition<dim> &surface : surfaces)
      {
        SurfaceRegion<dim> &place          = surface.place;
        const bool          is_of_traction = place.on_grid_boundary;
        place.find_place(grid);
        AssertThrow(!place.on_grid_boundary || is_of_traction ||
                      body_mesh.empty(),
                    ExcMessage("With <" + section +
                               "/Mesh of body surfaces> the surface <" +
                               place.name +
                               "> needs a condition in the coordinates, not "
                               "the name of a boundary of the grid."));
      }
  }



  template struct SurfaceConditions<2>;
  template struct SurfaceConditions<3>;
} // namespace isochor
