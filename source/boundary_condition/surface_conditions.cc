/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/surface_conditions.h>

#include <algorithm>
#include <cctype>

namespace isochor
{
  namespace
  {
    /** Whether @p text is a word that no formula consists of: a boundary of
     * the grid, perhaps with a typing mistake. */
    bool
    is_name(const std::string &text)
    {
      constexpr std::array<const char *, 5> numbers = {
        {"x", "y", "z", "t", "pi"}};
      return !text.empty() &&
             std::isalpha(static_cast<unsigned char>(text[0])) &&
             std::all_of(text.begin(),
                         text.end(),
                         [](const unsigned char c) {
                           return std::isalnum(c) || c == '_';
                         }) &&
             std::find(numbers.begin(), numbers.end(), text) == numbers.end();
    }
  } // namespace



  template <int dim>
  void
  SurfaceConditions<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Traction",
      "",
      Patterns::Anything(),
      "Dead loads (Pa) on the surface that the body has on boundaries of the "
      "grid at t = 0: 'boundary: t_x, t_y(, t_z); boundary: ...'. Short for "
      "'Surfaces of body' and 'Traction on body': the load follows the "
      "material it was put on, its formulas are in the reference position x, "
      "y(, z) and t, and it is per reference area. Of faces that the body "
      "covers in part only this part is loaded.");
    prm.declare_entry(
      "Surfaces of body",
      "",
      Patterns::Anything(),
      "Parts of the body's surface at t = 0: 'name: place; name: place'. The "
      "place is the name of a boundary of the grid that the body touches, or "
      "a condition in x, y(, z) at the centres of the free faces of the "
      "cells that the body fills (or of those of <Mesh of body surfaces>, where the faces on "
      "planes of symmetry belong to its surface, too: leave them out by the "
      "condition). "
      "Boundary points mark the surface and follow the body. If the grid is "
      "moved or refined, its faces lie elsewhere, and a condition must "
      "still hold at their centres; with a mesh it does. Of faces that the "
      "body covers in part only this part belongs to "
      "its surface.");
    prm.declare_entry(
      "Boundary points per face",
      "3",
      Patterns::Integer(1),
      "Number of boundary points on each face at t = 0, which are Gauss "
      "points: any number in 2D; 1, 3, 4, 6, 7, 9, 12, 15, 16, ... in 3D. "
      "With CPDI the faces are those of the points' domains. With 1, a "
      "surface that <Displacement of body> names is a hinge if it has one "
      "face of a cell, or in 3D faces whose centres lie on a line (a row of "
      "cells has two such lines, as its faces are triangles): it is held "
      "there. Smaller cells at t = 0, as by repetitions of the first step on "
      "an adaptive grid, make several faces of it, and no hinge; how many a "
      "surface has is told at the start. "
      "From 2 (2D) or 3 (3D) on, a traction linear on a face is integrated "
      "exactly.");
    prm.declare_entry("Mesh of body surfaces",
                      "",
                      Patterns::Anything(),
                      "A gmsh .msh file of the body whose boundary faces are "
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
    prm.declare_entry("Displacement of body",
                      "",
                      Patterns::Anything(),
                      "Prescribed displacements (m) since t = 0 of surfaces of "
                      "the body, formulas in the reference position x, y(, z) "
                      "and t: 'surface: x = formula, y = formula; surface: "
                      "...'. Components not named are free.");
    prm.declare_entry(
      "Penalty of body displacement",
      "auto",
      Patterns::Anything(),
      "Displacements of the body are prescribed by springs. This is their "
      "stiffness per area, in units of shear modulus over cell size. In "
      "statics mean place, rotation and stretch of each surface are those "
      "that are prescribed, whatever the stiffness, and only what differs from "
      "them yields to local forces; stiff springs lock where a curved surface "
      "goes through cells. In dynamics the surface follows up to a small gap. "
      "auto: 10 in statics, 100 in dynamics. "
      "Where materials meet, the shear modulus is the mean, by volume, of "
      "those around the point's nodes; with CPDI it is that of the domain.");
  }



  template <int dim>
  void
  SurfaceConditions<dim>::parse_parameters(ParameterHandler &prm)
  {
    const std::string name = section + "/Surfaces of body";
    for (const auto &entry :
         split_list_of_unique_names(prm.get("Surfaces of body"), name))
      {
        SurfaceCondition<dim> surface;
        surface.place.name      = entry.first;
        surface.place.parameter = name;
        surface.place.condition = entry.second;
        surfaces.push_back(surface);
      }
    points_per_face = prm.get_integer("Boundary points per face");
    body_mesh       = prm.get("Mesh of body surfaces");
    parse_penalty(prm);
    parse_loads(prm);
    parse_displacements(prm);
    parse_tractions(prm);
  }



  template <int dim>
  void
  SurfaceConditions<dim>::parse_penalty(ParameterHandler &prm)
  {
    const std::string text = prm.get("Penalty of body displacement");
    if (text == "auto")
      return;
    const std::string message =
      "The parameter <" + section +
      "/Penalty of body displacement> must be 'auto' or a positive number, "
      "not '" +
      text + "'.";
    try
      {
        given_penalty = Utilities::string_to_double(text);
      }
    catch (const ExceptionBase &)
      {
        AssertThrow(false, ExcMessage(message));
      }
    AssertThrow(*given_penalty > 0, ExcMessage(message));
  }



  template <int dim>
  SurfaceCondition<dim> &
  SurfaceConditions<dim>::find_surface(const std::string &name,
                                       const std::string &parameter)
  {
    std::string known;
    for (SurfaceCondition<dim> &surface : surfaces)
      {
        if (surface.place.name == name)
          return surface;
        known += (known.empty() ? "" : ", ") + surface.place.name;
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
        for (const auto &item : split_formulas(entry.second, name))
          surface.traction.emplace_back(item, name);
        AssertThrow(surface.traction.size() == dim,
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
            auto      &surface  = find_surface(entry.first, parameter);
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
  SurfaceConditions<dim>::parse_displacements(ParameterHandler &prm)
  {
    const std::string parameter = "Displacement of body";
    const std::string name      = section + "/" + parameter;
    const std::string axes      = std::string("xyz").substr(0, dim);
    for (const auto &entry : split_named_list(prm.get(parameter), name))
      for (const auto &item : split_formulas(entry.second, name))
        {
          auto             &surface = find_surface(entry.first, parameter);
          const auto        equals  = item.find('=');
          const std::string axis =
            Utilities::trim(item.substr(0, std::min(equals, item.size())));
          AssertThrow(equals != std::string::npos && axis.size() == 1 &&
                        axes.find(axis) != std::string::npos,
                      ExcMessage("The entry <" + item + "> of the parameter <" +
                                 name +
                                 "> must have the form <x = formula>, with a "
                                 "component out of " +
                                 axes + "."));
          auto &displacement = surface.displacement[axes.find(axis)];
          AssertThrow(displacement.empty(),
                      ExcMessage("The parameter <" + name +
                                 "> prescribes the component " + axis +
                                 " of the surface <" + entry.first +
                                 "> twice."));
          displacement.emplace_back(item.substr(equals + 1), name);
        }
  }



  template <int dim>
  void
  SurfaceConditions<dim>::find_boundaries(const BackgroundGrid<dim> &grid)
  {
    for (SurfaceCondition<dim> &surface : surfaces)
      {
        SurfaceRegion<dim> &place = surface.place;
        if (place.on_grid_boundary)
          {
            place.id = grid.boundary_id(place.name, place.parameter);
            continue;
          }
        if (grid.boundary_names().count(place.condition) == 0 &&
            (!body_mesh.empty() || !is_name(place.condition)))
          continue; // a condition in the coordinates
        place.id = grid.boundary_id(place.condition, place.parameter);
        AssertThrow(body_mesh.empty(),
                    ExcMessage("With <" + section +
                               "/Mesh of body surfaces> the surface <" +
                               place.name +
                               "> needs a condition in the coordinates, not "
                               "the name of a boundary of the grid."));
        place.on_grid_boundary = true;
      }
  }



  template <int dim>
  bool
  SurfaceConditions<dim>::support(const Tensor<1, dim> &gravity) const
  {
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const auto &s) {
      bool is_fixed_along = false;
      for (unsigned int a = 0; a < dim; ++a)
        is_fixed_along =
          is_fixed_along || (!s.displacement[a].empty() && gravity[a] != 0.);
      return is_fixed_along || !s.traction.empty() || !s.pressure.empty();
    });
  }



  template struct SurfaceConditions<2>;
  template struct SurfaceConditions<3>;
} // namespace isochor
