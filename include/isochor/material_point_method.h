/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_material_point_method_h
#define isochor_material_point_method_h

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <isochor/body_quadrature.h>
#include <isochor/body_term.h>
#include <isochor/boundary_condition.h>
#include <isochor/checkpoint.h>
#include <isochor/discrete_extension.h>
#include <isochor/failure_report.h>
#include <isochor/grid_adaptation.h>
#include <isochor/grid_reset.h>
#include <isochor/inertia_term.h>
#include <isochor/linear_solver.h>
#include <isochor/load_stepping.h>
#include <isochor/newton_solver.h>
#include <isochor/point_refinement.h>
#include <isochor/point_spacing.h>
#include <isochor/postprocessor.h>
#include <isochor/remaining_time.h>
#include <isochor/volume_projection.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * The stabilised mixed implicit Material Point Method of Iaconeta, Larese,
   * Rossi & Oñate, Comput. Mech. 63 (2019) 1243-1260: the algorithm, with all
   * numerics in the classes it holds.
   */
  template <int dim>
  class MaterialPointMethod
  {
  public:
    MaterialPointMethod(const MPI_Comm comm);

    /** Declare all parameters, with @p n_materials materials in the
     * subsections "Material", "Material 2", ... */
    static void
    declare_parameters(ParameterHandler  &prm,
                       const unsigned int n_materials = 1);
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
      return points;
    }
    const Warnings &
    all_warnings() const
    {
      return warnings;
    }

  private:
    void
    setup();
    void
    find_walls();
    /** Find or remove checkpoints and open the statistics. */
    void
    open_output();
    /** The moving grid of a resumed run is that of the last reset. */
    void
    restore_moved_grid();
    void
    print_size();
    void
    print_warning_count();
    void
    run_steps();
    /** Warn of what can't be meant, with the first matrix. */
    void
    check_scene();
    void
    warn_if_nothing_moves(const NewtonReport &newton);
    void
    set_solver_statistics(const NewtonReport &newton);
    /** Why no smaller step is tried: the message for the user. */
    std::string
    explain_failure(const NewtonReport &newton);
    /** Tell on the terminal that a step is done, and how long the rest takes.
     */
    void
    print_progress(const NewtonReport &newton);

    void
    initialisation_phase();
    NewtonReport
    updated_lagrangian_phase();
    NewtonReport
    find_equilibrium();
    void
    convective_phase(const NewtonReport &newton);

    /** What a checkpoint holds. */
    typename Checkpoint<dim>::State
    state();

    StepContext<dim>
    context();
    /** Put the grid back, find where the points are in it, and set up all that
     * follows from it. */
    void
    reset_grid();
    /** The grid has been replaced: tell what knows it. */
    void
    grid_changed();
    /** Adapt the grid to the solution of the first step, if that is to be
     * solved once more; whether it is. */
    bool
    repeat_first_step();
    /** Put where Newton's method starts without a predictor into the unknowns.
     */
    void
    set_initial_pressure();
    bool
    predict();
    void
    start_from_rest();
    void
    compute_residual_floor();
    /** In the first step of a dynamic scene: give the points the acceleration
     * with which the body answers what acts on it at t = 0, so that it
     * satisfies the pressure equation. Newmark's scheme starts from it, and
     * would carry an error in it along. See InertiaTerm::start_trial(). */
    NewtonReport
    find_initial_acceleration();
    /** The first step from its start, with other equations. */
    void
    start_again();
    void
    prepare_system();
    /** Begin the search for the nodes in contact, with those of the last step,
     * and lay out the system for it. */
    void
    start_contact(const bool with_other_nodes);
    /** One-sided boundaries: hold and release nodes where Newton's result,
     * that of @p report, violates a condition. Whether there is something to
     * solve again; a search that does not settle makes the report a failure. */
    bool
    change_contact(NewtonReport &report);
    void
    set_external_force();
    /** Constrain the nodes anew; whether that made a difference on any rank. */
    bool
    constrain_nodes();
    ResidualNorms
    assemble(const bool with_matrix);
    unsigned int
    solve_linear_system(const bool factorise);

    const MPI_Comm     comm;
    ConditionalOStream pcout;
    bool               verbose = false;
    TimerOutput        timer;
    Timer              clock;
    RemainingTime      remaining_time;
    Warnings           warnings;

    BackgroundGrid<dim>                grid;
    MaterialPoints<dim>                points;
    BodyShape<dim>                     shape;
    std::unique_ptr<PointLocator<dim>> locator;

    /** The state of one step. */
    PointArrays<dim> arrays;
    ActiveNodes<dim> nodes;
    bool             nodes_changed = false;
    /** Whether the step to come must not use what the last one left in the
     * solver: a resumed run has none of it. */
    bool             start_afresh = false;
    MixedSystem<dim> system;
    NodalConstraints constraints;
    NodalField       unknowns, base_unknowns, correction, pending;
    NodalField       external_force;
    /** Forces of the boundary conditions that are terms of the equations. */
    NodalField boundary_force;
    /** Whether the iterate is where the step starts. */
    bool   at_start    = true;
    double force_floor = 0, volume_floor = 0;

    LastMotion last_motion;

    /** The terms of the equations, in the order of their elements. */
    std::vector<EquationTerm<dim> *> terms;

    MixedKernel<dim>     kernel;
    BodyTerm<dim>        body;
    BodyQuadrature<dim>  quadrature;
    CellOccupancy<dim>   occupancy;
    PointRefinement<dim> refinement;
    PointSpacing<dim>    spacing;
    /** Whether it is used, see DiscreteExtension::is_active(). */
    bool                   extends = false;
    DiscreteExtension<dim> extension;
    bool                   needs_occupancy = false;
    /** What DiscreteExtension::evaluate() compares with. */
    double                                               step_energy = 0;
    VolumeProjection<dim>                                volume_projection;
    bool                                                 project_volume = false;
    InertiaTerm<dim>                                     inertia;
    bool                                                 dynamic = false;
    GridReset<dim>                                       grid_reset;
    GridAdaptation<dim>                                  adaptation;
    unsigned int                                         n_first_solutions = 0;
    std::vector<std::unique_ptr<BoundaryCondition<dim>>> boundary_conditions;
    std::vector<std::unique_ptr<Postprocessor<dim>>>     postprocessors;
    std::unique_ptr<LinearSolver>                        linear_solver;
    NewtonSolver                                         newton_solver;
    LoadStepping                                         time;
    LinearSolverReport                                   solver_report;
    FailureReport<dim>                                   failure_report;
    bool                                                 scene_checked = false;
    Statistics                                           statistics;
    Checkpoint<dim>                                      checkpoint;

    unsigned int                  n_components = dim + 1;
    bool                          symmetric    = true;
    std::string                   output_directory;
    TrilinosWrappers::MPI::Vector rhs, solution;
    /** The pattern of the matrix last factorised, 0 for none. */
    unsigned long factorised_pattern = 0;
  };
} // namespace isochor

#endif
