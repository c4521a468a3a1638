/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/utilities.h>

#include <isochor/base/expression.h>
#include <isochor/base/formula_switches.h>

#include <algorithm>
#include <cctype>

namespace isochor
{
  namespace
  {
    bool
    contains(const std::string &formula, const std::string &name)
    {
      const auto names = names_in_formula(formula);
      return std::find(names.begin(), names.end(), name) != names.end();
    }



    /** The end of the operand of a comparison in @p formula that begins next to
     * @p i and goes on in the @p direction 1 or -1. */
    std::size_t
    end_of_operand(const std::string &formula,
                   std::size_t        i,
                   const int          direction)
    {
      const char open   = direction > 0 ? '(' : ')',
                 closed = direction > 0 ? ')' : '(';
      int depth         = 0;
      for (; i < formula.size(); i += direction) // -1 is beyond the size, too
        {
          const char c = formula[i];
          if (depth == 0 && (c == closed ||
                             std::string(",&|?:").find(c) != std::string::npos))
            break;
          depth += (c == open) - (c == closed);
        }
      return i;
    }



    std::string
    difference(const std::string &a, const std::string &b)
    {
      return "(" + Utilities::trim(a) + ") - (" + Utilities::trim(b) + ")";
    }



    /** The differences of all that is compared in @p formula. */
    void
    append_comparisons(const std::string        &formula,
                       std::vector<std::string> &switches)
    {
      for (std::size_t i = 0; i < formula.size(); ++i)
        if (std::string("<>=!").find(formula[i]) != std::string::npos)
          {
            const std::size_t length =
              i + 1 < formula.size() && formula[i + 1] == '=' ? 2 : 1;
            const std::size_t left  = end_of_operand(formula, i - 1, -1) + 1;
            const std::size_t right = end_of_operand(formula, i + length, 1);
            switches.push_back(
              difference(formula.substr(left, i - left),
                         formula.substr(i + length, right - i - length)));
            i += length - 1;
          }
    }



    /** Those of the arguments of min(), max() and abs(). */
    void
    append_arguments(const std::string        &formula,
                     std::vector<std::string> &switches)
    {
      for (std::size_t i = 0; i + 3 < formula.size(); ++i)
        {
          const std::string name = formula.substr(i, 3);
          if ((name != "min" && name != "max" && name != "abs") ||
              (i > 0 &&
               std::isalnum(static_cast<unsigned char>(formula[i - 1]))))
            continue;
          const std::size_t open = formula.find_first_not_of(' ', i + 3);
          if (open == std::string::npos || formula[open] != '(')
            continue;
          std::size_t close = open + 1;
          for (int depth = 1; depth > 0; ++close)
            depth += (formula[close] == '(') - (formula[close] == ')');
          const auto arguments =
            split_formulas(formula.substr(open + 1, close - open - 2), "");
          if (name == "abs")
            switches.push_back(arguments.front());
          for (std::size_t a = 0; a < arguments.size(); ++a)
            for (std::size_t b = a + 1; b < arguments.size(); ++b)
              switches.push_back(difference(arguments[a], arguments[b]));
        }
    }
  } // namespace



  bool
  is_of_time(const std::string &formula)
  {
    return contains(formula, "t");
  }



  std::vector<std::string>
  switches_in_time(const std::string &formula)
  {
    std::vector<std::string> switches;
    append_comparisons(formula, switches);
    append_arguments(formula, switches);
    switches.erase(std::remove_if(switches.begin(),
                                  switches.end(),
                                  [](const std::string &one) {
                                    return !is_of_time(one) ||
                                           contains(one, "x") ||
                                           contains(one, "y") ||
                                           contains(one, "z");
                                  }),
                   switches.end());
    std::sort(switches.begin(), switches.end());
    switches.erase(std::unique(switches.begin(), switches.end()),
                   switches.end());
    return switches;
  }
} // namespace isochor
