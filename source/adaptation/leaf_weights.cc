/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/adaptation/leaf_weights.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** What a leaf costs besides its points, in points: it is split into two
     * triangles or six tetrahedra. */
    template <int dim>
    constexpr double
      cost_of_leaf = (dim == 2 ? 2 : 6) * LoadBalance::cost_of_cell;

    /** See LoadBalance::imbalance(). */
    double
    imbalance(const std::vector<double>       &weights,
              const std::vector<unsigned int> &owners,
              const unsigned int               n_ranks)
    {
      AssertDimension(weights.size(), owners.size());
      std::vector<double> sums(n_ranks);
      for (unsigned int i = 0; i < weights.size(); ++i)
        sums[owners[i]] += weights[i];
      return LoadBalance::imbalance(sums);
    }
  } // namespace



  template <int dim>
  bool
  is_within(const Leaf<dim> &leaf, const Leaf<dim> &other)
  {
    if (leaf.tree != other.tree || leaf.level < other.level)
      return false;
    for (unsigned int d = 0; d < dim; ++d)
      if (leaf.corner[d] - other.corner[d] >= other.size()) // or wraps
        return false;
    return true;
  }



  template <int dim>
  std::vector<double>
  leaf_weights(const std::vector<Leaf<dim>> &old,
               const std::vector<double>    &n_points,
               const std::vector<Leaf<dim>> &leaves)
  {
    AssertDimension(n_points.size(), old.size());
    std::vector<double> weights;
    for (const Leaf<dim> &leaf : leaves)
      {
        unsigned int i      = find_leaf<dim>(old, leaf.tree, leaf.corner);
        double       weight = 0;
        if (old[i].level <= leaf.level)
          weight =
            n_points[i] / std::pow(2., dim * (leaf.level - old[i].level));
        else
          for (; i < old.size() && is_within(old[i], leaf); ++i)
            weight += n_points[i];
        weights.push_back(weight > 0 ? weight + cost_of_leaf<dim> : 0.1);
      }
    return weights;
  }



  template <int dim>
  bool
  is_out_of_balance(const std::vector<double>       &weights,
                    const AdaptiveGrid<dim>         &forest,
                    const std::vector<unsigned int> &owners,
                    const unsigned int               n_ranks,
                    const LoadBalance               &balance)
  {
    AssertDimension(weights.size(), forest.leaves().size());
    Assert(n_ranks > 0, ExcInternalError());
    if (n_ranks == 1)
      return false;
    std::vector<unsigned int> old;
    for (unsigned int leaf = 0; leaf < weights.size(); ++leaf)
      old.push_back(forest.leaf_owner(leaf));
    return balance.is_worth_it(imbalance(weights, old, n_ranks),
                               imbalance(weights, owners, n_ranks));
  }



  template bool
  is_within(const Leaf<2> &, const Leaf<2> &);
  template std::vector<double>
  leaf_weights(const std::vector<Leaf<2>> &,
               const std::vector<double> &,
               const std::vector<Leaf<2>> &);
  template bool
  is_out_of_balance(const std::vector<double> &,
                    const AdaptiveGrid<2> &,
                    const std::vector<unsigned int> &,
                    const unsigned int,
                    const LoadBalance &);
  template bool
  is_within(const Leaf<3> &, const Leaf<3> &);
  template std::vector<double>
  leaf_weights(const std::vector<Leaf<3>> &,
               const std::vector<double> &,
               const std::vector<Leaf<3>> &);
  template bool
  is_out_of_balance(const std::vector<double> &,
                    const AdaptiveGrid<3> &,
                    const std::vector<unsigned int> &,
                    const unsigned int,
                    const LoadBalance &);
} // namespace isochor
