/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_run_log_h
#define isochor_run_log_h

#include <isochor/base/statistics.h>
#include <isochor/base/terminal.h>
#include <isochor/scene/scene.h>
#include <isochor/step/equilibrium.h>
#include <isochor/step/step_setup.h>

namespace isochor
{
  /** What a run tells of itself: on the terminal, and of each step's solution
   * in the statistics. All it refers to has to live longer. */
  template <int dim>
  class RunLog
  {
  public:
    RunLog(Terminal               &terminal,
           const Scene<dim>       &scene,
           const StepSetup<dim>   &setup,
           const Equilibrium<dim> &equilibrium);

    /** The size of the grid, of the body and what it is made of. Collective. */
    void
    print_size();
    /** What the boundary conditions act on, in the first step. */
    void
    print_conditions();
    /** Tell that a step is done, and how long the rest takes. */
    void
    print_progress(const NewtonReport &newton);
    /** What was done and skipped, at the end. Collective. */
    void
    print_work();
    /** How the step of @p result was solved. */
    void
    set_statistics(const StepResult<dim> &result, Statistics &statistics);

  private:
    Terminal               &terminal;
    const Scene<dim>       &scene;
    const StepSetup<dim>   &setup;
    const Equilibrium<dim> &equilibrium;
    std::string             said_of_conditions; ///< by print_conditions()
  };
} // namespace isochor

#endif
