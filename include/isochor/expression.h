/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_expression_h
#define isochor_expression_h

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** A formula in the coordinates x, y(, z) and the time t, from a parameter
   * file. The constant `pi` is known. */
  template <int dim>
  class Expression
  {
  public:
    /** @p parameter names the origin of @p formula in error messages. */
    Expression(const std::string &formula, const std::string &parameter)
      : function(std::make_shared<FunctionParser<dim>>(1))
    {
      try
        {
          function->initialize(FunctionParser<dim>::default_variable_names() +
                                 ",t",
                               formula,
                               {{"pi", numbers::PI}},
                               true);
          function->set_time(0.);
          function->value(Point<dim>());
        }
      catch (const std::exception &)
        {
          AssertThrow(false,
                      ExcMessage("The formula <" + formula +
                                 "> of the parameter <" + parameter +
                                 "> can't be read. Allowed are the variables " +
                                 FunctionParser<dim>::default_variable_names() +
                                 ",t, the constant pi and the usual "
                                 "mathematical functions."));
        }
    }

    double
    operator()(const Point<dim> &x, const double t) const
    {
      function->set_time(t);
      return function->value(x);
    }

  private:
    std::shared_ptr<FunctionParser<dim>> function;
  };

  /**
   * Split "name: text; name: text" into its pairs, in order. Throws if an item
   * has no colon, naming @p parameter.
   */
  inline std::vector<std::pair<std::string, std::string>>
  split_named_list(const std::string &list, const std::string &parameter)
  {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const std::string &item : Utilities::split_string_list(list, ';'))
      {
        if (item.empty())
          continue;
        const auto colon = item.find(':');
        AssertThrow(colon != std::string::npos,
                    ExcMessage("The entry <" + item + "> of the parameter <" +
                               parameter +
                               "> must have the form <name: value>."));
        pairs.emplace_back(Utilities::trim(item.substr(0, colon)),
                           Utilities::trim(item.substr(colon + 1)));
      }
    return pairs;
  }
} // namespace isochor

#endif
