/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_partition_h
#define isochor_grid_partition_h

#include <isochor/adaptation/load_balance.h>
#include <isochor/grid/coordinate_bisection.h>
#include <isochor/material_points/point_locator.h>
#include <isochor/transfer/last_motion.h>

#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * Which rank owns what of a grid that does not adapt. It is made with parts
   * of as many cells each. At a reset it is divided anew, by
   * CoordinateBisection with the points as weights, if they are shared unevenly
   * (LoadBalance). Cells and vertices keep their numbers and the points their
   * state: only what ranks keep of their own part has to be told
   * (BoundaryCondition::owners_changed()).
   *
   * Grids that adapt are divided along the curve of their leaves, see
   * GridAdaptation.
   */
  template <int dim>
  class GridPartition
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Whether there is something to divide, now or later. */
    static bool
    is_needed(const BackgroundGrid<dim> &grid);

    /** The @p points have been located in the @p grid: bring them, the
     * @p last_motion and the cells to other ranks, if that is worth it. Returns
     * whether it was. Collective. */
    bool
    rebalance(BackgroundGrid<dim>     &grid,
              MaterialPoints<dim>     &points,
              const PointLocator<dim> &locator,
              LastMotion              &last_motion);

    /** Columns of the statistics. Collective. */
    void
    evaluate(const BackgroundGrid<dim> &grid,
             const MaterialPoints<dim> &points,
             Statistics                &statistics) const;

    /** What has to survive a restart: the same on all ranks. */
    std::string
    save_state() const;
    /** Returns whether owners were changed. Collective. */
    bool
    load_state(const std::string       &state,
               BackgroundGrid<dim>     &grid,
               MaterialPoints<dim>     &points,
               const PointLocator<dim> &locator);

  private:
    /** Pairs of this rank: cells with points, and how many. */
    static std::vector<unsigned int>
    occupied_cells(const MaterialPoints<dim> &points);
    /** What the cells of all ranks cost. Collective. */
    static std::vector<std::pair<unsigned int, double>>
    cell_weights(const std::vector<unsigned int> &occupied, const MPI_Comm);
    /** The owners of all cells. */
    static std::vector<unsigned int>
    owners(const CoordinateBisection<dim> &division,
           const BackgroundGrid<dim>      &grid);

    LoadBalance              balance;
    CoordinateBisection<dim> division;
    unsigned int             n_divisions = 0; ///< besides the first one
  };
} // namespace isochor

#endif
