/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/parameter_list.h>
#include <isochor/base/replaced_parameters.h>

#include <sstream>

namespace isochor
{
  namespace
  {
    /** How "surface: x = ..., y = ...; surface: ..." is written now. */
    std::string
    as_interactions(const std::string &displacements)
    {
      std::string        text;
      std::istringstream list(displacements);
      for (std::string item; std::getline(list, item, ';');)
        if (const std::size_t colon = item.find(':');
            colon != std::string::npos)
          text += "\n  subsection Interaction: " +
                  Utilities::trim(item.substr(0, colon)) +
                  " - place\n    set Displacement = " +
                  Utilities::trim(item.substr(colon + 1)) + "\n  end";
      return text;
    }



    /** Of a parameter in @p section: what took its place, if it is gone. */
    std::string
    instead_of_parameter(const std::string &section,
                         const std::string &name,
                         const std::string &value)
    {
      const std::string interaction = "Interaction: ";
      if (section == "Formulation" && name == "Project volume change")
        return "leave it out; the volumes of points don't drift any more, "
               "whatever the <Quadrature/Type>";
      if (section == "Material points" &&
          (name == "Domains" || name == "Least points per cell" ||
           name == "Merge points" || name == "Merging tolerance"))
        return "leave it out; with <Quadrature/Type = CPDI>, the default, "
               "points have subdomains, which are bisected and merged where "
               "an adaptive grid asks for it";
      if (name == "Symmetrize tangent")
        return "leave it out; the tangent is symmetric";
      if (section == "Formulation" && name == "PPP leaves out weight")
        return "leave it out; PPP does it without inertia, and with inertia "
               "<Stabilisation = OSS> does it better";
      if (section.rfind("Boundary conditions", 0) == 0)
        {
          if (name == "Displacement of body")
            return "a surface of <Boundary conditions/Surfaces of body> is "
                   "tied to its place by a section of its own:" +
                   as_interactions(value);
          if (name == "Rigid sides")
            return "tie a surface of the body to a rigid body. <right: y = 0, "
                   "rotation = t> of a body that ends at x = 8 is now"
                   "\n  set Surfaces of body = end: x > 7.99    # in this section"
                   "\n  subsection Rigid body: right"
                   "\n    set Shape = half plane"
                   "\n    set Point = 8, 0.5    # on the side"
                   "\n    set Normal = -1, 0    # towards the body"
                   "\n    set Motion = y=0, rotation=t"
                   "\n    set Free = x          # what was not named"
                   "\n  end"
                   "\n  subsection Interaction: end - right"
                   "\n    set Law = tie"
                   "\n  end";
          if (name == "Penalty of body displacement")
            return "leave it out; <" + interaction +
                   "name - place> has nothing to choose";
        }
      if (section.rfind(interaction, 0) == 0 && name == "Surface")
        {
          const std::size_t dash = section.find(" - ");
          return "name the surface in the section <Boundary conditions>,"
                 "\n  set Surfaces of body = NAME: " +
                 value + "\nand call this section <" + interaction + "NAME" +
                 (dash == std::string::npos ? "" : section.substr(dash)) + ">";
        }
      return "";
    }
  } // namespace



  void
  check_replaced(const ParameterStatement &statement)
  {
    const auto &path = statement.path;
    if (join_path(path) == "Quadrature/Type" &&
        statement.value.rfind("cell-filled", 0) == 0)
      throw ParameterError(statement.origin +
                           ": <Quadrature/Type = " + statement.value +
                           "> is gone: take <Quadrature/Type = CPDI>, the "
                           "default, which is more accurate");
    if (path.front() == "Ghost penalty")
      throw ParameterError(
        statement.origin + ": the subsection <" + path.front() +
        "> is gone: nodes of cut cells are tied to well filled cells instead, "
        "see <Cut cells/Extension> (auto, always or never, as <Ghost "
        "penalty/Use> was); there are no coefficients any more");
    if (statement.is_subsection || path.size() != 2)
      return;
    const std::string instead =
      instead_of_parameter(path[0], path[1], statement.value);
    if (!instead.empty())
      throw ParameterError(statement.origin + ": the parameter <" +
                           join_path(path) + "> is gone: " + instead);
  }
} // namespace isochor
