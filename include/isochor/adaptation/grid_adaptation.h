/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_adaptation_h
#define isochor_grid_adaptation_h

#include <isochor/adaptation/cell_size_criterion.h>
#include <isochor/adaptation/load_balance.h>
#include <isochor/equations/equation_term.h>
#include <isochor/material_points/material_points.h>
#include <isochor/material_points/point_locator.h>
#include <isochor/transfer/last_motion.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** What has become of a grid that may have been replaced. */
  enum class GridChange
  {
    none,
    owners, ///< the same cells, divided among the ranks in another way
    cells
  };



  /**
   * When and how a grid of the type "adaptive" is replaced by another one.
   * Material points carry all of the state, so that at a reset of the grid the
   * next one may be any; nothing is transferred.
   *
   * At the end of a step each point gets the size of cells that it asks for,
   * the smallest of all criteria (CellSizeCriterion), which it carries to the
   * next reset. There a leaf's level follows from the smallest size of its
   * points. Leaves without points get the minimum level, but near the body that
   * of their neighbours. If no leaf changes, the grid stays as it is.
   */
  template <int dim>
  class GridAdaptation
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** What @p grid is to begin with: refined where sizes are known without a
     * body. Before there are points. Nothing if it is not adaptive. */
    void
    make_initial_grid(BackgroundGrid<dim> &grid);

    /**
     * Before the points move: let them ask for sizes by what @p unknowns will
     * make of them. Sets columns of the @p statistics. Collective.
     */
    void
    set_sizes(const StepContext<dim> &step,
              const NodalField       &unknowns,
              MaterialPoints<dim>    &points,
              Statistics             &statistics);

    /** Whether set_sizes() is to be called after this step: the grid may change
     * at the next reset, or the statistics have columns of it. */
    bool
    needs_sizes() const;

    /** What set_sizes() has found last. */
    struct Limited
    {
      double       time          = -1; ///< at the end of its step (s)
      double       share         = 0;  ///< of points that ask for more
      double       smallest      = 0;  ///< of what they ask for (m)
      unsigned int maximum_level = 0;  ///< which doesn't allow it
    };
    const Limited &
    limited() const
    {
      return last_limited;
    }

    /** The grid is reset: whether it may change this time. */
    bool
    is_due();

    /** Whether the grid may change after the first step. */
    bool
    has_more_changes() const
    {
      return resets_between > 0;
    }

    /**
     * The grid is reset at @p time, and the points have been located in the old
     * one: replace it and put them into the new one, if a leaf changes. Nodes
     * of the new one get what @p last_motion has at their places. Not
     * @p keep_points: the new one has none, to be seeded anew. Also replaced is
     * a grid of the same leaves that has to be divided among the ranks anew.
     * Collective.
     */
    GridChange
    adapt(BackgroundGrid<dim>     &grid,
          MaterialPoints<dim>     &points,
          const PointLocator<dim> &locator,
          const double             time,
          LastMotion              &last_motion,
          const bool               keep_points = true);

    /** Whether the first step, just solved for the time number @p n, is to be
     * solved again on the grid that follows from it. */
    bool
    repeats_first_step(const unsigned int n) const
    {
      return n <= n_repetitions;
    }

    /** Cells, levels and changes of an adaptive @p grid, for the statistics.
     * Collective. */
    void
    evaluate(const BackgroundGrid<dim> &grid,
             const MaterialPoints<dim> &points,
             const PointArrays<dim>    &arrays,
             Statistics                &statistics);

    /** What has to survive a restart, the mesh included. */
    std::string
    save_state(const BackgroundGrid<dim> &grid) const;
    /** Returns whether the mesh was changed. Collective. */
    bool
    load_state(const std::string       &state,
               BackgroundGrid<dim>     &grid,
               MaterialPoints<dim>     &points,
               const PointLocator<dim> &locator);

  private:
    bool
    needs_state() const;
    double
    size_at(const Point<dim> &x, const double time) const;
    /** The level of each leaf of the present grid, and how many points it has.
     * Collective. */
    std::vector<unsigned int>
    wanted_levels(const BackgroundGrid<dim> &grid,
                  const MaterialPoints<dim> &points,
                  const double               time,
                  std::vector<double>       &n_points) const;

    std::vector<std::unique_ptr<CellSizeCriterion<dim>>> criteria;
    LevelRule<dim>                                       rule;
    LoadBalance                                          balance;
    unsigned int n_buffer = 1, n_repetitions = 0, resets_between = 1;
    unsigned int n_resets = 0, n_changes = 0;
    Limited      last_limited;
  };
} // namespace isochor

#endif
