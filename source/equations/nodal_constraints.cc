/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/exceptions.h>

#include <isochor/base/rounding.h>
#include <isochor/equations/constraint_conflicts.h>
#include <isochor/equations/nodal_constraints.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isochor
{
  void
  Followers::clear()
  {
    entry.clear();
    start.assign(1, 0);
    master.clear();
    weight.clear();
    value.clear();
    flags.clear();
  }



  void
  NodalConstraints::reinit(const unsigned int               n_entries,
                           const std::vector<unsigned int> &control)
  {
    Assert(std::all_of(control.begin(),
                       control.end(),
                       [&](const unsigned int i) { return i < n_entries; }),
           ExcInternalError());
    is_control.clear();
    if (!control.empty())
      is_control.assign(n_entries, 0);
    for (const unsigned int i : control)
      is_control[i] = 1;
    constrained.assign(n_entries, is_free);
    increment.assign(n_entries, 0.);
    ties.clear();
    equations.clear();
    entry.clear();
    coefficient.clear();
    followers.clear();
    conflicts.clear();
    source.clear();
    sources.clear();
    source_of_equation.clear();
    source_of_entry.clear();
  }



  unsigned int
  NodalConstraints::source_number()
  {
    if (sources.empty() || sources.back() != source)
      sources.push_back(source);
    return sources.size() - 1;
  }



  void
  NodalConstraints::constrain(const unsigned int i, const double value)
  {
    AssertIndexRange(i, constrained.size());
    AssertDimension(increment.size(), constrained.size());
    const unsigned int number = source_number();
    if (number > 0)
      {
        // what has been prescribed before is somebody else's
        source_of_entry.resize(constrained.size(), 0);
        const double difference = std::abs(value - increment[i]);
        if (constrained[i] != is_free && source_of_entry[i] != number &&
            difference > 1e-10 * (std::abs(value) + std::abs(increment[i])))
          conflicts.push_back(
            {i, source, sources[source_of_entry[i]], difference, true});
        source_of_entry[i] = number;
      }
    constrained[i] = prescribed;
    increment[i]   = value;
  }



  NodalConstraints::Equation &
  NodalConstraints::add(
    const Precedence                                    precedence,
    const std::vector<std::pair<unsigned int, double>> &terms,
    const double                                        value)
  {
    Assert(std::all_of(terms.begin(),
                       terms.end(),
                       [&](const auto &term) {
                         return term.first < constrained.size();
                       }),
           ExcMessage("The equation has an unknown that is not active."));
    Equation equation;
    equation.precedence = precedence;
    equation.first      = entry.size();
    equation.last       = entry.size() + terms.size();
    equation.value      = value;
    for (const auto &term : terms)
      {
        entry.push_back(term.first);
        coefficient.push_back(term.second);
      }
    equations.push_back(equation);
    source_of_equation.push_back(source_number());
    return equations.back();
  }



  void
  NodalConstraints::resolve(const unsigned int n_components)
  {
    Assert(n_components > 0, ExcInternalError());
    AssertDimension(constrained.size() % n_components, 0u);
    AssertDimension(increment.size(), constrained.size());
    AssertDimension(coefficient.size(), entry.size());
    AssertDimension(ties.start.size(), ties.size() + 1);
    AssertDimension(ties.weight.size(), ties.master.size());
    for (unsigned char &how : constrained)
      if (how == follows)
        how = is_free;
    followers.clear();
    equation_of_follower.clear();
    if (!equations.empty())
      {
        place.assign(constrained.size(), none);
        std::vector<unsigned int> order(equations.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(),
                         order.end(),
                         [this](const unsigned int k, const unsigned int l) {
                           return equations[k].precedence <
                                  equations[l].precedence;
                         });
        for (const unsigned int k : order)
          eliminate(equations[k], k);
      }
    for (unsigned int k = 0; k < ties.size(); ++k)
      eliminate_tie(k, n_components);
    if (!equations.empty())
      resolve_chains();
  }



  void
  NodalConstraints::add_to_row(const unsigned int i, const double value)
  {
    for (auto &term : row)
      if (term.first == i)
        {
          term.second += value;
          return;
        }
    row.emplace_back(i, value);
  }



  void
  NodalConstraints::substitute()
  {
    for (unsigned int i = 0; i < row.size();)
      {
        const auto [e, a]    = row[i];
        const unsigned int k = place[e];
        if (k == none)
          {
            ++i;
            continue;
          }
        row.erase(row.begin() + i);
        for (std::size_t j = followers.start[k]; j < followers.start[k + 1];
             ++j)
          add_to_row(followers.master[j], a * followers.weight[j]);
        row_value -= a * followers.value[k];
        i = 0;
      }
  }



  void
  NodalConstraints::set_row(const Equation &equation)
  {
    Assert(equation.first <= equation.last, ExcInternalError());
    AssertIndexRange(equation.last, entry.size() + 1);
    row.clear();
    row_value = equation.value;
    for (std::size_t i = equation.first; i < equation.last; ++i)
      add_to_row(entry[i], coefficient[i]);
    substitute();
  }



  unsigned int
  NodalConstraints::find_pivot(const Equation &equation) const
  {
    Assert(equation.first + equation.n_pivots <= equation.last,
           ExcInternalError());
    constexpr double small = 1e-3;
    double           size  = 0;
    for (std::size_t i = equation.first; i < equation.last; ++i)
      size = std::max(size, std::abs(coefficient[i]));
    const auto allowed = [&](const unsigned int e) {
      const auto begin = entry.begin() + equation.first;
      const auto end   = begin + equation.n_pivots;
      return constrained[e] == is_free &&
             (equation.n_pivots == 0 || std::find(begin, end, e) != end);
    };
    const auto largest_of = [&](const bool control, const double least) {
      const auto candidate = [&](const unsigned int e) {
        return allowed(e) && is_of_control_node(e) == control;
      };
      double largest = 0;
      for (const auto &[e, a] : row)
        if (candidate(e))
          largest = std::max(largest, std::abs(a));
      for (unsigned int i = 0; i < row.size() && largest > least * size; ++i)
        if (candidate(row[i].first) &&
            std::abs(row[i].second) >= (1 - rounding::places) * largest)
          return i;
      return none;
    };
    unsigned int i = largest_of(false, small);
    if (i == none)
      i = largest_of(true, rounding::accumulated);
    return i != none ? i : largest_of(false, rounding::accumulated);
  }



  void
  NodalConstraints::check_pivot(const Equation    &equation,
                                const unsigned int number) const
  {
    AssertIndexRange(number, source_of_equation.size());
    using namespace dealii;
    const auto begin = entry.begin() + equation.first,
               end   = begin + equation.n_pivots;
    AssertThrow(!is_of_control_node(equation.pivot) || equation.known_to_all ||
                  std::find(begin, end, equation.pivot) != end,
                ExcMessage(
                  "<" + parameter_of(sources[source_of_equation[number]]) +
                  "> meets nodes of which other conditions determine all, so "
                  "that it would determine a jump between periodic sides. "
                  "Prescribe that jump, or leave these nodes out of the other "
                  "condition."));
  }



  void
  NodalConstraints::eliminate(Equation &equation, const unsigned int number)
  {
    set_row(equation);
    const unsigned int i = find_pivot(equation);
    equation.pivot       = (i == none ? none : row[i].first);
    if (i == none)
      {
        // what others hold must be what this one asks for
        note_lost(equation, number);
        return;
      }
    check_pivot(equation, number);
    const double a = row[i].second;
    row.erase(row.begin() + i);
    for (auto &term : row)
      term.second /= -a;
    append_follower(equation.pivot, 0, row_value / a);
    equation_of_follower.push_back(number);
  }



  void
  NodalConstraints::append_follower(const unsigned int  e,
                                    const unsigned char flags,
                                    const double        value)
  {
    AssertIndexRange(e, constrained.size());
    if (!equations.empty())
      place[e] = followers.size();
    constrained[e] = follows;
    followers.entry.push_back(e);
    followers.flags.push_back(flags);
    followers.value.push_back(value);
    for (const auto &[master, weight] : row)
      {
        followers.master.push_back(master);
        followers.weight.push_back(weight);
      }
    followers.start.push_back(followers.master.size());
  }



  void
  NodalConstraints::eliminate_tie(const unsigned int k,
                                  const unsigned int n_components)
  {
    AssertIndexRange(k, ties.size());
    for (unsigned int a = 0; a < n_components; ++a)
      {
        const unsigned int e = ties.node[k] * n_components + a;
        if (constrained[e] != is_free)
          continue;
        row.clear();
        row_value = 0;
        for (std::size_t i = ties.start[k]; i < ties.start[k + 1]; ++i)
          row.emplace_back(ties.master[i] * n_components + a, ties.weight[i]);
        if (!equations.empty())
          {
            substitute();
            // a wall at a master may lead back to the tied node: it stays free
            if (std::any_of(row.begin(), row.end(), [e](const auto &term) {
                  return term.first == e;
                }))
              continue;
          }
        append_follower(e, Followers::is_tie, -row_value);
        equation_of_follower.push_back(none);
      }
  }



  void
  NodalConstraints::resolve_chains()
  {
    const Followers found = followers;
    // who depends on others was found before them
    std::vector<std::vector<std::pair<unsigned int, double>>> masters(
      found.size());
    for (unsigned int k = found.size(); k-- > 0;)
      {
        row.clear();
        row_value = 0;
        for (std::size_t i = found.start[k]; i < found.start[k + 1]; ++i)
          {
            const unsigned int l = place[found.master[i]];
            const double       w = found.weight[i];
            if (l == none)
              {
                add_to_row(found.master[i], w);
                continue;
              }
            for (const auto &[master, weight] : masters[l])
              add_to_row(master, w * weight);
            row_value += w * followers.value[l];
          }
        masters[k] = row;
        followers.value[k] += row_value;
      }
    followers.start.assign(1, 0);
    followers.master.clear();
    followers.weight.clear();
    for (const auto &of_follower : masters)
      {
        for (const auto &[master, weight] : of_follower)
          {
            followers.master.push_back(master);
            followers.weight.push_back(weight);
          }
        followers.start.push_back(followers.master.size());
      }
  }



  void
  NodalConstraints::note_lost(const Equation    &equation,
                              const unsigned int number)
  {
    AssertIndexRange(number, source_of_equation.size());
    // what is left of the equation, where all of its unknowns are given
    double size = 0, rest = row_value, scale = std::abs(equation.value);
    bool   known = true;
    for (std::size_t i = equation.first; i < equation.last; ++i)
      size = std::max(size, std::abs(coefficient[i]));
    for (const auto &[e, a] : row)
      {
        known =
          known && (constrained[e] != is_free || std::abs(a) < 1e-8 * size);
        rest -= a * increment[e];
        scale += std::abs(a * increment[e]);
      }
    if (known && std::abs(rest) <= 1e-8 * scale)
      return;
    std::string        winner = sources.front();
    const unsigned int e      = entry[equation.first];
    if (place[e] != none && equation_of_follower[place[e]] != none)
      {
        const unsigned int first = equation_of_follower[place[e]];
        winner                   = sources[source_of_equation[first]];
      }
    else if (!source_of_entry.empty())
      winner = sources[source_of_entry[e]];
    conflicts.push_back({e,
                         winner,
                         sources[source_of_equation[number]],
                         known ? std::abs(rest) / size : 0.,
                         false});
  }
} // namespace isochor
