/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/prescribed_place.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  PrescribedPlace<dim>::PrescribedPlace(const std::string &displacement,
                                        const std::string &parameter)
  {
    const std::string axes = std::string("xyz").substr(0, dim);
    for (const std::string &item : split_formulas(displacement, parameter))
      {
        const std::size_t equals = item.find('=');
        const std::string axis   = equals == std::string::npos ?
                                     "" :
                                     Utilities::trim(item.substr(0, equals));
        AssertThrow(axis.size() == 1 && axes.find(axis) != std::string::npos,
                    ExcMessage("<" + item + "> in the parameter <" + parameter +
                               "> must be a component with its formula, such "
                               "as 'x=0' or 'y=-0.1*t'."));
        auto &component = components[axes.find(axis)];
        AssertThrow(component.empty(),
                    ExcMessage("The parameter <" + parameter +
                               "> has two formulas for the component " + axis +
                               "."));
        component.emplace_back(item.substr(equals + 1), parameter);
      }
    AssertThrow(std::any_of(components.begin(),
                            components.end(),
                            [](const auto &one) { return !one.empty(); }),
                ExcMessage("The parameter <" + parameter +
                           "> must say where the surface goes, such as 'x=0, "
                           "y=-0.1*t'."));
  }



  template <int dim>
  PartnerPlace<dim>
  PrescribedPlace<dim>::original(
    const typename Partner<dim>::SurfacePlace &place) const
  {
    PartnerPlace<dim> result;
    result.mask = 0;
    for (unsigned int a = 0; a < dim; ++a)
      if (!components[a].empty())
        {
          result.mask[a][a]       = 1;
          result.gap_by_x[a][a]   = 1;
          const auto displacement = [&](const double t) {
            return components[a].front()(place.start->X, t);
          };
          result.gap[a] =
            place.start->displacement[a] + place.increment[a] -
            (trial.size == 0 ? displacement(time) : trial.at_end(displacement));
        }
    return result;
  }



  template <int dim>
  void
  PrescribedPlace<dim>::append_motions(
    std::vector<Expression<dim>> &motions) const
  {
    for (const auto &component : components)
      motions.insert(motions.end(), component.begin(), component.end());
  }



  template class PrescribedPlace<2>;
  template class PrescribedPlace<3>;
} // namespace isochor
