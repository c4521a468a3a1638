/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_boundary_checks_h
#define isochor_boundary_checks_h

#include <isochor/equations/equation_term.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /** A side of the grid: the mean direction into the grid, of length one where
   * it is flat, and the highest cell, from its face on the side to the vertex
   * opposite (m). */
  template <int dim>
  struct GridSide
  {
    Tensor<1, dim> inwards;
    double         cell_size = 0;
  };

  /** @p parameter names it @p boundary. */
  template <int dim>
  GridSide<dim>
  side_of(const BackgroundGrid<dim> &grid,
          const std::string         &boundary,
          const std::string         &parameter);

  /**
   * Warn if no active node is on the boundary called @p name, whose id is
   * @p id (any if @p everywhere), so that the entry of @p parameter for it has
   * no effect now; if @p by_points, no material point in the cells there, as
   * the condition itself makes nodes active. A wall that the body reaches later
   * is a case in which it may be meant. Collective.
   */
  template <int dim>
  void
  warn_if_untouched(const StepContext<dim>  &step,
                    const std::string       &parameter,
                    const std::string       &name,
                    const types::boundary_id id,
                    const bool               everywhere = false,
                    const bool               by_points  = false);

  /** On a grid that is put back, a @p boundary that by @p parameter has pushed
   * the body out of the row of cells there hands hardly anything on to it: warn
   * from half a cell on. In statics its forces are too small before: the row of
   * cells with the gap in it is strained by more than the body. Warn from 1 %
   * of the body's length on, if the body touches the boundary. @p push: the
   * least and the most that it prescribes to its vertices along the axis @p
   * component beyond what moves the grid (m). Collective. */
  template <int dim>
  void
  warn_of_lost_body(const StepContext<dim>      &step,
                    const std::string           &parameter,
                    const std::string           &boundary,
                    const unsigned int           component,
                    const std::array<double, 2> &push);

  /** The same of what <@p condition> prescribes along the normal into the grid,
   * @p along (m). */
  template <int dim>
  void
  warn_of_body_left_behind(const StepContext<dim> &step,
                           const std::string      &boundary,
                           const std::string      &condition,
                           const double            along);
} // namespace isochor

#endif
