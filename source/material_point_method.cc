/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/body_summary.h>
#include <isochor/earlier_output.h>
#include <isochor/idle_parameters.h>
#include <isochor/material_point_method.h>
#include <isochor/mpi_sums.h>
#include <isochor/plain_message.h>
#include <isochor/point_update.h>
#include <isochor/pressure_mapping.h>
#include <isochor/safe_file.h>
#include <isochor/scene_checks.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

namespace isochor
{
  namespace
  {
    std::string
    material_section(const unsigned int material)
    {
      return material == 0 ? "Material" :
                             "Material " + std::to_string(material + 1);
    }
  } // namespace



  template <int dim>
  MaterialPointMethod<dim>::MaterialPointMethod(const MPI_Comm comm)
    : comm(comm)
    , pcout(std::cout, false)
    , timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
    , grid(comm)
    , points(grid)
    , nodes(grid)
    , system(nodes)
    , body(grid, arrays)
    , quadrature(grid)
    , occupancy(grid)
    , spacing(grid)
    , extension(grid, occupancy)
    , grid_reset(arrays, extension)
  {}



  template <int dim>
  void
  MaterialPointMethod<dim>::declare_parameters(ParameterHandler  &prm,
                                               const unsigned int n_materials)
  {
    BackgroundGrid<dim>::declare_parameters(prm);
    MaterialPoints<dim>::declare_parameters(prm);
    NewtonSolver::declare_parameters(prm);
    LoadStepping::declare_parameters(prm);
    Checkpoint<dim>::declare_parameters(prm);
    InertiaTerm<dim>::declare_parameters(prm);
    BodyQuadrature<dim>::declare_parameters(prm);
    DiscreteExtension<dim>::declare_parameters(prm);
    PointRefinement<dim>::declare_parameters(prm);
    GridReset<dim>::declare_parameters(prm);
    GridAdaptation<dim>::declare_parameters(prm);
    VolumeProjection<dim>::declare_parameters(prm);

    prm.enter_subsection("Formulation");
    prm.declare_entry("Type",
                      "u-p",
                      Patterns::Selection("u|u-p"),
                      "Displacements as the only unknowns, or displacements "
                      "and pressure.");
    prm.declare_entry("Stabilisation",
                      "PPP",
                      Patterns::Selection("none|PPP"),
                      "Of u-p: none, or Polynomial Pressure Projection.");
    prm.declare_entry("PPP coefficient",
                      "1",
                      Patterns::Double(0),
                      "The factor alpha of alpha/G in the stabilisation; "
                      "useful are 1 to 8.");
    prm.leave_subsection();

    for (unsigned int m = 0; m < n_materials; ++m)
      {
        prm.enter_subsection(material_section(m));
        prm.declare_entry("Model",
                          "Neo-Hookean",
                          Patterns::Selection(
                            PluginRegistry<MaterialModel<dim>>::names()),
                          "The constitutive law.");
        IsotropicElasticity::declare_parameters(prm);
        PluginRegistry<MaterialModel<dim>>::declare_parameters(prm);
        prm.leave_subsection();
      }

    prm.enter_subsection("Boundary conditions");
    PluginRegistry<BoundaryCondition<dim>>::declare_parameters(prm);
    prm.leave_subsection();

    prm.enter_subsection("Linear solver");
    prm.declare_entry("Solver",
                      "MUMPS",
                      Patterns::Selection(
                        PluginRegistry<LinearSolver>::names()),
                      "MUMPS: direct, LDL^T where the matrix is symmetric.");
    PluginRegistry<LinearSolver>::declare_parameters(prm);
    prm.leave_subsection();

    prm.enter_subsection("Postprocess");
    PluginRegistry<Postprocessor<dim>>::declare_parameters(prm);
    prm.leave_subsection();

    prm.enter_subsection("Output");
    prm.declare_entry("Directory",
                      "output",
                      Patterns::Anything(),
                      "Where all files of the run go; made if missing.");
    prm.declare_entry("Terminal",
                      "progress",
                      Patterns::Selection("quiet|progress|verbose"),
                      "Warnings and errors only, a line per step with an "
                      "estimate of the time left, or in addition the residuals "
                      "of each iteration.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::parse_parameters(ParameterHandler &prm)
  {
    grid.parse_parameters(prm);
    points.parse_parameters(prm);
    shape.parse_parameters(prm);
    newton_solver.parse_parameters(prm);
    time.parse_parameters(prm);
    std::vector<std::string> changeable = {"Output/"};
    for (const auto &paths : {Checkpoint<dim>::changeable_parameters(),
                              LoadStepping::changeable_parameters(),
                              NewtonSolver::changeable_parameters(),
                              LinearSolver::changeable_parameters(),
                              Postprocessor<dim>::changeable_parameters()})
      changeable.insert(changeable.end(), paths.begin(), paths.end());
    checkpoint.parse_parameters(prm, changeable);
    dynamic = inertia.parse_parameters(prm);
    quadrature.parse_parameters(prm);
    extension.parse_parameters(prm);
    refinement.parse_parameters(prm);
    grid_reset.parse_parameters(prm);
    adaptation.parse_parameters(prm);
    project_volume = volume_projection.parse_parameters(prm);

    prm.enter_subsection("Formulation");
    const bool mixed       = prm.get("Type") == "u-p";
    n_components           = mixed ? dim + 1 : dim;
    kernel.ppp_coefficient = mixed && prm.get("Stabilisation") == "PPP" ?
                               prm.get_double("PPP coefficient") :
                               0.;
    prm.leave_subsection();

    for (unsigned int m = 0;
         m == 0 || prm.subsection_path_exists({material_section(m)});
         ++m)
      {
        prm.enter_subsection(material_section(m));
        const std::string model = prm.get("Model");
        kernel.materials.push_back(
          PluginRegistry<MaterialModel<dim>>::create(model));
        const auto &material = *kernel.materials.back();
        kernel.materials.back()->parse_parameters(prm);
        if (project_volume)
          kernel.materials.back()->prepare_rescaling();
        prm.leave_subsection();
        AssertThrow(mixed || material.inverse_bulk_modulus() > 0,
                    ExcMessage(
                      "The parameter <" + material_section(m) +
                      "/Poisson ratio> must be less than 0.5 in the "
                      "formulation u. Set <Formulation/Type = u-p> for "
                      "an incompressible material."));
        AssertThrow(!dynamic || material.density() > 0,
                    ExcMessage("The parameter <" + material_section(m) +
                               "/Density> must be positive in a scene with "
                               "<Dynamics/Inertia = true>."));
        AssertThrow(material.history_names().size() <= max_history,
                    ExcMessage("The law <" + model + "> of <" +
                               material_section(m) + "/Model> keeps " +
                               std::to_string(material.history_names().size()) +
                               " history variables per point, but there is "
                               "room for " +
                               std::to_string(max_history) +
                               ": raise max_history in mixed_kernel.h."));
        AssertThrow(m < max_materials,
                    ExcMessage("There may be no more than " +
                               std::to_string(max_materials) +
                               " materials: the sections <Material> to <" +
                               material_section(max_materials - 1) + ">."));
        symmetric = symmetric && material.has_symmetric_tangent();
      }

    prm.enter_subsection("Boundary conditions");
    PluginRegistry<BoundaryCondition<dim>>::create_all(boundary_conditions);
    for (auto &condition : boundary_conditions)
      {
        condition->parse_parameters(prm);
        symmetric = symmetric && condition->has_symmetric_matrix();
      }
    prm.leave_subsection();

    prm.enter_subsection("Linear solver");
    linear_solver = PluginRegistry<LinearSolver>::create(prm.get("Solver"));
    linear_solver->parse_parameters(prm);
    prm.leave_subsection();

    prm.enter_subsection("Postprocess");
    PluginRegistry<Postprocessor<dim>>::create_all(postprocessors);
    for (auto &postprocessor : postprocessors)
      postprocessor->parse_parameters(prm);
    prm.leave_subsection();

    prm.enter_subsection("Output");
    output_directory           = prm.get("Directory");
    const std::string terminal = prm.get("Terminal");
    pcout.set_condition(Utilities::MPI::this_mpi_process(comm) == 0 &&
                        terminal != "quiet");
    verbose = pcout.is_active() && terminal == "verbose";
    warnings.print_here(Utilities::MPI::this_mpi_process(comm) == 0);
    prm.leave_subsection();
    warn_of_idle_parameters(prm, warnings);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::run()
  {
    try
      {
        setup();
        open_output();
        run_steps();
      }
    catch (...)
      {
        if (!warnings.all().empty())
          print_warning_count();
        throw;
      }
    if (pcout.is_active())
      timer.print_summary();
    print_warning_count();
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::validate()
  {
    setup();
    checkpoint.resume_if_asked(grid, output_directory, state());
    print_size();
    restore_moved_grid();
    initialisation_phase();
    at_start = true;
    assemble(true);
    print_warning_count();
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::print_warning_count()
  {
    // where the warnings are, too: nobody is to miss them because of 'quiet'
    if (warnings.all().empty())
      pcout << warnings.summary() << std::endl;
    else if (Utilities::MPI::this_mpi_process(comm) == 0)
      std::cerr << warnings.summary() << std::endl;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::run_steps()
  {
    while (!time.finished())
      {
        try
          {
            initialisation_phase();
          }
        catch (const ExcPointsLeftGrid &exc)
          {
            AssertThrow(false,
                        ExcMessage(plain_message(exc) + " " +
                                   FailureReport<dim>::write_points(
                                     context(), points, output_directory)));
          }
        NewtonReport newton = find_initial_acceleration();
        if (newton.converged)
          {
            const bool predicted = predict();
            newton               = updated_lagrangian_phase();
            if (!newton.converged && predicted)
              {
                start_from_rest();
                newton = updated_lagrangian_phase();
              }
          }
        if (newton.converged && repeat_first_step())
          continue;
        if (newton.converged)
          {
            convective_phase(newton);
            print_progress(newton);
            start_afresh = checkpoint.write_if_due(state());
          }
        else
          {
            AssertThrow(time.can_be_cut(), ExcMessage(explain_failure(newton)));
            pcout << "Step " << time.step + 1 << " to t = " << time.next_time()
                  << " is cut: " << newton.failure << std::endl;
            time.reject(newton.failure);
          }
      }
  }



  template <int dim>
  std::string
  MaterialPointMethod<dim>::explain_failure(const NewtonReport &newton)
  {
    const StepContext<dim> step    = context();
    bool                   dragged = false;
    for (const auto &condition : boundary_conditions)
      dragged = dragged || condition->moves_body(step);
    return failure_report.explain({step,
                                   unknowns,
                                   system,
                                   points,
                                   time,
                                   newton,
                                   solver_report,
                                   constraints,
                                   dragged,
                                   dynamic,
                                   output_directory});
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::setup()
  {
    TimerOutput::Scope scope(timer, "setup");
    grid.create();
    adaptation.make_initial_grid(grid);
    locator = std::make_unique<PointLocator<dim>>(grid.geometry());
    points.seed(kernel.materials,
                dynamic,
                inertia.initial_velocity,
                quadrature.needs_domains());
    shape.initialize(grid, quadrature.needs_domains());
    for (auto &condition : boundary_conditions)
      {
        condition->set_body(shape, arrays);
        condition->initialize(grid);
      }
    for (auto &postprocessor : postprocessors)
      postprocessor->initialize(grid);

    terms           = {&body};
    extends         = extension.is_active(quadrature.is_plain());
    needs_occupancy = quadrature.needs_occupancy() || extends;
    if (needs_occupancy)
      find_walls();
    if (dynamic)
      terms.push_back(&inertia);
    for (auto &condition : boundary_conditions)
      terms.push_back(condition.get());
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::open_output()
  {
    const std::string earlier =
      checkpoint.resumes() ? "" : describe_earlier_output(output_directory);
    const std::string notice =
      checkpoint.start(grid, output_directory, state());
    restore_moved_grid();
    run_on_all_ranks(comm, [&]() {
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        statistics.open(output_directory + "/statistics.txt", time.step);
    });
    print_size();
    for (const std::string &text : {earlier, notice})
      if (!text.empty())
        pcout << text << std::endl;
    remaining_time.reached(time.time, clock.wall_time());
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::restore_moved_grid()
  {
    if (grid.is_moving() && !grid_reset.due())
      grid.set_vertices(grid.vertices_at_time(grid_reset.start_time()));
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::print_size()
  {
    pcout << "Isochor: " << grid.triangulation().n_active_cells() << " cells, "
          << points.handler().n_global_particles() << " material points, "
          << (n_components == dim ?
                "u" :
                (kernel.ppp_coefficient > 0 ? "u-p + PPP" : "u-p"))
          << " form" << std::endl;
    pcout << body_summary(points, comm) << std::endl;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::print_progress(const NewtonReport &newton)
  {
    remaining_time.reached(time.time, clock.wall_time());
    pcout << "Step " << time.step << ": t = " << time.time << ", "
          << system.matrix().n_equations << " equations, "
          << newton.n_iterations()
          << (newton.n_iterations() == 1 ? " iteration, " : " iterations, ")
          << readable_duration(remaining_time.seconds_to(time.end_time()))
          << " left" << std::endl;
  }



  template <int dim>
  typename Checkpoint<dim>::State
  MaterialPointMethod<dim>::state()
  {
    return {points,
            time,
            last_motion,
            grid_reset,
            boundary_conditions,
            postprocessors,
            [this]() { return adaptation.save_state(grid); },
            [this](const std::string &saved) {
              if (adaptation.load_state(saved, grid, points, *locator))
                grid_changed();
            }};
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::find_walls()
  {
    // what the boundary conditions hold, asked with all nodes of the grid
    ActiveNodes<dim>          all_nodes(grid);
    std::vector<unsigned int> vertices(grid.triangulation().n_vertices());
    std::iota(vertices.begin(), vertices.end(), 0);
    all_nodes.update(vertices);
    const StepContext<dim> step{grid,
                                all_nodes,
                                arrays,
                                kernel,
                                n_components,
                                time.time,
                                time.next_time(),
                                warnings};
    NodalConstraints       held;
    held.reinit(all_nodes.n_local() * n_components);
    for (const auto &condition : boundary_conditions)
      condition->constrain(step, held);
    occupancy.initialize(
      [&](const unsigned int vertex, const unsigned int component) {
        return held.constrained[all_nodes.node(vertex) * n_components +
                                component] != 0;
      });
  }



  template <int dim>
  StepContext<dim>
  MaterialPointMethod<dim>::context()
  {
    return {grid,
            nodes,
            arrays,
            kernel,
            n_components,
            time.time,
            inertia.in_trial() ? time.time : time.next_time(),
            warnings,
            !grid_reset.due()};
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::initialisation_phase()
  {
    TimerOutput::Scope scope(timer, "initialisation phase");
    if (grid_reset.due())
      reset_grid();
    else
      points.update(arrays);
    nodes_changed = nodes.update(grid_reset.touched_vertices) || start_afresh;
    start_afresh  = false;

    nodes.initialize(unknowns, n_components);
    nodes.initialize(base_unknowns, n_components);
    nodes.initialize(correction, n_components);
    nodes.initialize(pending, n_components);
    nodes.initialize(external_force, n_components);
    nodes.initialize(boundary_force, n_components);
    set_initial_pressure();
    if (dynamic)
      inertia.start_step(context(),
                         boundary_conditions,
                         points,
                         time.step == 0);
    prepare_system();
    compute_residual_floor();
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::reset_grid()
  {
    TimerOutput::Scope scope(timer, "grid reset");
    if (grid.is_moving())
      grid.set_vertices(grid.vertices_at_time(time.time));
    grid_reset.start(time.time);
    // here and not after the last step, which may end outside of the grid
    points.relocate(*locator);
    if (adaptation.is_due() &&
        adaptation.adapt(grid, points, *locator, time.time, last_motion))
      grid_changed();
    refinement.refine(points, grid, *locator);
    points.gather(arrays);
    quadrature.start_step(arrays, *locator, kernel, needs_occupancy, occupancy);
    spacing.check(arrays, time.time, time.step == 0, warnings);
    spacing.compare_volumes(arrays, time.time, warnings);
    grid_reset.touched_vertices.clear();
    for (EquationTerm<dim> *term : terms)
      term->touch_vertices(grid_reset.touched_vertices);
    if (extends)
      extension.update(arrays, grid_reset.touched_vertices);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::grid_changed()
  {
    for (const auto &condition : boundary_conditions)
      condition->grid_changed(grid, time.step == 0);
    for (const auto &postprocessor : postprocessors)
      postprocessor->grid_changed(grid);
    if (needs_occupancy)
      find_walls();
  }



  template <int dim>
  bool
  MaterialPointMethod<dim>::repeat_first_step()
  {
    if (time.step > 0 || !adaptation.repeats_first_step(++n_first_solutions))
      return false;
    Statistics not_of_a_step;
    adaptation.set_sizes(context(), unknowns, points, not_of_a_step);
    if (!adaptation.adapt(grid, points, *locator, time.time, last_motion))
      return false;
    // as they were, but for the cells
    points.seed(kernel.materials,
                dynamic,
                inertia.initial_velocity,
                quadrature.needs_domains());
    grid_changed();
    return true;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::set_initial_pressure()
  {
    if (n_components == dim)
      return;
    if (grid_reset.due())
      {
        map_pressure_to_nodes(context(), unknowns);
        return;
      }
    // the nodes are those of the last step
    last_motion.restore_pressure(nodes, n_components, unknowns);
  }



  template <int dim>
  bool
  MaterialPointMethod<dim>::predict()
  {
    if (!newton_solver.extrapolate || last_motion.step_size == 0)
      return false;
    last_motion.extrapolate(nodes,
                            n_components,
                            context().step_size() / last_motion.step_size,
                            unknowns);
    return true;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::start_from_rest()
  {
    unknowns.zero_out_ghost_values();
    unknowns = 0.;
    set_initial_pressure();
    start_contact(false);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::prepare_system()
  {
    const StepContext<dim> step = context();
    if (grid_reset.due())
      {
        TimerOutput::Scope scope(timer, "grid reset");
        grid_reset.elements.clear();
        grid_reset.first_element.clear();
        for (EquationTerm<dim> *term : terms)
          {
            grid_reset.first_element.push_back(grid_reset.elements.size());
            term->collect_elements(step, grid_reset.elements);
          }
      }
    set_external_force();
    start_contact(nodes_changed);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::start_contact(const bool with_other_nodes)
  {
    for (const auto &condition : boundary_conditions)
      condition->start_contact();
    constrain_nodes();
    system.reinit(with_other_nodes,
                  n_components,
                  grid_reset.elements,
                  constraints,
                  symmetric);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::set_external_force()
  {
    external_force = 0.;
    external_force.zero_out_ghost_values();
    for (const auto &condition : boundary_conditions)
      condition->add_external_force(context(), external_force);
    external_force.compress(VectorOperation::add);
  }



  template <int dim>
  bool
  MaterialPointMethod<dim>::constrain_nodes()
  {
    const StepContext<dim> step     = context();
    const auto             previous = constraints.constrained;
    constraints.reinit(nodes.n_local() * n_components);
    for (const auto &condition : boundary_conditions)
      condition->constrain(step, constraints);
    if (extends)
      extension.constrain(step, constraints);
    const bool changed =
      Utilities::MPI::max(static_cast<int>(constraints.constrained != previous),
                          comm) != 0;
    if (dynamic)
      {
        StepContext<dim> whole_step = step;
        whole_step.time             = time.next_time(); // also in a trial
        if (changed || !inertia.is_prescribed())
          inertia.prescribe(whole_step, boundary_conditions, constraints);
        if (inertia.in_trial())
          inertia.set_trial_increments(step, constraints);
      }
    return changed;
  }



  template <int dim>
  NewtonReport
  MaterialPointMethod<dim>::find_initial_acceleration()
  {
    NewtonReport report;
    report.converged = true;
    if (!dynamic || time.step > 0)
      return report;
    // a trial errs by O(h); two, one of them back in time, by O(h²)
    const double size = context().step_size();
    for (const double trial : {size, -size})
      {
        inertia.start_trial(trial);
        start_again();
        report = trial > 0 ? updated_lagrangian_phase() : find_equilibrium();
        if (report.converged)
          inertia.finish_trial(context(), unknowns, arrays);
        inertia.end_trial();
        if (!report.converged)
          return report;
      }
    inertia.start_step(context(), boundary_conditions, points, time.step == 0);
    start_again();
    return report;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::start_again()
  {
    at_start = true;
    for (unsigned int i = 0; i < nodes.n_local() * n_components; ++i)
      if (i % n_components < dim)
        unknowns.local_element(i) = 0.;
    set_external_force();
    start_contact(false);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::compute_residual_floor()
  {
    // strains carry rounding errors of some 1e-15: residuals of ten times that
    // are zero
    constexpr double rounding = 1e-14;
    NodalField       unit;
    nodes.initialize(unit, n_components);
    body.add_unit_residual(context(), unit);
    unit.compress(VectorOperation::add);
    double force = 0, volume = 0;
    for (unsigned int i = 0; i < nodes.n_owned() * n_components; ++i)
      (i % n_components == dim ? volume : force) +=
        unit.local_element(i) * unit.local_element(i);
    force_floor  = rounding * std::sqrt(Utilities::MPI::sum(force, comm));
    volume_floor = rounding * std::sqrt(Utilities::MPI::sum(volume, comm));
  }



  template <int dim>
  NewtonReport
  MaterialPointMethod<dim>::updated_lagrangian_phase()
  {
    if (verbose)
      pcout << "Step " << time.step + 1 << " to t = " << time.next_time()
            << " (dt = " << time.next_time() - time.time << ")" << std::endl;

    at_start            = true;
    NewtonReport report = find_equilibrium();
    while (report.converged && change_contact(report))
      {
        system.reinit(
          false, n_components, grid_reset.elements, constraints, symmetric);
        if (verbose)
          pcout << "    contact changed" << std::endl;
        report.continue_with(find_equilibrium());
      }
    return report;
  }



  template <int dim>
  bool
  MaterialPointMethod<dim>::change_contact(NewtonReport &report)
  {
    const typename BoundaryCondition<dim>::ContactTolerance tolerance{
      newton_solver.tolerance * report.force_scale, newton_solver.tolerance};
    for (const auto &condition : boundary_conditions)
      {
        const std::string failure = condition->check_contact(
          context(), unknowns, system.residual, constraints.ties, tolerance);
        if (!failure.empty())
          {
            report.converged = false;
            report.failure   = failure;
            return false;
          }
      }
    return constrain_nodes();
  }



  template <int dim>
  NewtonReport
  MaterialPointMethod<dim>::find_equilibrium()
  {
    NewtonSolver::Problem problem;
    problem.assemble = [this](const bool with_matrix) {
      return assemble(with_matrix);
    };
    problem.solve = [this](const bool factorise) {
      return solve_linear_system(factorise);
    };
    problem.has_factorisation = [this]() {
      return factorised_pattern == system.matrix().pattern_id;
    };
    problem.advance = [this](const double s) {
      at_start = false;
      for (unsigned int i = 0; i < nodes.n_local() * n_components; ++i)
        unknowns.local_element(i) =
          base_unknowns.local_element(i) + s * correction.local_element(i);
    };
    system.interpolate_ties(unknowns); // wherever it starts from
    return newton_solver.solve(problem, verbose ? &std::cout : nullptr);
  }



  template <int dim>
  ResidualNorms
  MaterialPointMethod<dim>::assemble(const bool with_matrix)
  {
    TimerOutput::Scope     scope(timer, "assembly");
    const StepContext<dim> step = context();
    ResidualNorms          norms;

    unsigned int is_pending = 0;
    for (unsigned int i = 0; i < constraints.constrained.size(); ++i)
      if (constraints.constrained[i])
        {
          double &rest = pending.local_element(i);
          rest         = constraints.increment[i] - unknowns.local_element(i);
          if (std::abs(rest) > 1e-12 * std::abs(constraints.increment[i]))
            is_pending = 1;
        }

    boundary_force = 0.;
    boundary_force.zero_out_ghost_values();
    for (const auto &condition : boundary_conditions)
      {
        if (at_start && condition->moves_body(step))
          is_pending = 1;
        condition->add_boundary_force(step, unknowns, boundary_force);
      }
    boundary_force.compress(VectorOperation::add);

    system.start_assembly(with_matrix);
    unsigned int status = 0;
    for (unsigned int t = 0; t < terms.size(); ++t)
      status = std::max(status,
                        static_cast<unsigned int>(
                          terms[t]->assemble(step,
                                             unknowns,
                                             pending,
                                             grid_reset.first_element[t],
                                             with_matrix,
                                             system)));
    system.finish_assembly(external_force);

    std::array<double, 4> squares{}; // displacement, pressure, reaction, load
    for (unsigned int i = 0; i < nodes.n_owned() * n_components; ++i)
      {
        const double r = system.residual.local_element(i);
        const double f =
          external_force.local_element(i) + boundary_force.local_element(i);
        const bool pressure = (i % n_components == dim);
        squares[constraints.constrained[i] ? 2 : (pressure ? 1 : 0)] += r * r;
        if (!pressure)
          squares[3] += f * f;
      }
    norms.status =
      static_cast<EvaluationStatus>(Utilities::MPI::max(status, comm));
    norms.pending = Utilities::MPI::max(is_pending, comm) != 0;
    sum_over_ranks(squares, comm);
    norms.displacement = std::sqrt(squares[0]);
    norms.pressure     = std::sqrt(squares[1]);
    norms.force_scale =
      norms.pending ? 0. : std::sqrt(std::max(squares[2], squares[3]));
    norms.displacement_floor = force_floor;
    norms.pressure_floor     = volume_floor;
    if (with_matrix && !scene_checked)
      check_scene();
    return norms;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::check_scene()
  {
    scene_checked = true;
    if (time.step > 0) // resumed: said when it started
      return;
    const StepContext<dim> step = context();
    check_body(step);
    for (const auto &condition : boundary_conditions)
      condition->check_scene(step);
    for (const auto &postprocessor : postprocessors)
      postprocessor->check_scene(step);
    if (!dynamic)
      check_supports(system.matrix(), warnings);
  }



  template <int dim>
  unsigned int
  MaterialPointMethod<dim>::solve_linear_system(const bool factorise)
  {
    system.right_hand_side(rhs);
    system.shape(solution);
    if (factorise)
      {
        TimerOutput::Scope scope(timer, "factorisation");
        factorised_pattern = 0; // none, should this throw
        solver_report      = linear_solver->factorise(system.matrix());
        factorised_pattern = system.matrix().pattern_id;
      }
    LinearSolverReport report;
    {
      TimerOutput::Scope scope(timer, "solution");
      report = linear_solver->solve(rhs, solution);
    }

    for (unsigned int i = 0; i < nodes.n_local() * n_components; ++i)
      {
        base_unknowns.local_element(i) = unknowns.local_element(i);
        correction.local_element(i) =
          constraints.constrained[i] ? pending.local_element(i) : 0.;
      }
    system.to_nodes(solution, correction);
    return report.iterations;
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::convective_phase(const NewtonReport &newton)
  {
    const StepContext<dim> step = context();
    const StepResult<dim>  result{step,
                                 unknowns,
                                 system,
                                 points,
                                 time,
                                 newton,
                                 output_directory,
                                 boundary_conditions};
    {
      TimerOutput::Scope scope(timer, "postprocessing");
      statistics.set("Step", time.step + 1);
      statistics.set("Time (s)", step.time);
      statistics.set("Step size (s)", step.step_size());
      statistics.set("Newton iterations", newton.n_iterations());
      statistics.set("Factorisations", newton.n_factorisations);
      statistics.set("Step cuts", time.n_cuts);
      statistics.set("Relative residual of forces",
                     newton.iterations.back().displacement);
      statistics.set("Equations", system.matrix().n_equations);
      set_solver_statistics(newton);
      if (!grid_reset.always())
        statistics.set("Step of grid", grid_reset.n_steps() + 1);
      for (auto &postprocessor : postprocessors)
        postprocessor->evaluate_nodes(result, statistics);
      adaptation.set_sizes(step, unknowns, points, statistics);
      adaptation.evaluate(grid, points, statistics);
      for (const auto &condition : boundary_conditions)
        condition->evaluate(step, unknowns, statistics);
    }
    {
      TimerOutput::Scope scope(timer, "convective phase");
      if (dynamic)
        inertia.finish_step(step, unknowns);
      update_points(step,
                    unknowns,
                    dynamic ? &inertia : nullptr,
                    project_volume ? &volume_projection : nullptr,
                    points,
                    extends ? &step_energy : nullptr);
      if (extends)
        extension.evaluate(step, unknowns, system, step_energy, statistics);
      last_motion.remember(nodes, n_components, step.step_size(), unknowns);
      for (auto &condition : boundary_conditions)
        condition->advance(step, unknowns);
      grid_reset.advance(step, unknowns);
      // on a grid that is kept nothing drifts
      if (project_volume && grid_reset.due())
        volume_projection.apply(step, points);
      failure_report.remember(step, unknowns);
      warn_if_nothing_moves(newton);
      time.accept(newton.n_factorisations);
    }
    {
      TimerOutput::Scope scope(timer, "postprocessing");
      for (auto &postprocessor : postprocessors)
        postprocessor->evaluate_points(result, statistics);
      statistics.end_row();
    }
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::set_solver_statistics(const NewtonReport &newton)
  {
    if (linear_solver->is_iterative())
      statistics.set("Linear iterations", newton.n_linear_iterations());
    if (solver_report.knows_pivots)
      statistics.set("Negative pivots", solver_report.n_negative_pivots);
    if (solver_report.n_factor_entries > 0)
      statistics.set("Entries of the factors", solver_report.n_factor_entries);
  }



  template <int dim>
  void
  MaterialPointMethod<dim>::warn_if_nothing_moves(const NewtonReport &newton)
  {
    // in dynamics the trial steps may have left nothing to iterate on
    if (time.step == 0 && newton.n_iterations() == 0 &&
        unknowns.linfty_norm() == 0)
      warnings.add("nothing loads the scene",
                   "The first step, to t = " +
                     std::to_string(time.next_time()) +
                     ", needed no iteration: no load and no displacement acts "
                     "on the body up to then. Set loads in <Boundary "
                     "conditions>, <Dynamics/Initial velocity>, or a larger "
                     "<Time/Step size> if they begin later.");
  }



  template class MaterialPointMethod<2>;
  template class MaterialPointMethod<3>;
} // namespace isochor
