/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_cell_size_criterion_h
#define isochor_cell_size_criterion_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/adaptation/body_state.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/base/statistics.h>
#include <isochor/grid/background_grid.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** How the levels of leaves follow from sizes that are asked for. */
  template <int dim>
  struct LevelRule
  {
    unsigned int minimum = 0, maximum = 0;
    /** Levels by which a leaf's parent must be smaller than necessary before
     * the leaf is joined with its neighbours. */
    double hysteresis = 0;

    /** The level that a leaf gets whose points ask for cells no larger than
     * @p size. */
    unsigned int
    level(const AdaptiveGrid<dim> &grid,
          const Leaf<dim>         &leaf,
          const double             size) const;
  };

  /**
   * Interface of what decides how large the cells of an adaptive grid are. All
   * take part, and the smallest size counts. To add one, write
   * `source/adaptation/<name>.cc` with the class and its registration.
   * Parameters live in the subsection "Adaptive grid"; a criterion whose
   * parameters are left at their defaults does nothing.
   */
  template <int dim>
  class CellSizeCriterion
  {
  public:
    static constexpr double any_size = std::numeric_limits<double>::infinity();

    virtual ~CellSizeCriterion() = default;

    /** As it is registered. */
    std::string name;

    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** Once, with the coarse cells as the grid. */
    virtual void
    initialize(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** The largest size of cells (m) at @p x, whatever is there. */
    virtual double
    size_at(const Point<dim> & /*x*/, const double /*time*/) const
    {
      return any_size;
    }

    /** How many leaves with material there are to be at most, roughly. 0: any
     * number. */
    virtual unsigned int
    largest_number_of_leaves() const
    {
      return 0;
    }

    /** Whether limit_sizes() is to be called. */
    virtual bool
    needs_state() const
    {
      return false;
    }

    /** Whether limit_sizes() writes into the statistics: then it is called
     * after each step, else only before a reset at which the grid may change.
     */
    virtual bool
    writes_statistics() const
    {
      return true;
    }

    /**
     * Reduce the largest @p sizes (m) of cells at the points of @p state, where
     * necessary. The size of a cell is that of its leaf, the side of a square
     * or cube of the same volume. Collective.
     */
    virtual void
    limit_sizes(const BodyState<dim> & /*state*/,
                const LevelRule<dim> & /*rule*/,
                std::vector<double> & /*sizes*/,
                Statistics & /*statistics*/) const
    {}
  };
} // namespace isochor

#endif
