/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What a parameter file says of a rigid side.

#include <isochor/boundary_condition/rigid_side.h>
#include <isochor/grid/extent.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <sstream>

namespace isochor
{
  template <int dim>
  RigidSide<dim>::RigidSide(const std::string &boundary,
                            const std::string &items,
                            const std::string &parameter)
    : boundary(boundary)
    , parameter(parameter)
    , R(unit_symmetric_tensor<3>())
    , reset_R(R)
  {
    for (const std::string &item : split_formulas(items, parameter))
      parse_item(item);
    for (unsigned int a = 0; a < dim; ++a)
      AssertThrow(!translation[a] || !force[a],
                  ExcMessage(std::string("The parameter <") + parameter +
                             "> prescribes both the displacement " + "xyz"[a] +
                             " of <" + boundary +
                             "> and the force along it: one of them follows "
                             "from the other."));
    for (unsigned int r = 0; r < n_rotations; ++r)
      AssertThrow(!rotation[r] || !moment[r],
                  ExcMessage(std::string("The parameter <") + parameter +
                             "> prescribes both a rotation of <" + boundary +
                             "> and the moment about its axis: one of them "
                             "follows from the other."));
  }



  template <int dim>
  void
  RigidSide<dim>::parse_item(const std::string &item)
  {
    const auto        equals = item.find('=');
    const std::string left =
      Utilities::trim(item.substr(0, std::min(equals, item.size())));
    const std::string right =
      equals == std::string::npos ? "" : item.substr(equals + 1);
    if (left == "centre" && equals != std::string::npos)
      {
        AssertThrow(!has_centre,
                    ExcMessage(std::string("The parameter <") + parameter +
                               "> names the <centre> of <" + boundary +
                               "> twice."));
        set_centre(right);
        return;
      }
    Formula *formula = nullptr;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const std::string axis_name(1, "xyz"[a]);
        if (left == axis_name)
          formula = &translation[a];
        else if (left == "force " + axis_name)
          formula = &force[a];
        else if (dim == 3 && left == "rotation " + axis_name)
          formula = &rotation[a % n_rotations];
        else if (dim == 3 && left == "moment " + axis_name)
          formula = &moment[a % n_rotations];
      }
    if (dim == 2 && left == "rotation")
      formula = &rotation[0];
    else if (dim == 2 && left == "moment")
      formula = &moment[0];
    AssertThrow(formula != nullptr && equals != std::string::npos,
                ExcMessage(
                  "The entry <" + item + "> of the parameter <" + parameter +
                  "> must have the form <name = formula>, with a name out of " +
                  (dim == 2 ? "x, y, rotation, force x, force y, moment" :
                              "x, y, z, rotation x, rotation y, rotation z, "
                              "force x, force y, force z, moment x, moment y, "
                              "moment z") +
                  ", or <centre = (...)>."));
    AssertThrow(*formula == nullptr,
                ExcMessage(std::string("The parameter <") + parameter +
                           "> prescribes <" + left + "> of <" + boundary +
                           "> twice."));
    *formula = std::make_unique<Expression<dim>>(right,
                                                 parameter,
                                                 FormulaVariables::time);
  }



  template <int dim>
  void
  RigidSide<dim>::set_centre(const std::string &text)
  {
    std::string list = Utilities::trim(text);
    if (list.size() > 1 && list.front() == '(' && list.back() == ')')
      list = list.substr(1, list.size() - 2);
    const auto numbers = Utilities::split_string_list(list);
    AssertThrow(numbers.size() == dim,
                ExcMessage(std::string("<centre = ") + text + "> of <" +
                           boundary + "> in the parameter <" + parameter +
                           "> must be " + std::to_string(dim) +
                           " coordinates in parentheses."));
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = Utilities::string_to_double(numbers[d]);
    has_centre = true;
  }



  template <int dim>
  void
  RigidSide<dim>::warn_of_centre_beside_body(const StepContext<dim> &step) const
  {
    const auto is_given = [](const Formula &formula) {
      return formula != nullptr;
    };
    if (has_centre || std::all_of(rotation.begin(), rotation.end(), is_given))
      return;
    Extent<dim> body;
    for (const unsigned int v : side_vertices)
      if (step.nodes.node(v) != numbers::invalid_unsigned_int)
        body.include(step.grid.geometry().vertices()[v]);
    body.merge(step.grid.communicator());
    // where it is held at the end of a side that the body has half of
    constexpr double beside = 0.25;
    double           most = 0, size = 0;
    Point<dim>       middle;
    for (unsigned int d = 0; d < dim; ++d)
      {
        middle[d] = (body.lower[d] + body.upper[d]) / 2;
        size      = std::max(size, body.upper[d] - body.lower[d]);
        // what is given along other axes changes by a rotation times this
        for (unsigned int a = 0; a < dim; ++a)
          if (a != d && (is_given(translation[a]) || is_given(force[a])) &&
              !(dim == 3 && is_given(rotation[3 - a - d])))
            most = std::max(most, std::abs(centre[d] - middle[d]));
      }
    if (body.lower[0] > body.upper[0] || most <= beside * size)
      return;
    std::ostringstream is_at, would_be;
    for (unsigned int d = 0; d < dim; ++d)
      {
        is_at << (d > 0 ? ", " : "(") << centre[d];
        would_be << (d > 0 ? ", " : "(") << middle[d];
      }
    step.warnings.add(
      "a rigid side that turns about a point beside the body",
      "The side <" + boundary + "> of the parameter <" + parameter +
        "> may turn, and what it says of displacements and forces is of its "
        "centroid, " +
        is_at.str() + "), although the body only has " + body.text() +
        " of it. If it is to be hinged or pushed in the middle of that, add "
        "<centre = " +
        would_be.str() + ")>.");
  }



  template RigidSide<2>::RigidSide(const std::string &,
                                   const std::string &,
                                   const std::string &);
  template void
  RigidSide<2>::parse_item(const std::string &);
  template void
  RigidSide<2>::set_centre(const std::string &);
  template void
  RigidSide<2>::warn_of_centre_beside_body(const StepContext<2> &) const;

  template RigidSide<3>::RigidSide(const std::string &,
                                   const std::string &,
                                   const std::string &);
  template void
  RigidSide<3>::parse_item(const std::string &);
  template void
  RigidSide<3>::set_centre(const std::string &);
  template void
  RigidSide<3>::warn_of_centre_beside_body(const StepContext<3> &) const;
} // namespace isochor
