/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/lac/full_matrix.h>

#include <isochor/equations/constraint_forces.h>

#include <algorithm>
#include <map>

namespace isochor
{
  void
  ConstraintForces::reinit(const NodalConstraints &constraints,
                           const unsigned int      n_components_,
                           const bool              with_ties)
  {
    AssertDimension(constraints.constrained.size() % n_components_, 0u);
    AssertDimension(constraints.coefficient.size(), constraints.entry.size());
    nodes.clear();
    equations    = constraints.equations;
    n_components = n_components_;
    multipliers.assign(equations.size(), 0.);
    const std::size_t n_entries = constraints.constrained.size();
    held.assign(n_entries, 0);
    for (unsigned int i = 0; i < n_entries; ++i)
      held[i] = constraints.constrained[i] == NodalConstraints::prescribed;
    entry       = constraints.entry;
    coefficient = constraints.coefficient;
    ties        = constraints.ties;

    std::map<unsigned int, Node> by_node;
    for (unsigned int k = 0; k < equations.size(); ++k)
      {
        const auto &equation = equations[k];
        // what it determines may be an unknown that only others refer to: then
        // its force is part of theirs
        if (equation.pivot == none ||
            coefficient_at({k, none, equation.pivot}, equation.pivot) == 0.)
          continue;
        Node      &node          = by_node[equation.pivot / n_components];
        const bool between_nodes = equation.precedence >= Precedence::periodic;
        if (between_nodes)
          node.kind = std::min(node.kind,
                               constraints.is_of_control_node(equation.pivot) ?
                                 relation_of_control :
                                 relation);
        node.rows.push_back({k, none, equation.pivot});
        for (std::size_t i = equation.first;
             i < equation.last && !between_nodes;
             ++i)
          if (entry[i] / n_components == equation.pivot / n_components)
            held[entry[i]] = 1;
      }
    std::vector<unsigned int> tie_of_node(with_ties ? n_entries / n_components :
                                                      0,
                                          none);
    for (unsigned int k = 0; k < ties.size() && with_ties; ++k)
      tie_of_node[ties.node[k]] = k;
    const Followers &followers = constraints.followers;
    for (unsigned int k = 0; k < followers.size() && with_ties; ++k)
      if (followers.has(k, Followers::is_tie))
        {
          const unsigned int node = followers.entry[k] / n_components;
          by_node[node].kind      = tie;
          by_node[node].rows.push_back(
            {none, tie_of_node[node], followers.entry[k]});
        }
    for (auto &node : by_node)
      {
        node.second.node = node.first;
        nodes.push_back(node.second);
      }
  }



  double
  ConstraintForces::coefficient_at(const Row &row, const unsigned int e) const
  {
    Assert(row.equation == none || row.equation < equations.size(),
           ExcInternalError());
    if (row.equation == none)
      return e == row.pivot ? 1. : 0.;
    const NodalConstraints::Equation &equation = equations[row.equation];
    double                            a        = 0;
    for (std::size_t i = equation.first; i < equation.last; ++i)
      if (entry[i] == e)
        a += coefficient[i];
    return a;
  }



  void
  ConstraintForces::solve(const Node &node, const NodalField &force)
  {
    Assert(!node.rows.empty(), ExcMessage("The node has no constraint."));
    const unsigned int n = node.rows.size();
    solution.resize(n);
    if (n == 1)
      {
        solution[0] = force.local_element(node.rows[0].pivot) /
                      coefficient_at(node.rows[0], node.rows[0].pivot);
        return;
      }
    FullMatrix<double> matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 0; k < n; ++k)
        matrix(i, k) = coefficient_at(node.rows[k], node.rows[i].pivot);
    matrix.gauss_jordan();
    for (unsigned int k = 0; k < n; ++k)
      {
        solution[k] = 0;
        for (unsigned int i = 0; i < n; ++i)
          solution[k] += matrix(k, i) * force.local_element(node.rows[i].pivot);
      }
  }



  void
  ConstraintForces::take_away(const Row   &row,
                              const double multiplier,
                              NodalField  &force) const
  {
    AssertIndexRange(row.pivot, held.size());
    if (row.equation == none)
      {
        const unsigned int component = row.pivot % n_components;
        force.local_element(row.pivot) -= multiplier;
        for (std::size_t i = ties.start[row.tie]; i < ties.start[row.tie + 1];
             ++i)
          force.local_element(ties.master[i] * n_components + component) +=
            ties.weight[i] * multiplier;
        return;
      }
    for (std::size_t i = equations[row.equation].first;
         i < equations[row.equation].last;
         ++i)
      force.local_element(entry[i]) -= coefficient[i] * multiplier;
  }



  void
  ConstraintForces::find(const unsigned int n_owned_nodes, NodalField &force)
  {
    AssertDimension(multipliers.size(), equations.size());
    AssertIndexRange(n_owned_nodes * n_components, held.size() + 1);
    std::fill(multipliers.begin(), multipliers.end(), 0.);
    // first what hands on to others, then who may have got something
    for (const Kind kind : {tie, relation, relation_of_control, none_of_them})
      {
        for (const Node &node : nodes)
          if (node.node < n_owned_nodes &&
              (node.kind == kind || kind == none_of_them))
            {
              solve(node, force);
              for (unsigned int k = 0; k < node.rows.size(); ++k)
                {
                  const Row &row = node.rows[k];
                  if (hands_on(row) == (kind == none_of_them))
                    continue;
                  if (row.equation != none)
                    multipliers[row.equation] += solution[k];
                  if (hands_on(row))
                    take_away(row, solution[k], force);
                }
            }
        if (kind != none_of_them)
          force.compress(VectorOperation::add);
      }
  }
} // namespace isochor
