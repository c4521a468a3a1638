/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The algorithm: a run, its steps, and their three phases.
#include <isochor/base/earlier_output.h>
#include <isochor/base/plain_message.h>
#include <isochor/step/material_point_method.h>
#include <isochor/step/why_points_left.h>

namespace isochor
{
  template <int dim>
  void
  MaterialPointMethod<dim>::run()
  {
    try
      {
        set_up();
        open_output();
        const auto start = start_of_output(output_directory);
        run_steps();
        terminal.print_times();
        run_log.print_work();
        terminal.out() << diagnoses.run_ended()
                       << describe_results(output_directory, start)
                       << std::endl;
      }
    catch (...)
      {
        if (!diagnoses.warnings().all().empty())
          terminal.print_summary(diagnoses.warnings());
        throw;
      }
    terminal.print_summary(diagnoses.warnings());
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::run_steps()
  {
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
                          plain_message(exc) + " " +
                          why_points_left(exc.boundaries,
                                          scene,
                                          setup.walls(),
                                          setup.reset()) +
                          FailureReport<dim>::write_points(setup.context(),
                                                           scene.points,
                                                           output_directory)));
          }
        run_log.print_conditions();
        const NewtonReport newton = updated_lagrangian_phase();
        if (!newton.converged)
          cut_step(newton);
        else if (!setup.repeats_first_step(equilibrium.nodal_unknowns()))
          {
            convective_phase(newton);
            run_log.print_progress(newton);
            if (checkpoint.write_if_due(state()))
              setup.start_afresh();
          }
      }
  }



  /** What the points know goes to the nodes of the grid, which is put back
   * where it was if that is due. */
  template <int dim>
  void
  MaterialPointMethod<dim>::initialisation_phase()
  {
    TimerOutput::Scope scope(terminal.timer(), "initialisation phase");
    setup.start_step(equilibrium.equations().terms, equilibrium.motion());
    terminal.work().count("searches for all points", setup.was_laid_out());
    if (scene.has_inertia())
      look_for_starts();
    equilibrium.start_step();
    diagnoses.each([&](Diagnosis<dim> &diagnosis) {
      diagnosis.step_started(scene,
                             setup.context(),
                             equilibrium.nodal_constraints());
      if (setup.was_laid_out())
        diagnosis.grid_reset(scene,
                             setup.context(),
                             setup.all_elements(),
                             !setup.reset().always());
    });
  }



  /** The nodes find their equilibrium, as in updated Lagrangian finite
   * elements, the points being the quadrature points. */
  template <int dim>
  NewtonReport
  MaterialPointMethod<dim>::updated_lagrangian_phase()
  {
    const NewtonReport initial = equilibrium.find_initial_acceleration();
    if (!initial.converged)
      return initial;
    NewtonReport report = equilibrium.solve();
    if (report.converged)
      check_error(report);
    if (report.converged && !scene.has_inertia() && n_unstable_modes <= 0)
      check_stability(report);
    return report;
  }



  /** The points take what the nodes have found. */
  template <int dim>
  void
  MaterialPointMethod<dim>::convective_phase(const NewtonReport &newton)
  {
    Assert(newton.converged,
           ExcMessage("The points take what is in equilibrium."));
    const StepContext<dim> step     = setup.context();
    const NodalField      &unknowns = equilibrium.nodal_unknowns();
    const StepResult<dim>  result{step,
                                 unknowns,
                                 equilibrium.mixed_system(),
                                 scene.points,
                                 scene.time,
                                 newton,
                                 output_directory,
                                 scene.boundary_conditions,
                                 scene.inertia.work_of_jump(step,
                                                            scene.points,
                                                            scene.time),
                                 scene.inertia.unknowns_at_start(),
                                 equilibrium.subscale_energy()};
    evaluate_nodes(result);
    const ConvergedStep<dim> converged{scene,
                                       result,
                                       equilibrium.nodal_constraints(),
                                       setup.ties(),
                                       scene.time.is_last_step(),
                                       n_unstable_modes,
                                       equilibrium.linear().failure(),
                                       grid_to_points.volume_excess(),
                                       failure_report.softening()};
    diagnoses.each(
      [&](Diagnosis<dim> &diagnosis) { diagnosis.step_converged(converged); });
    move_points(converged);
    evaluate_points(result);
    diagnoses.each(
      [&](Diagnosis<dim> &diagnosis) { diagnosis.step_ended(converged); });
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::move_points(const ConvergedStep<dim> &converged)
  {
    TimerOutput::Scope      scope(terminal.timer(), "convective phase");
    const StepContext<dim> &step     = converged.result.step;
    const NodalField       &unknowns = converged.result.unknowns;
    scene.inertia.finish_step(step, unknowns, equilibrium.force_of_mean());
    grid_to_points.transfer(
      step, unknowns, scene.inertia, scene.points, setup.point_arrays());
    if (setup.ties_nodes())
      setup.ties().evaluate(step,
                            unknowns,
                            equilibrium.mixed_system(),
                            grid_to_points.energy(),
                            statistics);
    equilibrium.remember_motion();
    if (!scene.has_inertia())
      failure_report.remember(step, unknowns, drive());
    diagnoses.each(
      [&](Diagnosis<dim> &diagnosis) { diagnosis.points_moved(converged); });
    for (auto &condition : scene.boundary_conditions)
      condition->advance(step, unknowns);
    setup.advance(step, unknowns);
    grid_to_points.pass_unseen_volume(step,
                                      setup.reset().due(),
                                      scene.points,
                                      setup.point_arrays());
    scene.time.accept(converged.result.newton.n_factorisations);
  }



  template void
  MaterialPointMethod<2>::run();
  template void
  MaterialPointMethod<3>::run();
  template void
  MaterialPointMethod<2>::initialisation_phase();
  template void
  MaterialPointMethod<3>::initialisation_phase();
} // namespace isochor
