/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/postprocess/body_summary.h>
#include <isochor/step/run_log.h>

namespace isochor
{
  template <int dim>
  RunLog<dim>::RunLog(Terminal               &terminal,
                      const Scene<dim>       &scene,
                      const StepSetup<dim>   &setup,
                      const Equilibrium<dim> &equilibrium)
    : terminal(terminal)
    , scene(scene)
    , setup(setup)
    , equilibrium(equilibrium)
  {}



  template <int dim>
  void
  RunLog<dim>::print_work()
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
  RunLog<dim>::set_statistics(const StepResult<dim> &result,
                              Statistics            &statistics)
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
  RunLog<dim>::print_size()
  {
    terminal.out() << "Isochor: " << scene.grid.triangulation().n_active_cells()
                   << " cells, " << scene.points.handler().n_global_particles()
                   << " material points, "
                   << (!scene.mixed() ?
                         "u" :
                         (scene.kernel.stabilisation.has_orthogonal_subscales ?
                            "u-p + OSS" :
                          scene.kernel.stabilisation.coefficient > 0 ?
                            "u-p + PPP" :
                            "u-p"))
                   << " form" << std::endl;
    const MPI_Comm comm = scene.grid.communicator();
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
  RunLog<dim>::print_conditions()
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
  RunLog<dim>::print_progress(const NewtonReport &newton)
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



  template class RunLog<2>;
  template class RunLog<3>;
} // namespace isochor
