/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/condition.h>
#include <isochor/base/explanation.h>
#include <isochor/base/expression.h>
#include <isochor/base/plain_message.h>

#include <algorithm>

namespace isochor
{
  bool
  compares_nothing(const std::string &formula)
  {
    const auto names = names_in_formula(formula);
    return !names.empty() &&
           std::find(names.begin(), names.end(), "if") == names.end() &&
           formula.find_first_of("<>=!&|?") == std::string::npos;
  }



  void
  warn_of_formula_for_condition(const std::string         &formula,
                                const std::string         &parameter,
                                const std::vector<double> &values,
                                Warnings                  &warnings)
  {
    if (values.empty() || !compares_nothing(formula))
      return;
    const auto range = std::minmax_element(values.begin(), values.end());
    const bool is_truth =
      std::all_of(values.begin(), values.end(), [](const double value) {
        return value == 0 || value == 1;
      });
    const std::size_t n_above =
      std::count_if(values.begin(), values.end(), [](const double value) {
        return value > 0;
      });
    if (*range.first < 0 || is_truth || 2 * n_above < values.size())
      return;
    warnings.add("a condition that compares nothing",
                 "<" + formula + "> of <" + parameter +
                   "> holds where it is above 0, which it is in " +
                   rounded(100. * n_above / values.size()) +
                   " % of the places in question, with values from " +
                   rounded(*range.first) + " to " + rounded(*range.second) +
                   ". Write a comparison, as 'y < 0.5', or '1'.");
  }



  ISOCHOR_EXPLAIN(
    compares_nothing,
    "a condition that compares nothing",
    ISOCHOR_ESSENTIAL,
    "`Material points/Region`, a zone of `Materials in zones` or `Points "
    "per cell in zones`, or a place of `Surfaces of body` is a formula "
    "without a comparison (no `<`, `>`, `==`, `&&`, `\\|\\|`, `if`) that is"
    " nowhere below 0 and above 0 at most places, with other values than 0 "
    "and 1, as `y` where y > 0: it holds nearly everywhere. The region is "
    "looked at in the middle of the cells of the grid, zones in those of "
    "the body, surfaces at the vertices of these cells",
    "a comparison, such as `y < 0.5`, a formula that is below 0 elsewhere, "
    "or `1`")
} // namespace isochor
