/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/component_formulas.h>
#include <isochor/grid/lattice_source.h>
#include <isochor/rigid_body/rigid_body.h>

#include <algorithm>
#include <cmath>

// What a parameter file says of a rigid body.

namespace isochor
{
  template <int dim>
  RigidBody<dim>::RigidBody(const std::string &section)
    : section(section)
    , own_name(section.substr(
        section.rfind(": ") == std::string::npos ? 0 : section.rfind(": ") + 2))
  {}



  template <int dim>
  const std::vector<std::string> &
  RigidBody<dim>::component_names()
  {
    static const std::vector<std::string> names =
      dim == 2 ? std::vector<std::string>{"x", "y", "rotation"} :
                 std::vector<std::string>{"x", "y", "z", "rx", "ry", "rz"};
    return names;
  }



  template <int dim>
  void
  RigidBody<dim>::declare_parameters(ParameterHandler &prm)
  {
    const std::string names =
      dim == 2 ? "x, y, rotation" : "x, y, z, rx, ry, rz";
    RigidShape<dim>::declare_shapes(prm);
    prm.declare_entry("Reference point",
                      "",
                      Patterns::List(Patterns::Double(), 0, dim),
                      "The point (m) that moves by x and y (and z), that "
                      "rotations and moments are about, and that is the centre "
                      "of mass. Empty: the centre of the shape.");
    prm.declare_entry("Motion",
                      "",
                      Patterns::Anything(),
                      "Prescribed components of the motion since t = 0, out "
                      "of " +
                        names +
                        ": displacements (m) of the reference point and " +
                        (dim == 2 ? "the rotation (rad)" :
                                    "the rotation vector (rad)") +
                        ", as formulas in t: 'y=-0.1*t'. Components that "
                        "neither this nor 'Free' names are fixed.");
    prm.declare_entry("Free",
                      "",
                      Patterns::Anything(),
                      "The components, out of " + names +
                        ", that follow from the forces on the rigid body: "
                        "'x, y'.");
    prm.declare_entry("Force",
                      "",
                      Patterns::Anything(),
                      "The force (N) at the reference point along free "
                      "components, as formulas in t: 'y=-1000'. Also the "
                      "weight. Per m of thickness in 2D, of the whole "
                      "circumference in axisymmetry.");
    prm.declare_entry("Moment",
                      "",
                      Patterns::Anything(),
                      std::string(
                        "The moment (N m) about the reference point ") +
                        (dim == 2 ? "of a free rotation: 'rotation=10*t'." :
                                    "and fixed axes: 'rz=10*t'."));
    prm.declare_entry("Mass",
                      "0",
                      Patterns::Double(0),
                      "The mass (kg) of what is free, for scenes with "
                      "inertia.");
    prm.declare_entry("Moment of inertia",
                      "0",
                      Patterns::List(Patterns::Double(0), 1, n_rotations),
                      dim == 2 ?
                        "About the reference point (kg m²)." :
                        "About the axes through the reference point at t = 0, "
                        "which have to be the principal axes (kg m²): one "
                        "number for all, or three.");
    prm.declare_entry("Initial velocity",
                      "",
                      Patterns::Anything(),
                      "Of free components at t = 0, in scenes with inertia "
                      "(m/s, rad/s): 'y=-2'.");
  }



  template <int dim>
  void
  RigidBody<dim>::parse_parameters(ParameterHandler &prm)
  {
    own_shape = RigidShape<dim>::create(prm, section);
    reference = prm.get("Reference point").empty() ?
                  own_shape->centre() :
                  parse_point<dim>(prm.get("Reference point"),
                                   section + "/Reference point");
    motions   = parse_component_formulas<dim>(prm.get("Motion"),
                                            component_names(),
                                            section + "/Motion",
                                            FormulaVariables::time);
    parse_free(prm.get("Free"));
    parse_loads(prm);
    parse_inertia(prm);
    start();
  }



  template <int dim>
  std::set<std::string>
  RigidBody<dim>::parameters_in_use() const
  {
    std::set<std::string> names = own_shape->parameters_in_use();
    names.insert({"Shape", "Reference point", "Motion", "Free"});
    if (has_free_components())
      names.insert(
        {"Force", "Moment", "Mass", "Moment of inertia", "Initial velocity"});
    return names;
  }



