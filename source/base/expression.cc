/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <isochor/base/expression.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** muParser takes letters for parts of an operator, and deal.II defines &
     * and | beside its && and ||: without blanks it reads `&&y` as & and `&y`.
     */
    std::string
    with_blanks_at_operators(const std::string &formula)
    {
      std::string result;
      for (std::size_t i = 0; i < formula.size(); ++i)
        {
          const char c = formula[i];
          if (c != '&' && c != '|')
            {
              result += c;
              continue;
            }
          const bool twice = i + 1 < formula.size() && formula[i + 1] == c;
          result += " " + std::string(twice ? 2 : 1, c) + " ";
          i += twice;
        }
      return result;
    }



    void
    check_formula(const bool         ok,
                  const std::string &formula,
                  const std::string &parameter,
                  const std::string &remedy)
    {
      AssertThrow(ok,
                  ExcMessage("The formula <" + formula +
                             "> of the parameter <" + parameter +
                             ">: " + remedy));
    }



    /** Throw for words that other languages have for operators. */
    void
    check_words(const std::string &formula, const std::string &parameter)
    {
      for (const std::string &name : names_in_formula(formula))
        {
          std::string word = name;
          std::transform(word.begin(), word.end(), word.begin(), [](char c) {
            return static_cast<char>(std::tolower(c));
          });
          check_formula(word != "and" && word != "or",
                        formula,
                        parameter,
                        "write '" + std::string(word == "and" ? "&&" : "||") +
                          "' instead of '" + name + "'.");
          check_formula(word != "not",
                        formula,
                        parameter,
                        "there is no '" + name +
                          "': write the opposite comparison, or '(...) == 0'.");
        }
    }



    /** For the place of a `=` that assigns: what it may be instead. */
    std::string
    remedy_of_assignment(const std::string &formula, const std::size_t equals)
    {
      // "0 y": a component that begins where a comma is missing
      const std::string before = Utilities::trim(formula.substr(0, equals));
      const auto        blank  = before.find_last_of(" \t");
      if (blank != std::string::npos &&
          std::isalpha(static_cast<unsigned char>(before[blank + 1])))
        return "a comma is missing before <" + before.substr(blank + 1) +
               " =...>, if that is to be another component. ('=' assigns; two "
               "values are compared by '=='.)";
      return "'=' assigns; two values are compared by '==', or, as coordinates "
             "are rounded, by abs(a - b) < 1e-6.";
    }



    /** Throw for what muParser takes without a word, but not as it is meant:
     * `=` assigns, `a < b < c` compares the truth of `a < b` with c, and of
     * `a, b` only b is left. */
    void
    check_comparisons(const std::string &formula, const std::string &parameter)
    {
      const auto is_one_of = [](const char c, const std::string &characters) {
        return characters.find(c) != std::string::npos;
      };
      const auto check = [&](const bool ok, const std::string &remedy) {
        check_formula(ok, formula, parameter, remedy);
      };
      // whether something is compared already, for each open parenthesis
      std::vector<bool> compared(1, false);
      for (std::size_t i = 0; i < formula.size(); ++i)
        {
          const char c    = formula[i];
          const char next = i + 1 < formula.size() ? formula[i + 1] : ' ';
          if (c == '(')
            compared.push_back(false);
          else if (c == ')' && compared.size() > 1)
            compared.pop_back();
          else if (c == ';' || (c == ',' && compared.size() == 1))
            check(false,
                  std::string("one formula is asked for, but '") + c +
                    "' separates several; write '&&' between conditions that "
                    "shall hold together, '||' between alternatives.");
          else if (is_one_of(c, "&|,?:"))
            compared.back() = false;
          else if (is_one_of(c, "=!<>") && next == '=')
            ++i;
          else
            check(c != '=', c == '=' ? remedy_of_assignment(formula, i) : "");
          if (is_one_of(c, "<>"))
            {
              check(!compared.back(),
                    "'a < b < c' means '(a < b) < c'; write 'a < b && b < c'.");
              compared.back() = true;
            }
        }
    }



    /** For a formula that muParser can't read: what other languages allow in
     * it, or nothing. */
    std::string
    hint_of_unread(const std::string &formula)
    {
      if (formula.find("**") != std::string::npos)
        return " Powers are written a^b, not a**b.";
      for (const std::string &name : names_in_formula(formula))
        if (name == "time" || name == "T")
          return " The time is t, not " + name + ".";
      if (std::count(formula.begin(), formula.end(), '|') >= 2 &&
          formula.find("||") == std::string::npos)
        return " An absolute value is abs(a), not |a|.";
      const std::regex name_or_number(
        R"([A-Za-z_]\w*|(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)");
      for (auto word = std::sregex_iterator(formula.begin(),
                                            formula.end(),
                                            name_or_number);
           word != std::sregex_iterator();
           ++word)
        {
          const std::string behind = word->suffix().str();
          if (!(*word)[1].matched || behind.empty())
            continue; // a name
          if (behind[0] == '(' || behind[0] == '_' ||
              std::isalpha(static_cast<unsigned char>(behind[0])))
            return " A product needs a sign: 2*t, not 2t.";
        }
      return "";
    }



    /** Throw if the formula depends on what it must not. */
    template <int dim>
    void
    check_variables(const std::string     &formula,
                    const std::string     &parameter,
                    const FormulaVariables variables)
    {
      if (variables == FormulaVariables::space_and_time)
        return;
      const bool        in_time = variables == FormulaVariables::time;
      const std::string space   = FunctionParser<dim>::default_variable_names();
      const std::vector<std::string> coordinates =
        Utilities::split_string_list(space);
      for (const std::string &name : names_in_formula(formula))
        {
          const bool is_coordinate =
            std::find(coordinates.begin(), coordinates.end(), name) !=
            coordinates.end();
          AssertThrow(!(in_time ? is_coordinate : name == "t"),
                      ExcMessage(
                        "The formula <" + formula + "> of the parameter <" +
                        parameter + "> depends on " + name +
                        ", but it is evaluated " +
                        (in_time ? "for all places at once" : "at t = 0 only") +
                        ": it may depend on " + (in_time ? "t" : space) + "."));
        }
    }
  } // namespace



  template <int dim>
  Expression<dim>::Expression(const std::string     &formula,
                              const std::string     &parameter,
                              const FormulaVariables variables)
    : formula(formula)
    , parameter(parameter)
    , compares(formula.find_first_of("<>") != std::string::npos &&
               formula.find_first_of("&|?") == std::string::npos &&
               formula.find("if") == std::string::npos)
    , function(std::make_shared<FunctionParser<dim>>(1))
  {
    check_words(formula, parameter);
    check_comparisons(formula, parameter);
    const std::string space = FunctionParser<dim>::default_variable_names();
    try
      {
        function->initialize(space + ",t",
                             with_blanks_at_operators(formula),
                             {{"pi", numbers::PI}},
                             true);
        function->set_time(0.);
        value_of_constant = function->value(Point<dim>());
      }
    catch (const std::exception &)
      {
        AssertThrow(false,
                    ExcMessage(
                      "The formula <" + formula + "> of the parameter <" +
                      parameter + "> can't be read." + hint_of_unread(formula) +
                      " Allowed are the variables " +
                      (variables == FormulaVariables::time ?
                         "t" :
                         space +
                           (variables == FormulaVariables::space ? "" : ",t")) +
                      ", the constant pi and the usual mathematical "
                      "functions."));
      }
    check_variables<dim>(formula, parameter, variables);
    const auto names = names_in_formula(formula);
    is_constant      = std::isfinite(value_of_constant) &&
                  std::all_of(names.begin(), names.end(), [](const auto &name) {
                    return name == "pi";
                  });
  }



  template <int dim>
  void
  Expression<dim>::throw_not_finite(const Point<dim> &x, const double t) const
  {
    std::ostringstream place;
    place << '(' << x << "), t = " << t;
    AssertThrow(false,
                ExcMessage("The formula <" + formula + "> of the parameter <" +
                           parameter + "> has no finite value at " +
                           place.str() + "."));
    std::abort();
  }



  double
  number_in(const std::string &text, const std::string &parameter)
  {
    const auto names = names_in_formula(text);
    AssertThrow(std::find(names.begin(), names.end(), "t") == names.end(),
                ExcMessage("The parameter <" + parameter +
                           "> needs a number, not <" + text + ">."));
    return Expression<1>(text, parameter, FormulaVariables::time)(Point<1>(),
                                                                  0.);
  }



  namespace
  {
    /** Whether the first parenthesis ends with @p text. */
    bool
    is_in_parentheses(const std::string &text)
    {
      int depth = 0;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          depth += (text[i] == '(') - (text[i] == ')');
          if (depth == 0)
            return i > 0 && i + 1 == text.size();
        }
      return false;
    }
  } // namespace



  std::vector<std::string>
  conditions_joined(const std::string &formula)
  {
    if (is_in_parentheses(formula))
      return conditions_joined(
        Utilities::trim(formula.substr(1, formula.size() - 2)));
    const auto items = split_formulas(formula, "", '&');
    if (items.size() == 1 || split_formulas(formula, "", '|').size() > 1 ||
        split_formulas(formula, "", '?').size() > 1)
      return {formula};
    std::vector<std::string> conditions;
    for (const std::string &item : items)
      if (!item.empty()) // between the signs of &&
        for (const std::string &condition : conditions_joined(item))
          // as what is joined by it, any number but zero holds
          conditions.push_back("(" + condition + ") && 1");
    return conditions;
  }



  std::vector<std::string>
  names_in_formula(const std::string &formula)
  {
    const auto is_letter = [](const char c) {
      return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
    };
    const auto is_digit = [](const char c) {
      return std::isdigit(static_cast<unsigned char>(c)) || c == '.';
    };
    std::vector<std::string> names;
    for (std::size_t i = 0; i < formula.size();)
      if (is_letter(formula[i]))
        {
          names.emplace_back();
          for (; i < formula.size() &&
                 (is_letter(formula[i]) || is_digit(formula[i]));
               ++i)
            names.back() += formula[i];
        }
      else if (is_digit(formula[i]))
        {
          // a number, whose exponent is no name
          while (i < formula.size() && is_digit(formula[i]))
            ++i;
          if (i + 1 < formula.size() && std::tolower(formula[i]) == 'e' &&
              (is_digit(formula[i + 1]) || formula[i + 1] == '-' ||
               formula[i + 1] == '+'))
            i += 2;
        }
      else
        ++i;
    return names;
  }



  std::vector<std::string>
  split_formulas(const std::string &list,
                 const std::string &parameter,
                 const char         separator)
  {
    std::vector<std::string> items(1);
    int                      depth = 0;
    for (const char c : list)
      {
        depth += (c == '(') - (c == ')');
        if (depth < 0)
          break;
        if (c == separator && depth == 0)
          items.emplace_back();
        else
          items.back() += c;
      }
    AssertThrow(depth == 0,
                ExcMessage("The parentheses in <" + list +
                           "> of the parameter <" + parameter +
                           "> don't match."));
    for (std::string &item : items)
      item = Utilities::trim(item);
    // a separator at the end ends nothing more
    if (items.back().empty())
      items.pop_back();
    return items;
  }



  std::vector<std::pair<std::string, std::string>>
  split_named_list(const std::string &list, const std::string &parameter)
  {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const std::string &item : split_formulas(list, parameter, ';'))
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



  std::vector<std::pair<std::string, std::string>>
  split_list_of_unique_names(const std::string &list,
                             const std::string &parameter)
  {
    const auto            pairs = split_named_list(list, parameter);
    std::set<std::string> names;
    for (const auto &entry : pairs)
      AssertThrow(names.insert(entry.first).second,
                  ExcMessage("The parameter <" + parameter + "> names <" +
                             entry.first + "> twice."));
    return pairs;
  }



  template class Expression<1>;
  template class Expression<2>;
  template class Expression<3>;
} // namespace isochor
