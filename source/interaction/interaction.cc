/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/patterns.h>

#include <isochor/interaction/grid_boundary_partner.h>
#include <isochor/interaction/interaction.h>
#include <isochor/interaction/prescribed_place.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** Of the interaction "NAME - PARTNER" in @p section: both names. */
    std::pair<std::string, std::string>
    names_in(const std::string &section)
    {
      const std::string kind  = "Interaction: ",
                        title = section.substr(kind.size());
      const std::size_t dash  = title.find(" - ");
      AssertThrow(dash != std::string::npos && dash > 0 &&
                    dash + 3 < title.size(),
                  ExcMessage("The subsection <" + section +
                             "> must name a body or a surface and its "
                             "partner: <" +
                             kind + "name - partner>."));
      return {title.substr(0, dash), title.substr(dash + 3)};
    }

    /** The partners that are no other thing's names. */
    const std::string place = "place", load = "load";

    bool
    ends_with(const std::string &section, const std::string &partner)
    {
      const std::string end = " - " + partner;
      return section.size() > end.size() &&
             section.compare(section.size() - end.size(), end.size(), end) == 0;
    }
  } // namespace



  template <int dim>
  void
  Interaction<dim>::declare_parameters(ParameterHandler  &prm,
                                       const std::string &section)
  {
    InteractionLaw<dim>::declare_laws(prm,
                                      ends_with(section, place) ? "tie" :
                                      ends_with(section, load)  ? "load" :
                                                                  "unilateral");
    prm.declare_entry("Displacement",
                      "",
                      Patterns::Anything(),
                      "Of an interaction with 'place': where the surface goes, "
                      "as displacements (m) since t = 0, formulas in x, y(, z) "
                      "at t = 0 and t: 'x=0, y=-0.1*t'. Components that are "
                      "left out are free.");
  }



  template <int dim>
  Interaction<dim>::Interaction(ParameterHandler                      &prm,
                                const std::string                     &section,
                                const std::vector<SurfaceRegion<dim>> &surfaces)
    : section(section)
    , body(names_in(section).first)
    , partner_name(names_in(section).second)
    , law(InteractionLaw<dim>::create(prm, section))
  {
    for (const SurfaceRegion<dim> &surface : surfaces)
      if (surface.name == body)
        region = surface;
    if (partner_name == place)
      partner =
        std::make_unique<PrescribedPlace<dim>>(prm.get("Displacement"),
                                               section + "/Displacement");
    AssertThrow((partner_name == load) == (law->load() != nullptr),
                ExcMessage("<" + section +
                           "/Law = load> and the partner 'load' belong to each "
                           "other: <Interaction: " +
                           body + " - load>."));
    if (law->load() != nullptr)
      law->load()->surface = body;
    AssertThrow(!partner || (law->acts() && !law->is_unilateral()),
                ExcMessage("<" + section +
                           "/Law> must be 'tie': a place is no surface that "
                           "could be left."));
    AssertThrow(partner_name.rfind(of_boundary(""), 0) != 0 || law->acts(),
                ExcMessage("<" + section +
                           "/Law = none> is for two bodies only. Leave the "
                           "section out."));
  }



  template <int dim>
  Interaction<dim>::Interaction(const std::string               &body,
                                const std::vector<OneSidedWall> &walls,
                                const unsigned int               which)
    : section(walls[which].parameter)
    , body(body)
    , partner_name(of_boundary(walls[which].boundary))
    , partner(std::make_unique<GridBoundaryPartner<dim>>(walls, which))
  {
    ParameterHandler prm;
    InteractionLaw<dim>::declare_laws(prm, "unilateral");
    law = InteractionLaw<dim>::create(prm, section);
  }



  template <int dim>
  Interaction<dim>::Interaction(const SurfaceCondition<dim> &surface)
    : section(surface.load.parameter)
    , body(surface.place.name)
    , partner_name(load)
    , region(surface.place)
    , law(PluginRegistry<InteractionLaw<dim>>::create(load))
  {
    *law->load() = surface.load;
  }



  template <int dim>
  std::string
  Interaction<dim>::what_is_missing() const
  {
    if (region && region->on_grid_boundary)
      return "The body does not touch the boundary <" +
             (region->condition.empty() ? body : region->condition) +
             "> of the grid at t = 0, where <" + section +
             "> acts. Name one that it touches, or describe the place by "
             "<Boundary conditions/Surfaces of body>.";
    return "<" + section + "> acts on nothing: " +
           (region ? "<" + region->parameter + " = " + body + ": " +
                       region->condition +
                       "> has the centre of no face of a body's surface at t = "
                       "0." :
                     "the body <" + body + "> has no surface.");
  }



  template <int dim>
  void
  Interaction<dim>::find_wall(std::vector<OneSidedWall> walls)
  {
    const std::string kind = of_boundary("");
    if (partner || partner_name.rfind(kind, 0) != 0)
      return;
    AssertThrow(law->is_unilateral() || region,
                ExcMessage("<" + section +
                           "/Law = tie> needs <Surface>: the part of the "
                           "body's surface that the boundary holds."));
    auto wall = std::find_if(walls.begin(), walls.end(), [&](const auto &one) {
      return is_with_boundary(one.boundary);
    });
    if (wall == walls.end())
      wall = walls.insert(wall, {section, partner_name.substr(kind.size())});
    partner =
      std::make_unique<GridBoundaryPartner<dim>>(walls, wall - walls.begin());
  }



  template <int dim>
  void
  Interaction<dim>::find_bodies(const std::vector<std::string> &names)
  {
    const auto find = [&](const std::string &name, const std::string &others) {
      std::vector<bool> found;
      for (const std::string &known : names)
        found.push_back(known == name);
      AssertThrow(std::find(found.begin(), found.end(), true) != found.end(),
                  ExcMessage(
                    "The section <" + section + "> names <" + name +
                    ">, which is no body. There is: " +
                    Patterns::Tools::to_string(names) + others +
                    ". Bodies get names by <Material points/Bodies>."));
      return found;
    };
    if (region)
      {
        AssertThrow(std::find(names.begin(), names.end(), body) == names.end(),
                    ExcMessage("The section <" + section + "> names <" + body +
                               ">, which is a body and a surface of <" +
                               region->parameter +
                               ">. Give one of them another name."));
        bodies.assign(names.size(), true);
      }
    else
      bodies =
        find(body, "; also what <Boundary conditions/Surfaces of body> names");
    if (!partner && law->load() == nullptr)
      partners =
        find(partner_name,
             "; as a partner also 'load', 'place', 'boundary NAME' and "
             "what a section <Rigid body: ...> describes");
    else
      partners.assign(names.size(), false);
  }



  template <int dim>
  void
  add_walls(const std::vector<OneSidedWall>                &walls,
            const std::vector<std::string>                 &bodies,
            std::vector<std::unique_ptr<Interaction<dim>>> &interactions)
  {
    for (unsigned int w = 0; w < walls.size(); ++w)
      for (const std::string &body : bodies)
        if (std::none_of(interactions.begin(),
                         interactions.end(),
                         [&](const auto &one) {
                           return one->body == body &&
                                  one->is_with_boundary(walls[w].boundary);
                         }))
          interactions.push_back(
            std::make_unique<Interaction<dim>>(body, walls, w));
  }



  template void
  add_walls(const std::vector<OneSidedWall> &,
            const std::vector<std::string> &,
            std::vector<std::unique_ptr<Interaction<2>>> &);
  template void
  add_walls(const std::vector<OneSidedWall> &,
            const std::vector<std::string> &,
            std::vector<std::unique_ptr<Interaction<3>>> &);
  template class Interaction<2>;
  template class Interaction<3>;
} // namespace isochor
