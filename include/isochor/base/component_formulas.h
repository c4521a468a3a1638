/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_component_formulas_h
#define isochor_component_formulas_h

#include <isochor/base/expression.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * The formulas of a list "x = 0, y = -0.1*t", in the order of the @p names of
   * the components; null where there is none.
   * @param parameter Where the list is from, for messages.
   * @throws ExcMessage for items of another form, unknown names and components
   * that are named twice.
   */
  template <int dim>
  std::vector<std::unique_ptr<Expression<dim>>>
  parse_component_formulas(const std::string              &list,
                           const std::vector<std::string> &names,
                           const std::string              &parameter,
                           const FormulaVariables          variables)
  {
    std::vector<std::unique_ptr<Expression<dim>>> formulas(names.size());
    for (const std::string &item : split_formulas(list, parameter))
      {
        const std::size_t equals = item.find('=');
        const auto        name   = equals == std::string::npos ?
                                     names.end() :
                                     std::find(names.begin(),
                                      names.end(),
                                      Utilities::trim(item.substr(0, equals)));
        std::string       known;
        for (const std::string &one : names)
          known += (known.empty() ? "" : ", ") + one;
        AssertThrow(name != names.end(),
                    ExcMessage("The entry <" + item + "> of the parameter <" +
                               parameter +
                               "> must have the form <name = formula> with a "
                               "name out of " +
                               known + "."));
        auto &formula = formulas[name - names.begin()];
        AssertThrow(!formula,
                    ExcMessage("The parameter <" + parameter + "> names <" +
                               *name + "> twice."));
        formula = std::make_unique<Expression<dim>>(item.substr(equals + 1),
                                                    parameter,
                                                    variables);
      }
    return formulas;
  }
} // namespace isochor

#endif
