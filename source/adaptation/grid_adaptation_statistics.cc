/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The member of GridAdaptation that tells what the grid is like.
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/grid_adaptation.h>
#include <isochor/adaptation/load_balance.h>

#include <algorithm>
#include <vector>

namespace isochor
{
  template <int dim>
  void
  GridAdaptation<dim>::evaluate(const BackgroundGrid<dim> &grid,
                                const MaterialPoints<dim> &points,
                                const PointArrays<dim>    &arrays,
                                Statistics                &statistics)
  {
    const AdaptiveGrid<dim> &forest = grid.adaptive_grid();
    const auto              &leaves = forest.leaves();
    // all cells of a leaf belong to one rank
    std::vector<unsigned int> filled;
    for (unsigned int k = 0; k < arrays.n_occupied_cells; ++k)
      filled.push_back(forest.leaf_of_cell(arrays.cell[k]));
    std::sort(filled.begin(), filled.end());
    const types::global_dof_index n_filled =
      std::unique(filled.begin(), filled.end()) - filled.begin();
    const auto [coarsest, finest] =
      std::minmax_element(leaves.begin(),
                          leaves.end(),
                          [](const Leaf<dim> &a, const Leaf<dim> &b) {
                            return a.level < b.level;
                          });
    statistics.set("Cells of grid", grid.geometry().n_cells());
    statistics.set("Leaves of grid", leaves.size());
    statistics.set("Leaves with material",
                   Utilities::MPI::sum(n_filled, grid.communicator()));
    statistics.set("Coarsest level of grid", coarsest->level);
    statistics.set("Finest level of grid", finest->level);
    statistics.set("Changes of grid", n_changes);
    evaluate_balance(points, grid.communicator(), statistics);
  }



  template void
  GridAdaptation<2>::evaluate(const BackgroundGrid<2> &,
                              const MaterialPoints<2> &,
                              const PointArrays<2> &,
                              Statistics &);
  template void
  GridAdaptation<3>::evaluate(const BackgroundGrid<3> &,
                              const MaterialPoints<3> &,
                              const PointArrays<3> &,
                              Statistics &);
} // namespace isochor
