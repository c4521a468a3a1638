/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The algorithm. What surrounds it, parameters, files and what is written to
// the terminal, is in material_point_method_interface.cc.
#include <isochor/base/earlier_output.h>
#include <isochor/base/plain_message.h>
#include <isochor/base/rounding.h>
#include <isochor/equations/cells_crossed.h>
#include <isochor/step/material_point_method.h>

#include <limits>

namespace isochor
{
  /** Whether the step to the next time ends the run. */
  static bool
  is_last_step(const LoadStepping &time)
  {
    return time.next_time() >= (1 - rounding::accumulated) * time.end_time();
  }



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
        print_work();
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
  MaterialPointMethod<dim>::validate()
  {
    set_up();
    checkpoint.resume_if_asked(scene.grid, output_directory, state());
    print_size();
    setup.restore_moved_grid();
    initialisation_phase();
    print_conditions();
    equilibrium.evaluate();
    terminal.print_summary(diagnoses.warnings());
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::run_steps()
  {
    if (scene.time.finished())
      terminal.out() << "Nothing left to do: the checkpoint is of t = "
                     << scene.time.time << ", <Time/End time> is "
                     << scene.time.end_time() << '.' << std::endl;
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
                          setup.why_points_left(exc.boundaries) +
                          FailureReport<dim>::write_points(setup.context(),
                                                           scene.points,
                                                           output_directory)));
          }
        print_conditions();
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
    if (report.converged && scene.time.follows_error())
      check_error(report);
    if (report.converged && !scene.has_inertia() && n_unstable_modes <= 0)
      check_stability(report);
    return report;
  }



  /** What is known isn't looked for again. The last step must not go by a
   * factorisation of an earlier one. */
  template <int dim>
  void
  MaterialPointMethod<dim>::check_stability(const NewtonReport &report)
  {
    n_unstable_modes = equilibrium.n_unstable_modes(
      is_last_step(scene.time) && report.n_factorisations == 0);
  }



  /** A step that is too inaccurate is none, unless it is the smallest. */
  template <int dim>
  void
  MaterialPointMethod<dim>::check_error(NewtonReport &report)
  {
    const StepContext<dim> step = setup.context();
    const double           error =
      scene.inertia.error_of_step(step, equilibrium.nodal_unknowns());
    const double crossed = cells_crossed(step, equilibrium.nodal_unknowns());
    report.converged     = scene.time.tolerates(error, crossed);
    if (!report.converged)
      report.failure = scene.time.exceeds_error() ?
                         "its displacements are wrong by " + rounded(error) +
                           " m, more than <Time/Tolerated error>" :
                         "the body moves by " + rounded(crossed) + " cells";
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
                                 scene.boundary_conditions,
                                 scene.inertia.work_of_jump(step,
                                                            scene.points,
                                                            scene.time),
                                 scene.inertia.unknowns_at_start()};
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
      if (scene.adaptation.needs_sizes())
        scene.adaptation.set_sizes(step, unknowns, scene.points, statistics);
      setup.evaluate(statistics);
    }
    const ConvergedStep<dim> converged{scene,
                                       result,
                                       equilibrium.nodal_constraints(),
                                       setup.ties(),
                                       is_last_step(scene.time),
                                       n_unstable_modes,
                                       equilibrium.linear().failure(),
                                       grid_to_points.volume_excess(),
                                       failure_report.softening()};
    diagnoses.each(
      [&](Diagnosis<dim> &diagnosis) { diagnosis.step_converged(converged); });
    {
      TimerOutput::Scope scope(terminal.timer(), "convective phase");
      scene.inertia.finish_step(step, unknowns);
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
      if (setup.reset().due())
        grid_to_points.forget_unseen_volume(step, scene.points);
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
    diagnoses.each(
      [&](Diagnosis<dim> &diagnosis) { diagnosis.step_ended(converged); });
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
    equilibrium.discard_step();
  }



  template void
  MaterialPointMethod<2>::run();
  template void
  MaterialPointMethod<2>::validate();
  template void
  MaterialPointMethod<3>::run();
  template void
  MaterialPointMethod<3>::validate();
} // namespace isochor