  template <int dim>
  void
  RigidBody<dim>::parse_free(const std::string &list)
  {
    const auto &names = component_names();
    for (const std::string &item : Utilities::split_string_list(list))
      {
        const auto name = std::find(names.begin(), names.end(), item);
        AssertThrow(name != names.end(),
                    ExcMessage(
                      "<" + item + "> in the parameter <" + section +
                      "/Free> is no component: these are " +
                      (dim == 2 ? "x, y, rotation." : "x, y, z, rx, ry, rz.")));
        const unsigned int c = name - names.begin();
        AssertThrow(!motions[c],
                    ExcMessage("The component <" + item +
                               "> is both free, in <" + section +
                               "/Free>, and prescribed, in <" + section +
                               "/Motion>."));
        free[c] = true;
      }
  }



  template <int dim>
  void
  RigidBody<dim>::parse_loads(ParameterHandler &prm)
  {
    const auto                    &all = component_names();
    const std::vector<std::string> axes(all.begin(), all.begin() + dim),
      rotations(all.begin() + dim, all.end());
    loads        = parse_component_formulas<dim>(prm.get("Force"),
                                          axes,
                                          section + "/Force",
                                          FormulaVariables::time);
    auto moments = parse_component_formulas<dim>(prm.get("Moment"),
                                                 rotations,
                                                 section + "/Moment",
                                                 FormulaVariables::time);
    for (auto &moment : moments)
      loads.push_back(std::move(moment));
    for (unsigned int c = 0; c < n_components; ++c)
      AssertThrow(!loads[c] || free[c],
                  ExcMessage("The parameter <" + section +
                             (c < dim ? "/Force" : "/Moment") +
                             "> acts along the component <" + all[c] +
                             ">, which isn't free. Name it in <" + section +
                             "/Free>."));
  }



  template <int dim>
  void
  RigidBody<dim>::parse_inertia(ParameterHandler &prm)
  {
    mass               = prm.get_double("Mass");
    const auto moments = Utilities::string_to_double(
      Utilities::split_string_list(prm.get("Moment of inertia")));
    AssertThrow(moments.size() == 1 || moments.size() == n_rotations,
                ExcMessage("The parameter <" + section +
                           "/Moment of inertia> must be one number or " +
                           std::to_string(n_rotations) + "."));
    for (unsigned int r = 0; r < n_rotations; ++r)
      moment_of_inertia[axis(r)] = moments[moments.size() == 1 ? 0 : r];
    const std::string parameter = section + "/Initial velocity";
    const auto        velocities =
      parse_component_formulas<dim>(prm.get("Initial velocity"),
                                    component_names(),
                                    parameter,
                                    FormulaVariables::time);
    for (unsigned int c = 0; c < n_components; ++c)
      {
        AssertThrow(!velocities[c] || free[c],
                    ExcMessage("The parameter <" + parameter + "> names <" +
                               component_names()[c] + ">, which isn't free."));
        initial_velocity[c] = at(velocities[c], 0);
      }
  }



  template <int dim>
  void
  RigidBody<dim>::check_inertia() const
  {
    for (unsigned int c = 0; c < n_components; ++c)
      AssertThrow(!free[c] ||
                    (c < dim ? mass : moment_of_inertia[axis(c - dim)]) > 0,
                  ExcMessage("The parameter <" + section +
                             (c < dim ? "/Mass" : "/Moment of inertia") +
                             "> must be positive in a scene with inertia: the "
                             "component <" +
                             component_names()[c] + "> is free."));
    for (unsigned int r = 0; r < n_rotations; ++r)
      AssertThrow(!motions[dim + r] || !rotation_is_free(),
                  ExcMessage("<" + section + "> has free rotations, <" +
                             section + "/Free>, and prescribed ones, <" +
                             section +
                             "/Motion>. With inertia either all that move are "
                             "free or none."));
  }



  template RigidBody<2>::RigidBody(const std::string &);
  template const std::vector<std::string> &
  RigidBody<2>::component_names();
  template void
  RigidBody<2>::declare_parameters(ParameterHandler &);
  template void
  RigidBody<2>::parse_parameters(ParameterHandler &);
  template std::set<std::string>
  RigidBody<2>::parameters_in_use() const;
  template void
  RigidBody<2>::check_inertia() const;

  template RigidBody<3>::RigidBody(const std::string &);
  template const std::vector<std::string> &
  RigidBody<3>::component_names();
  template void
  RigidBody<3>::declare_parameters(ParameterHandler &);
  template void
  RigidBody<3>::parse_parameters(ParameterHandler &);
  template std::set<std::string>
  RigidBody<3>::parameters_in_use() const;
  template void
  RigidBody<3>::check_inertia() const;
} // namespace isochor
