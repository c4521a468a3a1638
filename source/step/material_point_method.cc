/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/earlier_output.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/base/safe_file.h>
#include <isochor/postprocess/body_summary.h>
#include <isochor/step/idle_parameters.h>
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
  {}



  template <int dim>
  void
  MaterialPointMethod<dim>::declare_parameters(ParameterHandler    &prm,
                                               const SceneSections &sections)
  {
    Scene<dim>::declare_parameters(prm, sections);
    StepSetup<dim>::declare_parameters(prm);
    Equilibrium<dim>::declare_parameters(prm);
    GridToPoints<dim>::declare_parameters(prm);
    Checkpoint<dim>::declare_parameters(prm);
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
    grid_to_points.parse_parameters(prm, *scene.quadrature, setup.ties_nodes());

    std::vector<std::string> changeable = {"Output/"};
    for (const auto &paths : {Checkpoint<dim>::changeable_parameters(),
                              LoadStepping::changeable_parameters(),
                              NewtonSolver::changeable_parameters(),
                              LinearSolver::changeable_parameters(),
                              Postprocessor<dim>::changeable_parameters()})
      changeable.insert(changeable.end(), paths.begin(), paths.end());
    checkpoint.parse_parameters(prm, changeable);

    prm.enter_subsection("Output");
    output_directory = prm.get("Directory");
    terminal.parse_parameters(prm);
    prm.leave_subsection();
    scene.warnings.print_here(Utilities::MPI::this_mpi_process(comm) == 0);
    warn_of_idle_parameters(prm, scene);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::run()
  {
    try
      {
        set_up();
        open_output();
        run_steps();
      }
    catch (...)
      {
        if (!scene.warnings.all().empty())
          terminal.print_summary(scene.warnings);
        throw;
      }
    terminal.print_times();
    print_work();
    terminal.print_summary(scene.warnings);
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
  MaterialPointMethod<dim>::validate()
  {
    set_up();
    checkpoint.resume_if_asked(scene.grid, output_directory, state());
    print_size();
    setup.restore_moved_grid();
    initialisation_phase();
    equilibrium.evaluate();
    terminal.print_summary(scene.warnings);
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
  void
  MaterialPointMethod<dim>::run_steps()
  {
    if (scene.time.finished())
      scene.warnings.add("nothing left to do",
                         "The checkpoint is of t = " +
                           std::to_string(scene.time.time) +
                           ", <Time/End time> is " +
                           std::to_string(scene.time.end_time()) +
                           ": no step was made. Set a later end to go on.");
    while (!scene.time.finished())
      {
        try
          {
            initialisation_phase();
          }
        catch (const ExcPointsLeftGrid &exc)
          {
            AssertThrow(false,
                        ExcMessage(
                          plain_message(exc) + " " + setup.why_points_left() +
                          FailureReport<dim>::write_points(setup.context(),
                                                           scene.points,
                                                           output_directory)));
          }
        const NewtonReport newton = updated_lagrangian_phase();
        if (newton.converged &&
            setup.repeats_first_step(equilibrium.nodal_unknowns()))
          continue;
        if (newton.converged)
          {
            convective_phase(newton);
            print_progress(newton);
            if (checkpoint.write_if_due(state()))
              setup.start_afresh();
          }
        else
          cut_step(newton);
      }
  }



  /** What the points know goes to the nodes of the grid, which is put back
   * where it was if that is due. */
  template <int dim>
  void
  MaterialPointMethod<dim>::initialisation_phase()
  {
    TimerOutput::Scope scope(terminal.timer(), "initialisation phase");
    setup.start_step(equilibrium.equation_terms(), equilibrium.motion());
    terminal.work().count("searches for all points", setup.was_laid_out());
    equilibrium.start_step();
  }



  /** The nodes find their equilibrium, as in updated Lagrangian finite
   * elements, the points being the quadrature points. */
  template <int dim>
  NewtonReport
  MaterialPointMethod<dim>::updated_lagrangian_phase()
  {
    const NewtonReport initial = equilibrium.find_initial_acceleration();
    return initial.converged ? equilibrium.solve() : initial;
  }



  /** The points take what the nodes have found. */
  template <int dim>
  void
  MaterialPointMethod<dim>::convective_phase(const NewtonReport &newton)
  {
    const StepContext<dim> step     = setup.context();
    const NodalField      &unknowns = equilibrium.nodal_unknowns();
    const StepResult<dim>  result{step,
                                 unknowns,
                                 equilibrium.mixed_system(),
                                 scene.points,
                                 scene.time,
                                 newton,
                                 output_directory,
                                 scene.boundary_conditions};
    {
      TimerOutput::Scope scope(terminal.timer(), "postprocessing");
      set_statistics(result);
      for (auto &postprocessor : scene.postprocessors)
        {
          statistics.set_owner(postprocessor->instance);
          postprocessor->evaluate_nodes(result, statistics);
        }
      for (const auto &condition : scene.boundary_conditions)
        {
          statistics.set_owner(condition->instance);
          condition->evaluate(step,
                              unknowns,
                              equilibrium.mixed_system(),
                              equilibrium.nodal_constraints(),
                              statistics);
        }
      statistics.set_owner("");
      scene.adaptation.set_sizes(step, unknowns, scene.points, statistics);
      scene.adaptation.evaluate(scene.grid, scene.points, statistics);
    }
    {
      TimerOutput::Scope scope(terminal.timer(), "convective phase");
      scene.inertia.finish_step(step, unknowns);
      grid_to_points.transfer(step, unknowns, scene.inertia, scene.points);
      if (setup.ties_nodes())
        setup.ties().evaluate(step,
                              unknowns,
                              equilibrium.mixed_system(),
                              grid_to_points.energy(),
                              statistics);
      equilibrium.remember_motion();
      for (auto &condition : scene.boundary_conditions)
        condition->advance(step, unknowns);
      setup.advance(step, unknowns);
      // on a grid that is kept nothing drifts
      if (setup.reset().due())
        grid_to_points.project_volume(step, scene.points);
      if (!scene.has_inertia())
        failure_report.remember(step, unknowns);
      warn_if_nothing_moves(scene, newton, unknowns);
      scene.time.accept(newton.n_factorisations);
    }
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
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::cut_step(const NewtonReport &newton)
  {
    LoadStepping &time = scene.time;
    AssertThrow(time.can_be_cut(), ExcMessage(explain_failure(newton)));
    terminal.out() << "Step " << time.step + 1 << " to t = " << time.next_time()
                   << " is cut: " << newton.failure << std::endl;
    time.reject(newton.failure);
  }



  template <int dim>
  std::string
  MaterialPointMethod<dim>::explain_failure(const NewtonReport &newton)
  {
    const StepContext<dim> step    = setup.context();
    bool                   dragged = false;
    bool                   loaded  = equilibrium.has_dead_loads();
    for (const auto &condition : scene.boundary_conditions)
      {
        dragged = dragged || condition->moves_body(step);
        loaded  = loaded || condition->follows_body();
      }
    return failure_report.explain({step,
                                   equilibrium.nodal_unknowns(),
                                   equilibrium.mixed_system(),
                                   scene.points,
                                   scene.time,
                                   newton,
                                   equilibrium.linear().report(),
                                   equilibrium.nodal_constraints(),
                                   dragged,
                                   loaded,
                                   scene.has_inertia(),
                                   output_directory});
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
            scene.postprocessors};
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
