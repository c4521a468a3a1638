/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_coarse_grid_watch_h
#define isochor_coarse_grid_watch_h

#include <isochor/equations/equation_term.h>

#include <string>

namespace isochor
{
  using namespace dealii;

  /**
   * Estimates by how much the grid is too coarse for what the body does, and
   * warns if the stresses are wrong (stress_recovery.h) by as much as where
   * forces and displacements are wrong by a tenth or more. In statics those of
   * the last step count, unless it unloads the body. In dynamics, where the
   * last step may be any, it is the mean over time of the squares that count;
   * the first ten steps and each tenth one are looked at. A body whose kinetic
   * energy is larger than what its stresses store, as one that flies or turns,
   * moves rightly by and large even if its stresses are wrong: they are then
   * measured against its kinetic energy, which is the same in a vibration.
   */
  template <int dim>
  class CoarseGridWatch
  {
  public:
    /** Look at the @p n-th step (from 1), which @p unknowns have solved; the
     * points haven't moved yet. @p is_last: the run ends with it. Collective.
     */
    void
    look(const StepContext<dim> &step,
         const NodalField       &unknowns,
         const bool              has_inertia,
         const unsigned int      n,
         const bool              is_last);

    /** After the last step, what the estimate is, for the terminal: empty if
     * there is none, or a warning has told it. */
    const std::string &
    describe() const
    {
      return estimate;
    }

  private:
    /** Over the ranks, of a step or a sum over steps (J). */
    struct Squares
    {
      double error = 0, norm = 0;
      double least   = 0; ///< a norm below is none
      double kinetic = 0; ///< in dynamics
    };
    Squares      of_run;        ///< in dynamics
    unsigned int last_look = 0; ///< the step
    std::string  estimate;

    static Squares
    squares(const StepContext<dim> &step, const NodalField &unknowns);
    static double
    norm_square_at_start(const StepContext<dim> &step,
                         const NodalField       &unknowns);
    /** Warn, or note the estimate. */
    void
    judge(const StepContext<dim> &step,
          const Squares          &squares,
          const bool              of_whole_run);
  };
} // namespace isochor

#endif
