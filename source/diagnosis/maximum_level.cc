/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

#include <algorithm>

namespace isochor
{
  /** Points that ask for cells which are not allowed. */
  template <int dim>
  class MaximumLevel : public Diagnosis<dim>
  {
  public:
    void
    step_converged(const ConvergedStep<dim> &step) override
    {
      const BackgroundGrid<dim> &grid = step.scene.grid;
      if (!grid.is_adaptive() || !step.scene.adaptation.needs_sizes())
        return;
      const AdaptiveGrid<dim> &forest  = grid.adaptive_grid();
      const unsigned int       maximum = step.scene.adaptation.maximum_level();
      const unsigned int       entry   = step.result.points.layout().cell_size;
      double                   n_limited = 0, n = 0, smallest = 1e300;
      for (const auto &point : step.result.points.handler())
        {
          const auto tree =
            forest
              .leaves()[forest.leaf_of_cell(
                point.get_surrounding_cell()->active_cell_index())]
              .tree;
          const double size = point.get_properties()[entry];
          n_limited +=
            size > 0 && size < forest.size(tree, maximum) * (1 - 1e-9);
          n += 1;
          smallest = std::min(smallest, size);
        }
      const MPI_Comm comm = grid.communicator();
      n_limited           = Utilities::MPI::sum(n_limited, comm);
      n                   = Utilities::MPI::sum(n, comm);
      smallest            = Utilities::MPI::min(smallest, comm);
      if (n_limited > 0.01 * n)
        this->warn(
          "at t = " + rounded(step.result.step.time) + " " +
          rounded(100 * n_limited / n) +
          " % of the points ask for smaller cells (down to " +
          rounded(smallest) +
          " m) than <Adaptive grid/Maximum level = " + std::to_string(maximum) +
          "> allows. Raise it, or ask for "
          "less.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    MaximumLevel,
    "grid at its maximum level",
    ISOCHOR_ADVICE,
    "adaptive grid: more than 1 % of the material points ask for smaller "
    "cells than `Adaptive grid/Maximum level` allows, by a criterion that "
    "depends on the solution (not by formulas)",
    "raise it, or ask for less (`Target of relative error`, `Cell size in "
    "plastic zones`, ...)")
} // namespace isochor
