/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_reset_h
#define isochor_grid_reset_h

#include <isochor/equations/equation_term.h>

#include <string>

namespace isochor
{
  /**
   * When the background grid is reset, and what becomes of it until then.
   *
   * In the Material Point Method as it is, the grid is undeformed at the start
   * of each step. Here it may be kept for several: it then moves with the body.
   * Cells and shape functions of the points stay those of the last reset, and
   * gradients with respect to the deformed grid follow from the deformation
   * gradient ΔF of the step on each cell (or domain of a point),
   *
   *   ∇_{n+1} N_I = ΔF^{-T} ∇_n N_I,
   *
   * which is updated Lagrangian finite elements: ∏ ΔF over the steps is
   * 1 + ∇_r (u - u_r) of the last reset r. Nothing has to be located, weighted,
   * numbered or analysed before the next reset, and the nodal pressure goes on
   * without being mapped to the points and back.
   *
   * Velocities and accelerations are projected in each step all the same, which
   * loses nothing as long as points keep their cells (MassMatrix).
   *
   * Only what belongs to the cells that hold the body is moved
   * (PointArrays::deformed_cell). BackgroundGrid::geometry() is the undeformed
   * grid all the time, and loads per area of the grid and the size of cells
   * refer to it.
   */
  template <int dim>
  class GridReset
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    /** @p why_to_reset: what asks for a grid that is put back in each step, a
     * phrase, if the parameters leave it to the scene; empty if nothing does.
     */
    void
    parse_parameters(ParameterHandler &prm, const std::string &why_to_reset);

    /** Whether the step to come starts from the undeformed grid. */
    bool
    due() const
    {
      return is_due;
    }

    /** Whether the parameters reset the grid before each step. */
    bool
    always() const
    {
      return interval == 1;
    }

    /** What was chosen if the parameters leave it to the scene and it has
     * forces that jump; else nothing. A line for the terminal. */
    std::string
    describe() const;

    /** Why the grid is put back before each step, if it is: a phrase that names
     * the parameter. */
    std::string
    why_always() const;

    /** The grid has been put back at @p time. */
    void
    start(const double time);

    /** When the grid was last put back. */
    double
    start_time() const
    {
      return reset_time;
    }

    /** Steps since then. */
    unsigned int
    n_steps() const
    {
      return n_steps_since;
    }

    /** Why a grid that is kept for several steps was put back last, for
     * messages; nothing if it is after each step. */
    std::string
    why() const;

    /**
     * A step has converged: decide whether the next one starts with a reset;
     * if not, let the grid move on, in the @p points, those of @p step.
     * @p is_asked_for: one is, by a boundary condition. Collective.
     */
    void
    advance(const StepContext<dim> &step,
            const NodalField       &unknowns,
            const bool              is_asked_for,
            PointArrays<dim>       &points);

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &is_due &n_steps_since &reset_time;
    }

  private:
    static void
    advance_stencils(const StepContext<dim> &step,
                     const NodalField       &unknowns,
                     PointArrays<dim>       &points);
    /** Returns the smallest quality of this rank's cells. */
    static double
    advance_cells(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  PointArrays<dim>       &points);

    /**
     * Mean-ratio quality of a cell relative to its undeformed shape (Liu & Joe,
     * BIT 34 (1994) 268-287): d (det A)^{2/d} / |A|² with A the deformation
     * gradient of the cell since the reset. One for any similar shape, zero
     * for a flat cell or one turned inside out.
     */
    static double
    quality(const StepContext<dim> &step, const unsigned int k);

    unsigned int interval         = 1;
    double       smallest_quality = 0;
    /** Whether the scene has chosen the interval, and why it is 1 if it is. */
    bool        is_automatic = false;
    std::string reason;

    bool         is_due        = true;
    unsigned int n_steps_since = 0;
    double       reset_time    = 0;
    /** The quality for which the grid was put back last; one: not for it. */
    double bad_quality = 1;
  };
} // namespace isochor

#endif
