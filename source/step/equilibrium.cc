/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/periodic_vertices.h>
#include <isochor/equations/constraint_conflicts.h>
#include <isochor/equations/invariants.h>
#include <isochor/equations/pressure_mapping.h>
#include <isochor/step/equilibrium.h>

#include <utility>
#include <vector>

namespace isochor
{
  template <int dim>
  Equilibrium<dim>::Equilibrium(Scene<dim>     &scene,
                                StepSetup<dim> &setup,
                                Terminal       &terminal)
    : scene(scene)
    , setup(setup)
    , terminal(terminal)
    , body(scene.grid, setup.point_arrays())
    , subscales(scene.grid,
                setup.point_arrays(),
                scene.kernel,
                [&scene] {
                  return find_periodic_images(scene.boundary_conditions);
                })
    , system(setup.active_nodes())
    , residual(scene, setup, constraints, system)
    , linear_step(system, terminal.timer())
  {}



  template <int dim>
  void
  Equilibrium<dim>::declare_parameters(ParameterHandler &prm)
  {
    NewtonSolver::declare_parameters(prm);
    LinearStep<dim>::declare_parameters(prm);
  }



  template <int dim>
  void
  Equilibrium<dim>::parse_parameters(ParameterHandler &prm)
  {
    newton_solver.parse_parameters(prm);
    linear_step.parse_parameters(prm);
  }



  template <int dim>
  void
  Equilibrium<dim>::start_step()
  {
    Assert(!residual.terms.empty(), ExcMessage("initialize() comes first."));
    Assert(is_same_on_all_ranks(scene.time.step, scene.grid.communicator()),
           ExcMessage("Ranks are in different steps."));
    const ActiveNodes<dim> &nodes        = setup.active_nodes();
    const unsigned int      n_components = scene.n_components;
    nodes.initialize(unknowns, n_components);
    residual.start_step();
    linear_step.start_step(nodes, n_components);
    at_start = true;
    set_initial_pressure();
    for (auto *const condition :
         with_role<ActsByAssembly<dim>>(scene.boundary_conditions))
      condition->prepare(setup.context());
    scene.inertia.take_pressures(setup.context(), unknowns);
    scene.inertia.start_step(setup.context(),
                             scene.boundary_conditions,
                             scene.points,
                             carries_acceleration());
    subscales.start_step();
    setup.collect_elements(residual.terms);
    residual.set_loads();
    start_conditions(setup.nodes_have_changed());
    set_weight();
    residual.compute_floor();
  }



  template <int dim>
  void
  Equilibrium<dim>::set_weight()
  {
    if (!scene.kernel.stabilisation.projects_pressures() || scene.has_inertia())
      return;
    Tensor<1, dim> &weight =
      scene.kernel.stabilisation.hydrostatic_acceleration;
    weight = Tensor<1, dim>();
    for (const auto &condition : scene.boundary_conditions)
      weight += condition->body_acceleration(setup.context().time);
    if (scene.kernel.axisymmetric)
      weight[0] = 0.; // radial accelerations add up to none
  }



  template <int dim>
  void
  Equilibrium<dim>::set_initial_pressure()
  {
    if (scene.mixed() && setup.reset().due())
      map_pressure_to_nodes(setup.context(), unknowns);
    else if (scene.mixed()) // the nodes are those of the last step
      last_motion.restore_pressure(setup.active_nodes(),
                                   scene.n_components,
                                   unknowns);
    unknowns.set_ghost_state(true); // ranks write all that they hold themselves
  }



  template <int dim>
  bool
  Equilibrium<dim>::predict()
  {
    // where a motion jumps it doesn't go on
    if (!newton_solver.extrapolate || last_motion.step_size == 0 ||
        scene.time.starts_anew)
      return false;
    last_motion.extrapolate(setup.active_nodes(),
                            setup.all_elements(),
                            scene.n_components,
                            setup.context().step_size() / last_motion.step_size,
                            unknowns);
    return true;
  }



  template <int dim>
  void
  Equilibrium<dim>::remember_motion()
  {
    Assert(invariants::fits(unknowns, setup.active_nodes(), scene.n_components),
           ExcOtherNodes());
    Assert(setup.context().step_size() > 0, ExcInternalError());
    last_motion.remember(setup.active_nodes(),
                         scene.n_components,
                         setup.context().step_size(),
                         unknowns);
  }



