/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/tied_elements.h>

#include <algorithm>

namespace isochor
{
  void
  TiedElements::reinit(const ElementNodes &elements,
                       const Followers    &followers,
                       const unsigned int  n_components_,
                       const unsigned int  n_nodes)
  {
    AssertDimension(followers.value.size(), followers.size());
    AssertDimension(followers.flags.size(), followers.size());
    AssertDimension(followers.start.size(), followers.size() + 1);
    AssertDimension(followers.weight.size(), followers.master.size());
    Assert(std::all_of(followers.entry.begin(),
                       followers.entry.end(),
                       [&](const unsigned int entry) {
                         return entry < n_nodes * n_components_;
                       }),
           ExcInternalError());
    all          = followers;
    n_components = n_components_;
    forces.assign(all.size(), 0.);
    if (empty())
      return;

    follower_at.assign(n_nodes * n_components, none);
    std::vector<unsigned char> node_follows(n_nodes, 0);
    for (unsigned int k = 0; k < all.size(); ++k)
      {
        follower_at[all.entry[k]]                 = k;
        node_follows[all.entry[k] / n_components] = 1;
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
          {
            if (!node_follows[*node])
              continue;
            element_is_tied[e] = 1;
            for (unsigned int a = 0; a < n_components; ++a)
              {
                const unsigned int k = follower_at[*node * n_components + a];
                if (k == none)
                  continue;
                for (std::size_t i = all.start[k]; i < all.start[k + 1]; ++i)
                  {
                    const unsigned int master = all.master[i] / n_components;
                    if (std::find(nodes.begin(), nodes.end(), master) ==
                        nodes.end())
                      nodes.push_back(master);
                  }
              }
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
    Assert(touches(element),
           ExcMessage("Nothing of the element follows others."));
    AssertIndexRange(element, extended_elements.size());
    Assert(matrix != nullptr, ExcInternalError());
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
          const unsigned int k = follower_at[begin[I] * n_components + a];
          if (k != none)
            for (std::size_t i = all.start[k]; i < all.start[k + 1]; ++i)
              {
                const unsigned int node = all.master[i] / n_components;
                const unsigned int J    = std::find(begin, end, node) - begin;
                row_column.push_back(J * n_components +
                                     all.master[i] % n_components);
                row_weight.push_back(all.weight[i]);
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
  TiedElements::hand_on(const unsigned int n_owned_nodes,
                        NodalField        &force,
                        const bool         remember)
  {
    AssertDimension(forces.size(), all.size());
    for (unsigned int k = 0; k < all.size(); ++k)
      if (all.entry[k] < n_owned_nodes * n_components)
        {
          const double value = force.local_element(all.entry[k]);
          if (remember)
            forces[k] = value;
          force.local_element(all.entry[k]) = 0.;
          for (std::size_t i = all.start[k]; i < all.start[k + 1]; ++i)
            force.local_element(all.master[i]) += all.weight[i] * value;
        }
  }
} // namespace isochor
