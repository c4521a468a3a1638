/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/tied_elements.h>

#include <algorithm>

namespace isochor
{
  void
  TiedElements::reinit(const ElementNodes     &elements,
                       const NodalConstraints &constraints,
                       const unsigned int      n_components_,
                       const unsigned int      n_nodes)
  {
    ties         = constraints.ties;
    n_components = n_components_;
    forces.assign(ties.size() * n_components, 0.);
    if (empty())
      return;

    tie_of_node.assign(n_nodes, none);
    prescribed.resize(ties.size() * n_components);
    for (unsigned int k = 0; k < ties.size(); ++k)
      {
        tie_of_node[ties.node[k]] = k;
        for (unsigned int a = 0; a < n_components; ++a)
          prescribed[k * n_components + a] =
            constraints.constrained[ties.node[k] * n_components + a];
      }

    extended_elements.clear();
    element_is_tied.assign(elements.size(), 0);
    std::vector<unsigned int> nodes;
    for (unsigned int e = 0; e < elements.size(); ++e)
      {
        const auto begin = elements.node.begin() + elements.start[e],
                   end   = elements.node.begin() + elements.start[e + 1];
        nodes.assign(begin, end);
        for (auto node = begin; node != end; ++node)
          if (tie_of_node[*node] != none)
            {
              const unsigned int k = tie_of_node[*node];
              element_is_tied[e]   = 1;
              for (std::size_t i = ties.start[k]; i < ties.start[k + 1]; ++i)
                if (std::find(nodes.begin(), nodes.end(), ties.master[i]) ==
                    nodes.end())
                  nodes.push_back(ties.master[i]);
            }
        extended_elements.add(nodes.begin(), nodes.end());
      }
  }



  const double *
  TiedElements::eliminate(const unsigned int element,
                          const unsigned int n_nodes,
                          const double      *matrix,
                          const bool         symmetric)
  {
    const auto begin =
      extended_elements.node.begin() + extended_elements.start[element];
    const auto end =
      extended_elements.node.begin() + extended_elements.start[element + 1];
    row_start.assign(1, 0);
    row_column.clear();
    row_weight.clear();
    for (unsigned int I = 0; I < n_nodes; ++I)
      for (unsigned int a = 0; a < n_components; ++a)
        {
          if (is_tied(begin[I], a))
            {
              const unsigned int k = tie_of_node[begin[I]];
              for (std::size_t i = ties.start[k]; i < ties.start[k + 1]; ++i)
                {
                  const unsigned int J =
                    std::find(begin, end, ties.master[i]) - begin;
                  row_column.push_back(J * n_components + a);
                  row_weight.push_back(ties.weight[i]);
                }
            }
          else
            {
              row_column.push_back(I * n_components + a);
              row_weight.push_back(1.);
            }
          row_start.push_back(row_column.size());
        }

    const unsigned int n          = n_nodes * n_components;
    const unsigned int n_extended = (end - begin) * n_components;
    result.assign(n_extended * n_extended, 0.);
    for (unsigned int r = 0; r < n; ++r)
      for (unsigned int s = 0; s < n; ++s)
        {
          const double value =
            symmetric && s < r ? matrix[s * n + r] : matrix[r * n + s];
          if (value == 0.)
            continue;
          for (unsigned int i = row_start[r]; i < row_start[r + 1]; ++i)
            for (unsigned int j = row_start[s]; j < row_start[s + 1]; ++j)
              result[row_column[i] * n_extended + row_column[j]] +=
                row_weight[i] * row_weight[j] * value;
        }
    return result.data();
  }



  void
  TiedElements::hand_on_forces(const unsigned int n_owned_nodes,
                               NodalField        &force)
  {
    for (unsigned int k = 0; k < ties.size(); ++k)
      if (ties.node[k] < n_owned_nodes)
        for (unsigned int a = 0; a < n_components; ++a)
          {
            if (prescribed[k * n_components + a])
              continue;
            const unsigned int entry     = ties.node[k] * n_components + a;
            const double       value     = force.local_element(entry);
            forces[k * n_components + a] = value;
            force.local_element(entry)   = 0.;
            for (std::size_t i = ties.start[k]; i < ties.start[k + 1]; ++i)
              force.local_element(ties.master[i] * n_components + a) +=
                ties.weight[i] * value;
          }
  }



  void
  TiedElements::interpolate(NodalField &field) const
  {
    for (unsigned int k = 0; k < ties.size(); ++k)
      for (unsigned int a = 0; a < n_components; ++a)
        {
          if (prescribed[k * n_components + a])
            continue;
          double value = 0;
          for (std::size_t i = ties.start[k]; i < ties.start[k + 1]; ++i)
            value += ties.weight[i] *
                     field.local_element(ties.master[i] * n_components + a);
          field.local_element(ties.node[k] * n_components + a) = value;
        }
  }
} // namespace isochor
