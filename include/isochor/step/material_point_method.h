/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_material_point_method_h
#define isochor_material_point_method_h

#include <isochor/base/statistics.h>
#include <isochor/base/terminal.h>
#include <isochor/diagnosis/diagnoses.h>
#include <isochor/scene/scene.h>
#include <isochor/step/checkpoint.h>
#include <isochor/step/equilibrium.h>
#include <isochor/step/failure_report.h>
#include <isochor/step/run_log.h>
#include <isochor/step/step_setup.h>
#include <isochor/transfer/grid_to_points.h>

#include <string>

namespace isochor
{
  /**
   * The stabilised mixed implicit Material Point Method of Iaconeta, Larese,
   * Rossi & Oñate, Comput. Mech. 63 (2019) 1243-1260: the algorithm, with all
   * numerics in the classes it holds. Who holds what, and may write it, is in
   * doc/architecture.md.
   */
  template <int dim>
  class MaterialPointMethod
  {
  public:
    MaterialPointMethod(const MPI_Comm comm);
    ~MaterialPointMethod();

    /** Declare all parameters, with @p n_materials materials in the
     * subsections "Material", "Material 2", ... */
    static void
    declare_parameters(ParameterHandler    &prm,
                       const SceneSections &sections = {});
    void
    parse_parameters(ParameterHandler &prm);

    /** Run the scene. Throws on any failure; what was computed up to then has
     * been written. */
    void
    run();

    /** Set up all that run() sets up, to the equations of the first step, so
     * that mistakes in the scene show. Writes no files. Throws as run(). */
    void
    validate();

    /** The results of the last step, for programs built on this class. */
    const Statistics &
    last_statistics() const
    {
      return statistics;
    }
    const MaterialPoints<dim> &
    material_points() const
    {
      return scene.points;
    }
    const Warnings &
    all_warnings() const
    {
      return diagnoses.warnings();
    }
    /** What was done and what was skipped so far. */
    const WorkTally &
    work() const
    {
      return terminal.work();
    }
    /** What the scene never needs. */
    std::vector<std::string>
    not_needed() const
    {
      return scene.not_needed();
    }

  private:
    void
    set_up();
    /** Find or remove checkpoints and open the statistics. */
    void
    open_output();
    void
    run_steps();
    /** The next step is a smaller one. Throws if it would be too small. */
    void
    cut_step(const NewtonReport &newton);
    /** Why no smaller step is tried: the message for the user. */
    std::string
    explain_failure(const NewtonReport &newton);
    /** What moves the body in this step. Collective. */
    typename FailureReport<dim>::Drive
    drive() const;

    void
    initialisation_phase();
    void
    look_for_starts();
    NewtonReport
    updated_lagrangian_phase();
    /** Let the step of @p report fail if it is less accurate than demanded.
     * Collective. */
    void
    check_error(NewtonReport &report);
    /** See whether the body is stable in the equilibrium that was found.
     * Collective. */
    void
    check_stability(const NewtonReport &report);
    void
    convective_phase(const NewtonReport &newton);
    void
    evaluate_nodes(const StepResult<dim> &result);
    void
    move_points(const ConvergedStep<dim> &converged);
    void
    evaluate_points(const StepResult<dim> &result);

    /** What a checkpoint holds. */
    typename Checkpoint<dim>::State
    state();

    const MPI_Comm comm;
    Terminal       terminal;
    Scene<dim>     scene;
    /** As check_stability() has found, which looks until there are some. */
    long               n_unstable_modes = -1;
    StepSetup<dim>     setup;
    Equilibrium<dim>   equilibrium;
    RunLog<dim>        run_log;
    GridToPoints<dim>  grid_to_points;
    Checkpoint<dim>    checkpoint;
    Diagnoses<dim>     diagnoses;
    FailureReport<dim> failure_report;
    Statistics         statistics;
    std::string        output_directory;
  };
} // namespace isochor

#endif
