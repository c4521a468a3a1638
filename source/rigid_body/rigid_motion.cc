/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/utilities.h>

#include <isochor/base/component_formulas.h>
#include <isochor/rigid_body/rigid_motion.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  const std::vector<std::string> &
  RigidMotion<dim>::names()
  {
    static const std::vector<std::string> list =
      dim == 2 ? std::vector<std::string>{"x", "y", "rotation"} :
                 std::vector<std::string>{"x", "y", "z", "rx", "ry", "rz"};
    return list;
  }



  template <int dim>
  void
  RigidMotion<dim>::declare_parameters(ParameterHandler &prm)
  {
    const std::string list = Patterns::Tools::to_string(names());
    prm.declare_entry("Motion",
                      "",
                      Patterns::Anything(),
                      "Prescribed components of the motion since t = 0, out "
                      "of " +
                        list +
                        ": displacements (m) of the reference point and the "
                        "rotation (2D) or rotation vector (3D; rad), as "
                        "formulas in t: 'y=-0.1*t'. Components that neither "
                        "this nor 'Free' names are fixed.");
    prm.declare_entry("Free",
                      "",
                      Patterns::Anything(),
                      "The components, out of " + list +
                        ", that follow from the forces on the rigid body: "
                        "'x, y'.");
    prm.declare_entry("Force",
                      "",
                      Patterns::Anything(),
                      "The force (N) at the reference point along free "
                      "components, as formulas in t: 'y=-1000'. Also the "
                      "weight. Per m of thickness in 2D, of the whole "
                      "circumference in an axisymmetric geometry.");
    prm.declare_entry("Moment",
                      "",
                      Patterns::Anything(),
                      dim == 2 ?
                        "The moment (N m) about the reference point on a free "
                        "rotation, a formula in t: 'rotation=10*t'." :
                        "The moment (N m) about the reference point and fixed "
                        "axes, formulas in t: 'rz=10*t'.");
  }



  template <int dim>
  void
  RigidMotion<dim>::parse_parameters(ParameterHandler  &prm,
                                     const std::string &section)
  {
    motions = parse_component_formulas<dim>(prm.get("Motion"),
                                            names(),
                                            section + "/Motion",
                                            FormulaVariables::time);
    parse_free(prm.get("Free"), section);
    parse_loads(prm, section);
  }



  template <int dim>
  void
  RigidMotion<dim>::parse_free(const std::string &list,
                               const std::string &section)
  {
    for (const std::string &item : Utilities::split_string_list(list))
      {
        const auto name = std::find(names().begin(), names().end(), item);
        AssertThrow(name != names().end(),
                    ExcMessage("<" + item + "> in the parameter <" + section +
                               "/Free> is no component: these are " +
                               Patterns::Tools::to_string(names()) + "."));
        const unsigned int c = name - names().begin();
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
  RigidMotion<dim>::parse_loads(ParameterHandler  &prm,
                                const std::string &section)
  {
    const std::vector<std::string> axes(names().begin(), names().begin() + dim),
      rotations(names().begin() + dim, names().end());
    forces       = parse_component_formulas<dim>(prm.get("Force"),
                                           axes,
                                           section + "/Force",
                                           FormulaVariables::time);
    auto moments = parse_component_formulas<dim>(prm.get("Moment"),
                                                 rotations,
                                                 section + "/Moment",
                                                 FormulaVariables::time);
    for (auto &moment : moments)
      forces.push_back(std::move(moment));
    for (unsigned int c = 0; c < Components::n; ++c)
      AssertThrow(!forces[c] || free[c],
                  ExcMessage("The parameter <" + section +
                             (c < dim ? "/Force" : "/Moment") +
                             "> acts along the component <" + names()[c] +
                             ">, which isn't free. Name it in <" + section +
                             "/Free>."));
  }



  template <int dim>
  bool
  RigidMotion<dim>::has_free_components() const
  {
    return std::count(free.begin(), free.end(), true) > 0;
  }



  template <int dim>
  bool
  RigidMotion<dim>::has_free_rotations() const
  {
    return std::count(free.begin() + dim, free.end(), true) > 0;
  }



  template <int dim>
  bool
  RigidMotion<dim>::has_prescribed_rotations() const
  {
    return std::any_of(motions.begin() + dim,
                       motions.end(),
                       [](const auto &formula) { return bool(formula); });
  }



  template <int dim>
  typename RigidMotion<dim>::Values
  RigidMotion<dim>::values(const Formulas &formulas, const double time)
  {
    Values result{};
    for (unsigned int c = 0; c < Components::n; ++c)
      if (formulas[c])
        result[c] = (*formulas[c])(Point<dim>(), time);
    return result;
  }



  template <int dim>
  typename RigidMotion<dim>::Values
  RigidMotion<dim>::prescribed(const double time) const
  {
    return values(motions, time);
  }



  template <int dim>
  typename RigidMotion<dim>::Values
  RigidMotion<dim>::at_end(const double time) const
  {
    if (trial.size == 0)
      return prescribed(time);
    Values result{};
    for (unsigned int c = 0; c < Components::n; ++c)
      if (motions[c])
        result[c] = trial.at_end(
          [&](const double t) { return (*motions[c])(Point<dim>(), t); });
    return result;
  }



  template <int dim>
  typename RigidMotion<dim>::Values
  RigidMotion<dim>::loads(const double time) const
  {
    return values(forces, time);
  }



  template class RigidMotion<2>;
  template class RigidMotion<3>;
} // namespace isochor
