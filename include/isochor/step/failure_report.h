/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_failure_report_h
#define isochor_failure_report_h

#include <isochor/diagnosis/diagnosis.h>
#include <isochor/equations/equation_term.h>
#include <isochor/linear_solver/linear_solver.h>
#include <isochor/nonlinear_solver/load_stepping.h>
#include <isochor/nonlinear_solver/newton_solver.h>
#include <isochor/step/load_change.h>

#include <functional>
#include <string>

namespace isochor
{
  /**
   * What a run that can't go on leaves behind: the last good state and the
   * residual field of the step that failed, as files, and a message that tells
   * a limit load from a bad step and from a scene that was never in
   * equilibrium. For the evidence it looks at each step that converges.
   */
  template <int dim>
  class FailureReport
  {
  public:
    /** What moves the body in a step. */
    struct Drive
    {
      const NodalConstraints &constraints;
      /** Whether boundary points drag the body. */
      bool dragged;
      /** Returns how the loads change, against another interval of time, which
       * takes loops over all points; see Residual::change_of_loads().
       * Collective. */
      std::function<LoadChange(const TimeInterval &)> change_of_loads;
    };

    /** The state of the step that failed. */
    struct Failure
    {
      const StepContext<dim>    &step;
      const NodalField          &unknowns;
      const MixedSystem<dim>    &system;
      const MaterialPoints<dim> &points;
      const LoadStepping        &time;
      const NewtonReport        &newton;
      /** See LinearStep. */
      const long  n_unstable_modes;
      const Drive drive;
      /** Whether loads act, not displacements only. */
      bool loaded;
      bool dynamic;
      /** Whether forces jump when points change cells, see BodyQuadrature. */
      bool               forces_jump;
      const std::string &directory;
      /** Of diagnoses, a line each. */
      const std::string hints;
    };

    /** A step without inertia has converged: remember how fast it moved the
     * body. Steps say nothing in which the body rests but for rounding, or is
     * moved by what is prescribed. Collective. */
    void
    remember(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const Drive            &drive);

    /** How much faster it moves than before, under the same kind of loading. */
    const Softening &
    softening() const
    {
      return soft;
    }

    /** Write the files and return the message: no smaller step is allowed, and
     * none of those tried has a solution. Collective. */
    std::string
    explain(const Failure &failure) const;

    /** Write where the points are, as the files `failure-points...` in
     * @p directory, and return a sentence that says so. Collective. */
    static std::string
    write_points(const StepContext<dim>    &step,
                 const MaterialPoints<dim> &points,
                 const std::string         &directory);

  private:
    /** The largest displacement of a step per time (m/s) and per change of the
     * loads (m/N); negative if that says nothing of the stiffness. */
    struct Softness
    {
      double per_time = -1, per_load = -1;
      /** The largest displacement in units of the smallest cell. */
      double in_cells = 0;
      /** How the loads change, against the first step of the loading. */
      LoadChange loads;

      /** Whether other loads change than in the steps of the loading so far:
       * what is stiff against those says nothing of it. */
      bool
      is_of_other_loading() const;

      /** How much softer it is than the @p stiffest step: the smaller of both
       * ratios, as loads may be faster than the time, and points that change
       * cells move a body whose loads rest. Negative if that isn't known. */
      double
      growth(const Softness &stiffest) const;
      /** "load" or "time". */
      std::string
      measure(const Softness &stiffest) const;
      /** The smaller values of both. */
      void
      take_smaller(const Softness &other);
    };

    /** The largest of what is prescribed in a step (m). Collective. */
    static double
    largest_prescribed(const StepContext<dim> &step, const Drive &drive);

    /** Whether boundary points drag the body, on any rank. Collective. */
    static bool
    is_dragged(const StepContext<dim> &step, const Drive &drive);

    /** @p last is measured against the loading so far: begin another one where
     * it is the first step of it. */
    void
    take_yardstick(const TimeInterval &step);

    /** What is known of the loss of stiffness. */
    struct Evidence
    {
      /** Softness of the last step that converged and of the last iterate of
       * the one that failed, against the stiffest step so far; negative if it
       * isn't known. */
      double growth = -1, growth_of_trial = -1;
      /** Per what the displacement is measured. */
      std::string measure = "load";
      /** Since when the growth has been large; negative if it isn't. */
      double soft_since = -1;
      /** Share of the volume whose plastic strain isn't 0, negative if no
       * material yields. */
      double plastic_share = -1;
      /** Of all materials. */
      bool is_associated = true;
      /** Negative pivots beyond those of the pressures, which any saddle point
       * has; negative if the solver doesn't know. */
      long n_negative_pivots = -1;

      bool
      has_lost_stiffness() const;
      std::string
      text() const;
      /** What follows if it isn't associated. */
      std::string
      advice_on_flow() const;
      /** Where the limit load is, given the times of the last equilibrium and
       * of the step that failed. */
      std::string
      limit(const double last_equilibrium, const double failed) const;
    };

    Evidence
    collect(const Failure &failure) const;

    /** What it is: a limit load, a bad step, or a scene that is wrong.
     * Collective. */
    std::string
    verdict(const Failure &failure, const Evidence &evidence) const;
    static std::string
    verdict_without_loads(const Failure &failure, const Evidence &evidence);
    /** The stiffness is lost before anything yields. */
    static std::string
    verdict_while_elastic(const Failure &failure, const Evidence &evidence);

    /** Whether loads rest in the step that failed, but not all that is
     * prescribed. Collective. */
    bool
    only_prescribed_changes(const Failure &failure) const;

    /** Returns a sentence on where they are, or why they couldn't be written.
     */
    static std::string
    write_files(const Failure &failure);

    /** Collective. */
    Softness
    softness(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const Drive            &drive) const;

    /** The first step of the present loading: as long as it goes on, the change
     * of the loads has the same direction. */
    TimeInterval loading;
    /** Of the step that converged last, and the least of this loading. */
    Softness  last, stiffest;
    Softening soft; ///< of the last steps
  };
} // namespace isochor

#endif
