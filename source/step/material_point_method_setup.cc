/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// What surrounds the algorithm: parameters, files, whether a step is accepted,
// and what is evaluated in it.
#include <deal.II/base/mpi.h>

#include <isochor/base/earlier_output.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/base/safe_file.h>
#include <isochor/equations/cells_crossed.h>
#include <isochor/step/material_point_method.h>
#include <isochor/step/scene_checks.h>
#include <isochor/transfer/volume_error.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  template <int dim>
  MaterialPointMethod<dim>::MaterialPointMethod(const MPI_Comm comm)
    : comm(comm)
    , terminal(comm)
    , scene(comm)
    , setup(scene, terminal.timer())
    , equilibrium(scene, setup, terminal)
    , run_log(terminal, scene, setup, equilibrium)
    , diagnoses(terminal.timer())
  {}



  // not for each program that uses the class: it is long to compile
  template <int dim>
  MaterialPointMethod<dim>::~MaterialPointMethod() = default;



  template <int dim>
  void
  MaterialPointMethod<dim>::declare_parameters(ParameterHandler    &prm,
                                               const SceneSections &sections)
  {
    Scene<dim>::declare_parameters(prm, sections);
    StepSetup<dim>::declare_parameters(prm);
    Equilibrium<dim>::declare_parameters(prm);
    Checkpoint<dim>::declare_parameters(prm);
    Diagnoses<dim>::declare_parameters(prm);
    prm.enter_subsection("Output");
    prm.declare_entry("Directory",
                      "output",
                      Patterns::Anything(),
                      "Where all files of the run go; made if missing.");
    Terminal::declare_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::parse_parameters(ParameterHandler &prm)
  {
    scene.parse_parameters(prm);
    setup.parse_parameters(prm);
    equilibrium.parse_parameters(prm);
    grid_to_points.measure_energy(setup.ties_nodes());

    std::vector<std::string> changeable = {"Output/"};
    for (const auto &paths : {Checkpoint<dim>::changeable_parameters(),
                              LoadStepping::changeable_parameters(),
                              NewtonSolver::changeable_parameters(),
                              LinearSolver::changeable_parameters(),
                              Postprocessor<dim>::changeable_parameters(),
                              Diagnoses<dim>::changeable_parameters()})
      changeable.insert(changeable.end(), paths.begin(), paths.end());
    checkpoint.parse_parameters(prm, changeable);

    prm.enter_subsection("Output");
    output_directory = prm.get("Directory");
    terminal.parse_parameters(prm);
    prm.leave_subsection();
    diagnoses.parse_parameters(prm,
                               Utilities::MPI::this_mpi_process(comm) == 0);
    diagnoses.each([&](Diagnosis<dim> &diagnosis) {
      diagnosis.scene_read(prm, scene, setup.reset());
    });
    equilibrium.look_at_first_matrix(
      [this](const StepContext<dim> &step, const SparseSystem &matrix) {
        check_first_step(scene, step);
        diagnoses.each([&](Diagnosis<dim> &diagnosis) {
          diagnosis.step_set_up(scene, step, matrix);
        });
      });
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::set_up()
  {
    TimerOutput::Scope scope(terminal.timer(), "setup");
    scene.create(setup.point_arrays());
    setup.initialize();
    equilibrium.initialize();
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::validate()
  {
    set_up();
    checkpoint.resume_if_asked(scene.grid, output_directory, state());
    run_log.print_size();
    setup.restore_moved_grid();
    initialisation_phase();
    run_log.print_conditions();
    equilibrium.evaluate();
    terminal.print_summary(diagnoses.warnings());
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::open_output()
  {
    const std::string earlier =
      checkpoint.resumes() ? "" : describe_earlier_output(output_directory);
    const std::string notice =
      checkpoint.start(scene.grid, output_directory, state());
    setup.restore_moved_grid();
    run_on_all_ranks(comm, [&]() {
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        statistics.open(output_directory + "/statistics.txt", scene.time.step);
    });
    run_log.print_size();
    for (const std::string &text : {earlier, notice})
      if (!text.empty())
        terminal.out() << text << std::endl;
    if (scene.time.finished())
      terminal.out() << "Nothing left to do: the checkpoint is of t = "
                     << scene.time.time << ", <Time/End time> is "
                     << scene.time.end_time() << '.' << std::endl;
    terminal.reached(scene.time.time);
  }



  template <int dim>
  typename Checkpoint<dim>::State
  MaterialPointMethod<dim>::state()
  {
    return {scene.points,
            scene.time,
            equilibrium.motion(),
            setup,
            scene.boundary_conditions,
            scene.postprocessors,
            diagnoses};
  }



  /** Where a prescribed motion starts or changes at once a step begins, and the
   * body follows, as at t = 0. */
  template <int dim>
  void
  MaterialPointMethod<dim>::look_for_starts()
  {
    LoadStepping &time = scene.time;
    time.aim_at(std::numeric_limits<double>::infinity());
    // what is so near to where the last step has ended is there; see
    // LoadStepping::next_time()
    const double near = 1e-3 * time.last_size;
    time.starts_anew =
      time.step == 0 ||
      scene.motion_starts.next(time.time - near, time.time + near) <
        time.end_time();
    // in this step or, so that none is short, the next
    time.aim_at(scene.motion_starts.next(time.time + near,
                                         2 * time.next_time() - time.time));
  }



  /** What is known isn't looked for again. The last step must not go by a
   * factorisation of an earlier one. */
  template <int dim>
  void
  MaterialPointMethod<dim>::check_stability(const NewtonReport &report)
  {
    Assert(report.converged && !scene.has_inertia(), ExcInternalError());
    n_unstable_modes = equilibrium.n_unstable_modes(
      scene.time.is_last_step() && report.n_factorisations == 0);
  }



  namespace
  {
    /** Why a step in which material flows is none: Newton's method may also
     * end where points swell beside others that vanish. Elastic shapes resist
     * that. Empty otherwise. Collective. */
    template <int dim>
    std::string
    lost_volume(const StepContext<dim>    &step,
                const MaterialPoints<dim> &points,
                const NodalField          &unknowns)
    {
      constexpr double lost      = 0.2;
      const auto      &materials = step.kernel.materials;
      if (!step.mixed() || std::none_of(materials.begin(),
                                        materials.end(),
                                        [](const auto &material) {
                                          return material != nullptr &&
                                                 material->dissipates();
                                        }))
        return {};
      const double error =
        volume_error(step, points, volume_excesses(step, unknowns), lost)
          .largest();
      return error > lost ?
               "material that flows loses its volume, points differ by " +
                 rounded(100 * error) + " % from what the pressure asks for" :
               "";
    }
  } // namespace



  /** A step that has lost volume, that a condition objects to, or that is too
   * inaccurate is none, but the last of them if it is the smallest. */
  template <int dim>
  void
  MaterialPointMethod<dim>::check_error(NewtonReport &report)
  {
    const StepContext<dim> step = setup.context();
    report.failure =
      lost_volume(step, scene.points, equilibrium.nodal_unknowns());
    for (const auto *const condition :
         with_role<ActsByAssembly<dim>>(scene.boundary_conditions))
      if (report.failure.empty())
        report.failure =
          condition->objection(step, equilibrium.nodal_unknowns());
    report.converged = report.failure.empty();
    if (!report.converged || !scene.time.follows_error())
      return;
    const double error =
      scene.inertia.error_of_step(step, equilibrium.nodal_unknowns());
    const double crossed = cells_crossed(step, equilibrium.nodal_unknowns());
    report.converged     = scene.time.tolerates(error, crossed);
    if (!report.converged)
      report.failure = scene.time.exceeds_error() ?
                         "its displacements are wrong by " + rounded(error) +
                           " m, more than <Time/Tolerated error>" :
                         "the body moves by " + rounded(crossed) + " cells";
  }



  template <int dim>
  std::string
  MaterialPointMethod<dim>::explain_failure(const NewtonReport &newton)
  {
    const StepContext<dim> step   = setup.context();
    bool                   loaded = equilibrium.equations().has_dead_loads();
    for (const auto *const condition :
         with_role<const ActsByAssembly<dim>>(scene.boundary_conditions))
      loaded = loaded || condition->assembles_load(step);
    return failure_report.explain({step,
                                   equilibrium.nodal_unknowns(),
                                   equilibrium.mixed_system(),
                                   scene.points,
                                   scene.time,
                                   newton,
                                   equilibrium.linear().n_unstable_modes(),
                                   drive(),
                                   loaded,
                                   scene.has_inertia(),
                                   scene.quadrature->forces_jump(),
                                   output_directory,
                                   diagnoses.run_failed()});
  }



  template <int dim>
  typename FailureReport<dim>::Drive
  MaterialPointMethod<dim>::drive() const
  {
    const StepContext<dim> step    = setup.context();
    bool                   dragged = false;
    for (const auto *const condition :
         with_role<const ActsByAssembly<dim>>(scene.boundary_conditions))
      dragged = dragged || condition->moves_body(step);
    return {equilibrium.nodal_constraints(),
            dragged,
            [this](const TimeInterval &other) {
              return equilibrium.equations().change_of_loads(other);
            }};
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::cut_step(const NewtonReport &newton)
  {
    Assert(!newton.converged, ExcMessage("The step has a solution."));
    LoadStepping &time = scene.time;
    AssertThrow(time.can_be_cut(), ExcMessage(explain_failure(newton)));
    terminal.out() << "Step " << time.step + 1 << " to t = " << time.next_time()
                   << " is cut: " << newton.failure << std::endl;
    time.reject(newton.failure);
    equilibrium.discard_step();
  }



  /** What the solution at the nodes tells, before the points move. */
  template <int dim>
  void
  MaterialPointMethod<dim>::evaluate_nodes(const StepResult<dim> &result)
  {
    TimerOutput::Scope scope(terminal.timer(), "postprocessing");
    run_log.set_statistics(result, statistics);
    for (auto &postprocessor : scene.postprocessors)
      {
        statistics.set_owner(postprocessor->instance);
        postprocessor->evaluate_nodes(result, statistics);
      }
    for (const auto &condition : scene.boundary_conditions)
      {
        statistics.set_owner(condition->instance);
        condition->evaluate(result.step,
                            result.unknowns,
                            result.system,
                            equilibrium.nodal_constraints(),
                            statistics);
      }
    statistics.set_owner("");
    if (scene.adaptation.needs_sizes())
      scene.adaptation.set_sizes(result.step,
                                 result.unknowns,
                                 scene.points,
                                 statistics);
    setup.evaluate(statistics);
  }



  /** What the points tell that have moved: the row of statistics is complete.
   */
  template <int dim>
  void
  MaterialPointMethod<dim>::evaluate_points(const StepResult<dim> &result)
  {
    TimerOutput::Scope scope(terminal.timer(), "postprocessing");
    for (auto &postprocessor : scene.postprocessors)
      {
        statistics.set_owner(postprocessor->instance);
        postprocessor->evaluate_points(result, statistics);
      }
    statistics.set_owner("");
    statistics.end_row();
    terminal.work().count("outputs of fields", scene.time.output_due());
  }



  template class MaterialPointMethod<2>;
  template class MaterialPointMethod<3>;
} // namespace isochor