  template <int dim>
  void
  Equilibrium<dim>::start_from_rest()
  {
    Assert(invariants::fits(unknowns, setup.active_nodes(), scene.n_components),
           ExcOtherNodes());
    unknowns.zero_out_ghost_values();
    unknowns = 0.;
    set_initial_pressure();
    start_conditions(false);
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::solve()
  {
    Assert(scene.time.next_time() > scene.time.time,
           ExcMessage("The step has no size."));
    const bool   predicted = predict();
    NewtonReport report    = solve_from_start(predicted);
    if (!report.converged && predicted)
      {
        if (terminal.log())
          terminal.out() << "    from rest: " << report.failure << std::endl;
        start_from_rest();
        report = solve_from_start(false);
      }
    return report;
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::solve_from_start(const bool has_other_start)
  {
    const LoadStepping &time = scene.time;
    if (terminal.log())
      terminal.out() << "Step " << time.step + 1
                     << " to t = " << time.next_time()
                     << " (dt = " << time.next_time() - time.time << ")"
                     << std::endl;
    at_start = true;
    return find_root(has_other_start);
  }



  template <int dim>
  void
  Equilibrium<dim>::start_conditions(const bool with_other_nodes)
  {
    constrain_nodes();
    lay_out_system(with_other_nodes);
  }



  template <int dim>
  void
  Equilibrium<dim>::lay_out_system(const bool with_other_nodes)
  {
    const bool laid_out       = system.reinit(with_other_nodes,
                                        scene.n_components,
                                        setup.all_elements(),
                                        constraints,
                                        scene.symmetric);
    system.matrix().may_yield = scene.may_yield;
    terminal.work().count("patterns of the matrix", laid_out);
  }



  template <int dim>
  bool
  Equilibrium<dim>::constrain_nodes()
  {
    const StepContext<dim> step         = setup.context();
    const unsigned int     n_components = scene.n_components;
    const auto             previous     = constraints.constrained;
    const Followers        old          = constraints.followers;
    constraints.reinit(setup.active_nodes().n_local() * n_components,
                       setup.active_nodes().control_entries(n_components));
    isochor::constrain_nodes(scene.boundary_conditions, step, constraints);
    setup.constrain(step, constraints);
    constraints.resolve(n_components);
    const bool changed =
      Utilities::MPI::max(constraints.constrained != previous ||
                              !constraints.followers.same_structure(old) ?
                            1 :
                            0,
                          scene.grid.communicator()) != 0;
    find_conflicts(step, constraints); // errors among them
    scene.inertia.constrain(step,
                            scene.time.next_time(),
                            scene.boundary_conditions,
                            changed,
                            constraints);
    return changed;
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::find_root(const bool has_other_start)
  {
    AssertDimension(constraints.constrained.size(),
                    setup.active_nodes().n_local() * scene.n_components);
    NewtonSolver::Problem problem;
    problem.has_other_start = has_other_start;
    problem.assemble        = [this](const bool with_matrix) {
      return assemble(with_matrix);
    };
    // that of a try which has failed is no good: its correction could not be
    // judged, as the first one of a try may enlarge the residual
    bool may_reuse = last_try_converged;
    problem.solve  = [this, &may_reuse](const bool              factorise,
                                       const SolutionAccuracy &accuracy) {
      may_reuse               = may_reuse || factorise;
      const unsigned int n    = linear_step.solve(unknowns,
                                               constraints,
                                               residual.pending_increments(),
                                               factorise,
                                               accuracy);
      WorkTally         &work = terminal.work();
      work.count("factorisations", factorise);
      work.count("analyses of the matrix",
                 factorise && linear_step.report().analysed);
      return n;
    };
    problem.is_iterative      = [this]() { return linear_step.is_iterative(); };
    problem.has_factorisation = [this, &may_reuse]() {
      return may_reuse && linear_step.has_factorisation();
    };
    problem.advance = [this](const double s) {
      at_start = false;
      linear_step.advance(s, unknowns);
    };
    system.interpolate_followers(unknowns); // wherever it starts from
    const NewtonReport report = newton_solver.solve(problem, terminal.log());
    last_try_converged        = report.converged;
    return report;
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::try_step(const TrialStep &trial)
  {
    Assert(scene.has_inertia(),
           ExcMessage("Only dynamics start with trial steps."));
    InertiaTerm<dim>      &inertia    = scene.inertia;
    const StepContext<dim> step       = setup.context();
    const auto            &conditions = scene.boundary_conditions;
    inertia.start_trial(step, trial, conditions);
    start_again();
    at_start            = true;
    NewtonReport report = trial.size < 0 ? find_root() : solve_from_start();
    if (report.converged)
      inertia.finish_trial(setup.context(), unknowns, setup.point_arrays());
    inertia.end_trial(step, conditions);
    return report;
  }



  template <int dim>
  NewtonReport
  Equilibrium<dim>::find_initial_acceleration()
  {
    NewtonReport        report;
    const LoadStepping &time = scene.time;
    report.converged         = true;
    terminal.work().count("searches for an acceleration",
                          scene.has_inertia() && time.starts_anew);
    if (!scene.has_inertia() || !time.starts_anew)
      return report;
    // a trial errs by O(h); two, one of them back in time, by O(h²)
    const double h = time.next_time() - time.time;
    const bool   moves =
      time.step > 0 || scene.motion_starts.any_moves(scene.grid, 0., h);
    std::vector<TrialStep> trials = {{h, false, h, moves},
                                     {-h, false, h, moves}};
    if (time.step > 0)
      trials.insert(trials.begin(),
                    {{h, true, time.last_size, moves},
                     {-h, true, time.last_size, moves}});
    for (const TrialStep &trial : trials)
      if (report.converged)
        report = try_step(trial);
    if (!report.converged)
      return report;
    scene.inertia.start_step(setup.context(),
                             scene.boundary_conditions,
                             scene.points,
                             carries_acceleration());
    start_again();
    return report;
  }



  template <int dim>
  long
  Equilibrium<dim>::n_unstable_modes(const bool is_old)
  {
    const long supposed = linear_step.n_unstable_modes();
    if (supposed < 0 || (supposed == 0 && !is_old))
      return supposed;
    assemble(true);
    try
      {
        linear_step.factorise();
      }
    catch (const ExcLinearSolverFailed &)
      {
        return -1;
      }
    terminal.work().count("factorisations", true);
    return linear_step.n_unstable_modes();
  }



  template <int dim>
  ResidualNorms
  Equilibrium<dim>::assemble(const bool with_matrix)
  {
    TimerOutput::Scope  scope(terminal.timer(), "assembly");
    const ResidualNorms norms =
      residual.assemble(unknowns, with_matrix, at_start);
    terminal.work().count("assemblies of the matrix", with_matrix);
    if (with_matrix && look_at_matrix)
      {
        const auto look = std::exchange(look_at_matrix, nullptr);
        if (scene.time.step == 0) // resumed: said when it started
          look(setup.context(), system.matrix());
      }
    return norms;
  }



  template class Equilibrium<2>;
  template class Equilibrium<3>;
} // namespace isochor
