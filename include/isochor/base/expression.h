/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_expression_h
#define isochor_expression_h

#include <deal.II/base/function_parser.h>

#include <cfenv>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** What a formula may depend on. The rest is fixed where it is evaluated, so
   * that a formula with it can't be meant. */
  enum class FormulaVariables
  {
    space_and_time,
    space, ///< evaluated at t = 0 only
    time   ///< the same at all places
  };

  /** A formula in the coordinates x, y(, z) and the time t, from a parameter
   * file. The constant `pi` is known. */
  template <int dim>
  class Expression
  {
  public:
    /**
     * @p parameter names the origin of @p formula in error messages.
     * @throws ExcMessage if the formula can't be read or depends on other than
     * @p variables.
     */
    Expression(
      const std::string     &formula,
      const std::string     &parameter,
      const FormulaVariables variables = FormulaVariables::space_and_time);

    /** The value at @p x and @p t. @throws ExcMessage if it isn't finite, or
     * compares what isn't a number, as `sqrt(x - 1) < 1` for x = 0. */
    double
    operator()(const Point<dim> &x, const double t) const
    {
      if (is_constant)
        return value_of_constant;
      function->set_time(t);
      if (compares)
        std::feclearexcept(FE_INVALID);
      const double value = function->value(x);
      if (!std::isfinite(value) ||
          (compares && std::fetestexcept(FE_INVALID) != 0))
        throw_not_finite(x, t);
      return value;
    }

    const std::string &
    text() const
    {
      return formula;
    }

  private:
    [[noreturn]] void
    throw_not_finite(const Point<dim> &x, const double t) const;

    std::string formula, parameter;
    /** Whether the formula is a comparison, with nothing that could be meant to
     * exclude where it has no value. */
    bool compares;
    /** Whether the formula has neither a variable nor a function, as most that
     * hold a boundary: the parser isn't asked for each vertex then. */
    bool                                 is_constant       = false;
    double                               value_of_constant = 0;
    std::shared_ptr<FunctionParser<dim>> function;
  };

  /** The number that @p text stands for, which may be a formula without
   * variables ("1/3", "sqrt(2)").
   * @param parameter Where it is from, for messages.
   * @throws ExcMessage if it is none. */
  double
  number_in(const std::string &text, const std::string &parameter);

  /** The names of variables and functions in a formula, in their order. */
  std::vector<std::string>
  names_in_formula(const std::string &formula);

  /** The conditions that a @p formula asks for all at once, joined by '&&',
   * also in parentheses; else the formula itself. Its parentheses match. */
  std::vector<std::string>
  conditions_joined(const std::string &formula);

  /**
   * The items of a list of formulas, trimmed. Separators in parentheses belong
   * to a formula, as the commas of `if(x > 1, 2, 3)`. An empty list has no
   * item. Throws, naming @p parameter, if parentheses don't match.
   */
  std::vector<std::string>
  split_formulas(const std::string &list,
                 const std::string &parameter,
                 const char         separator = ',');

  /**
   * Split "name: text; name: text" into its pairs, in order; semicolons in
   * parentheses and all colons but the first belong to the text. Throws if an
   * item has no colon, naming @p parameter.
   */
  std::vector<std::pair<std::string, std::string>>
  split_named_list(const std::string &list, const std::string &parameter);

  /** The same of a list in which each name stands for something of its own:
   * throws if there are two entries of one name, of which one would be ignored.
   */
  std::vector<std::pair<std::string, std::string>>
  split_list_of_unique_names(const std::string &list,
                             const std::string &parameter);
} // namespace isochor

#endif
