/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of MaterialPointMethod around the algorithm: parameters, files
// and what is written to the terminal.
#include <deal.II/base/mpi.h>

#include <isochor/base/earlier_output.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/safe_file.h>
#include <isochor/postprocess/body_summary.h>
#include <isochor/step/material_point_method.h>
#include <isochor/step/scene_checks.h>

namespace isochor
{
  template <int dim>
  MaterialPointMethod<dim>::MaterialPointMethod(const MPI_Comm comm)
    : comm(comm)
    , terminal(comm)
    , scene(comm)
    , setup(scene, terminal.timer())
    , equilibrium(scene, setup, terminal)
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
  MaterialPointMethod<dim>::print_work()
  {
    const auto  active = setup.n_active_cells_and_nodes();
    const auto &tria   = scene.grid.triangulation();
    WorkTally  &work   = terminal.work();
    work.count("cells of the grid, at last", true, active.first);
    work.count("cells of the grid, at last",
               false,
               tria.n_active_cells() - active.first);
    work.count("nodes of the grid, at last", true, active.second);
    work.count("nodes of the grid, at last",
               false,
               tria.n_vertices() - active.second);
    terminal.print_work(scene.not_needed());
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
    print_size();
    for (const std::string &text : {earlier, notice})
      if (!text.empty())
        terminal.out() << text << std::endl;
    terminal.reached(scene.time.time);
  }



  template <int dim>
  std::string
  MaterialPointMethod<dim>::explain_failure(const NewtonReport &newton)
  {
    const StepContext<dim> step   = setup.context();
    bool                   loaded = equilibrium.has_dead_loads();
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
              return equilibrium.change_of_loads(other);
            }};
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



  template <int dim>
  void
  MaterialPointMethod<dim>::set_statistics(const StepResult<dim> &result)
  {
    const NewtonReport &newton = result.newton;
    statistics.set("Step", scene.time.step + 1);
    statistics.set("Time (s)", result.step.time);
    statistics.set("Step size (s)", result.step.step_size());
    statistics.set("Newton iterations", newton.n_iterations());
    statistics.set("Factorisations", newton.n_factorisations);
    statistics.set("Step cuts", scene.time.n_cuts);
    if (scene.time.follows_error())
      statistics.set("Error of step (m)", scene.time.error);
    statistics.set("Relative residual of forces",
                   newton.iterations.back().displacement);
    statistics.set("Equations", result.system.matrix().n_equations);
    equilibrium.linear().set_statistics(newton.n_linear_iterations(),
                                        statistics);
    if (!setup.reset().always())
      statistics.set("Step of grid", setup.reset().n_steps() + 1);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::print_size()
  {
    terminal.out() << "Isochor: " << scene.grid.triangulation().n_active_cells()
                   << " cells, " << scene.points.handler().n_global_particles()
                   << " material points, "
                   << (!scene.mixed() ?
                         "u" :
                         (scene.kernel.ppp_coefficient > 0 ? "u-p + PPP" :
                                                             "u-p"))
                   << " form" << std::endl;
    terminal.out() << body_summary(scene.points, comm) << std::endl;
    terminal.out() << material_summary(scene.points,
                                       scene.kernel.materials,
                                       scene.laws,
                                       comm)
                   << std::endl;
    if (scene.has_inertia() && scene.quadrature->forces_jump())
      if (const std::string text = setup.reset().describe(); !text.empty())
        terminal.out() << text << std::endl;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::print_conditions()
  {
    if (scene.time.step > 0)
      return;
    std::string text;
    for (const auto &condition : scene.boundary_conditions)
      if (const std::string of_this = condition->describe(); !of_this.empty())
        text += of_this + '\n';
    // the first step may be repeated, on another grid
    if (text != said_of_conditions)
      terminal.out() << text << std::flush;
    said_of_conditions = text;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::print_progress(const NewtonReport &newton)
  {
    const LoadStepping &time = scene.time;
    terminal.reached(time.time);
    terminal.out() << "Step " << time.step << ": t = " << time.time << ", "
                   << equilibrium.mixed_system().matrix().n_equations
                   << " equations, " << newton.n_iterations()
                   << (newton.n_iterations() == 1 ? " iteration, " :
                                                    " iterations, ")
                   << terminal.time_left(time.end_time()) << " left"
                   << std::endl;
  }



  template class MaterialPointMethod<2>;
  template class MaterialPointMethod<3>;
} // namespace isochor
