/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_step_setup_h
#define isochor_step_setup_h

#include <deal.II/base/timer.h>

#include <isochor/adaptation/grid_partition.h>
#include <isochor/cut_cells/cell_occupancy.h>
#include <isochor/cut_cells/discrete_extension.h>
#include <isochor/material_points/point_locator.h>
#include <isochor/material_points/point_refinement.h>
#include <isochor/scene/scene.h>
#include <isochor/transfer/grid_reset.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * Where the equations of a step live: the points in the cells of the grid,
   * what they integrate there, the nodes that take part, and the elements, the
   * lists of nodes of each term of the equations. All of it is set up when the
   * grid is reset and serves until the next time (GridReset).
   */
  template <int dim>
  class StepSetup
  {
  public:
    /** Both arguments are kept by reference. */
    StepSetup(Scene<dim> &scene, TimerOutput &timer);

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Once, after Scene::create(). Collective. */
    void
    initialize();

    /** The moving grid of a resumed run is that of the last reset. */
    void
    restore_moved_grid();

    /**
     * The points are where the last step left them: put the grid back if that
     * is due, find the points in it and all that follows from it, and the nodes
     * that they and the @p terms touch. An adaptive grid may become another
     * one then, any other one be divided among the ranks anew, and @p
     * last_motion become that of its nodes. Collective.
     */
    void
    start_step(const std::vector<EquationTerm<dim> *> &terms,
               LastMotion                             &last_motion);

    /** Whether start_step() has found the points in the grid anew. It does
     * nothing at all if no point has moved since it was last called, as after
     * a step that failed. */
    bool
    was_laid_out() const
    {
      return laid_out;
    }

    /** Whether the grid or its free nodes are others than in the last step, or
     * points have been split or merged since. */
    bool
    was_disturbed() const
    {
      return disturbed;
    }

    /** The first step was solved: adapt the grid to the solution @p unknowns
     * and fill it with the body anew, if the step is to be solved once more.
     * Whether it is. Collective. */
    bool
    repeats_first_step(const NodalField &unknowns);

    /** Ask the @p terms for their elements, after a reset; and in a resumed run
     * whose grid is kept, since terms remember what they named. */
    void
    collect_elements(const std::vector<EquationTerm<dim> *> &terms);

    /** Tie the nodes that hardly any material touches. */
    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const;

    /** The step has converged: let the grid move on, unless the next step
     * starts with a reset. Collective. */
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns);

    /** The step to come must not use what the last one left in the solver: a
     * resumed run has none of it. */
    void
    start_afresh()
    {
      is_fresh   = true;
      is_current = false;
    }

    /** The step, of the points as they are now. */
    StepContext<dim>
    context() const;

    /** How many cells of the grid hold material, and how many nodes take part.
     * Collective. */
    std::pair<types::global_dof_index, types::global_dof_index>
    n_active_cells_and_nodes() const;

    /** The grid and what it does to the points, if it is adaptive, and how the
     * ranks share it. Collective. */
    void
    evaluate(Statistics &statistics);

    /** All of this rank that a run which continues on a kept grid needs; short
     * if the grid is to be reset. */
    std::string
    save_state() const;
    void
    load_state(const std::string &state);

    PointArrays<dim> &
    point_arrays()
    {
      return arrays;
    }
    const PointArrays<dim> &
    point_arrays() const
    {
      return arrays;
    }
    const ActiveNodes<dim> &
    active_nodes() const
    {
      return nodes;
    }
    /** Whether they are others than in the last step, on any rank. */
    bool
    nodes_have_changed() const
    {
      return nodes_changed;
    }
    const GridReset<dim> &
    reset() const
    {
      return grid_reset;
    }
    /** Whether nodes are tied, see DiscreteExtension::is_active(). */
    bool
    ties_nodes() const
    {
      return extends;
    }
    DiscreteExtension<dim> &
    ties()
    {
      return extension;
    }
    /** The elements of all terms, and the first of each term. */
    const ElementNodes &
    all_elements() const
    {
      return elements;
    }
    const std::vector<unsigned int> &
    first_of_term() const
    {
      return first_element;
    }

    /** Where conditions hold the body on the grid's boundary, whether the cells
     * are known in which it lies or not. Collective. */
    const CellOccupancy<dim> &
    walls()
    {
      if (!needs_occupancy)
        find_walls();
      return occupancy;
    }

  private:
    void
    reset_grid(const std::vector<EquationTerm<dim> *> &terms,
               LastMotion                             &last_motion);
    /** The grid has been replaced: tell what knows it. */
    void
    grid_changed();
    /** Its cells have other owners: tell what keeps something by rank. */
    void
    owners_changed();
    /** Tell the occupancy where boundary conditions hold the body. */
    void
    find_walls();

    Scene<dim>  &scene;
    TimerOutput &timer;

    std::unique_ptr<PointLocator<dim>> locator;
    unsigned int                       n_first_solutions = 0;
    GridReset<dim>                     grid_reset;
    GridPartition<dim>                 partition;
    PointRefinement<dim>               refinement;
    CellOccupancy<dim>                 occupancy;
    bool                               needs_occupancy = false;
    DiscreteExtension<dim>             extension;
    bool                               extends = false;

    PointArrays<dim> arrays;
    ActiveNodes<dim> nodes;
    bool             nodes_changed = false;
    bool             is_fresh      = false;
    bool             laid_out      = false;
    bool             disturbed     = false; ///< see was_disturbed()
    std::uint64_t    free_nodes    = 0;     ///< a hash of the set
    bool             is_resumed    = false; ///< without elements as yet
    /** Whether no point has moved since start_step(). */
    bool                      is_current = false;
    std::vector<unsigned int> touched_vertices;
    ElementNodes              elements;
    std::vector<unsigned int> first_element;
  };
} // namespace isochor

#endif
