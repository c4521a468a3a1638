/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_leaf_weights_h
#define isochor_leaf_weights_h

#include <isochor/adaptation/load_balance.h>
#include <isochor/grid/adaptive_grid.h>

#include <vector>

namespace isochor
{
  /** Whether @p leaf is @p other or a part of it. */
  template <int dim>
  bool
  is_within(const Leaf<dim> &leaf, const Leaf<dim> &other);

  /** What each of @p leaves costs, in points, with @p n_points in the leaves of
   * @p old. */
  template <int dim>
  std::vector<double>
  leaf_weights(const std::vector<Leaf<dim>> &old,
               const std::vector<double>    &n_points,
               const std::vector<Leaf<dim>> &leaves);

  /** Whether new @p owners of the leaves of @p forest share their @p weights so
   * much more evenly that the grid should be set up again. */
  template <int dim>
  bool
  is_out_of_balance(const std::vector<double>       &weights,
                    const AdaptiveGrid<dim>         &forest,
                    const std::vector<unsigned int> &owners,
                    const unsigned int               n_ranks,
                    const LoadBalance               &balance);
} // namespace isochor

#endif
