/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/body_quadrature/body_quadrature.h>
#include <isochor/dynamics/inertia_term.h>
#include <isochor/equations/invariants.h>
#include <isochor/nonlinear_solver/load_stepping.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  InertiaTerm<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Dynamics");
    TimeIntegrator::declare_schemes(prm);
    prm.declare_entry("Transfer",
                      "PIC",
                      Patterns::Selection("PIC|FLIP"),
                      "What points take from the nodes at the end of a step: "
                      "their velocity (PIC), or its change (FLIP). Nodes get "
                      "the velocity of the points by projection with the "
                      "consistent mass matrix, so that neither damps a body "
                      "that stays in its cells.");
    prm.declare_entry("Acceleration",
                      "auto",
                      Patterns::Selection("auto|carried|from stresses"),
                      "With which acceleration a step starts: the points' own "
                      "of the step before, or the one that the stresses of the "
                      "points and the loads give on the grid of the step. The "
                      "latter keeps the energy also when points change cells, "
                      "but needs forces that don't jump then: <Quadrature/Type "
                      "= CPDI>. auto: from stresses with CPDI.");
    prm.declare_entry("Initial velocity",
                      "",
                      Patterns::Anything(),
                      "Velocity (m/s) of the points at t = 0, formulas in x, "
                      "y(, z): 'v_x, v_y(, v_z)'. Empty: at rest.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  InertiaTerm<dim>::parse_parameters(ParameterHandler          &prm,
                                     const BodyQuadrature<dim> &quadrature)
  {
    prm.enter_subsection("Dynamics");
    integrator              = TimeIntegrator::create(prm);
    at_end.kept_part        = prm.get("Transfer") == "FLIP" ? 1 : 0;
    initial_velocity        = prm.get("Initial velocity");
    const std::string start = prm.get("Acceleration");
    prm.leave_subsection();
    from_stresses = start != "carried" && !quadrature.forces_jump();
    AssertThrow(!is_active() || from_stresses || start != "from stresses",
                ExcMessage("<Dynamics/Acceleration = from stresses> needs "
                           "<Quadrature/Type = CPDI>: with other quadratures "
                           "forces jump when points change cells."));
    AssertThrow(is_active() || initial_velocity.empty(),
                ExcMessage("The parameter <Dynamics/Initial velocity> needs "
                           "<Dynamics/Inertia = true>."));
  }


  template <int dim>
  void
  InertiaTerm<dim>::take_pressures(const StepContext<dim> &step,
                                   const NodalField       &unknowns)
  {
    if (is_active())
      start.take_pressures(step, unknowns);
  }



  template <int dim>
  void
  InertiaTerm<dim>::start_step(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    MaterialPoints<dim>                                        &points,
    const bool                                                  carries)
  {
    if (!is_active())
      return;
    start.start_step(step,
                     conditions,
                     points,
                     from_stresses && !carries,
                     from_stresses && step.old_time > 0);
    step.nodes.initialize(element.acceleration, dim);
    element.acceleration.set_ghost_state(true); // each rank computes all
  }


  template <int dim>
  void
  InertiaTerm<dim>::constrain(
    const StepContext<dim>                                     &step,
    const double                                                end,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    const bool                                                  changed,
    NodalConstraints                                           &constraints)
  {
    Assert(end > step.old_time, ExcInternalError());
    AssertDimension(constraints.constrained.size(),
                    step.nodes.n_local() * step.n_components);
    if (!is_active())
      return;
    StepContext<dim> whole_step = step;
    whole_step.time             = end; // also in a trial
    whole_step.time             = end_of_motion(whole_step);
    if (changed || !start.prescribed)
      start.prescribe(whole_step,
                      conditions,
                      constraints,
                      smooth_start(whole_step.step_size()),
                      at_end.kept_part > 0);
    if (in_trial())
      set_trial_increments(whole_step, constraints);
  }



  template <int dim>
  void
  InertiaTerm<dim>::collect_elements(const StepContext<dim> &step,
                                     ElementNodes           &elements)
  {
    if (!is_active())
      return;
    for (unsigned int e = 0; e < start.mass.n_elements(step); ++e)
      {
        start.mass.element_nodes(step, e, element.nodes);
        elements.add(element.nodes.begin(), element.nodes.end());
      }
  }



  template <int dim>
  EvaluationStatus
  InertiaTerm<dim>::assemble(const StepContext<dim> &step,
                             const NodalField       &unknowns,
                             const NodalField       &pending,
                             const unsigned int      first_element,
                             const bool              with_matrix,
                             MixedSystem<dim>       &system)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(invariants::fits(pending, step.nodes, step.n_components),
           ExcOtherNodes());
    if (!is_active())
      return EvaluationStatus::success;
    const unsigned int nc        = step.n_components;
    const double       dt        = step_size(step);
    const double       stiffness = scheme().stiffness(dt);
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i   = node * dim + d;
          const double       a_n = start.acceleration.local_element(i);
          element.acceleration.local_element(i) =
            scheme().inertial_acceleration(
              a_n,
              scheme().acceleration(unknowns.local_element(node * nc + d),
                                    start.velocity.local_element(i),
                                    a_n,
                                    dt));
        }
    for (unsigned int e = 0; e < start.mass.n_elements(step); ++e)
      {
        start.mass.element_nodes(step, e, element.nodes);
        start.mass.element_matrix(step, e, element.mass);
        const unsigned int n = element.nodes.size(), n_dofs = n * nc;
        element.residual.assign(n_dofs, 0.);
        for (unsigned int I = 0; I < n; ++I)
          for (unsigned int J = 0; J < n; ++J)
            for (unsigned int d = 0; d < dim; ++d)
              element.residual[I * nc + d] +=
                element.mass[I * n + J] *
                element.acceleration.local_element(element.nodes[J] * dim + d);
        if (with_matrix)
          {
            element.matrix.assign(n_dofs * n_dofs, 0.);
            for (unsigned int I = 0; I < n; ++I)
              for (unsigned int J = 0; J < n; ++J)
                for (unsigned int d = 0; d < dim; ++d)
                  element.matrix[(I * nc + d) * n_dofs + J * nc + d] =
                    stiffness * element.mass[I * n + J];
          }
        system.add_element(first_element + e,
                           element.residual.data(),
                           with_matrix ? element.matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  void
  InertiaTerm<dim>::finish_step(const StepContext<dim> &step,
                                const NodalField       &unknowns,
                                const NodalField       &force_of_mean)
  {
    if (!is_active())
      return;
    NodalField excess_of_mean;
    start.accelerate(step, force_of_mean, excess_of_mean);
    at_end.find(
      step, start, scheme(), step_size(step), unknowns, excess_of_mean);
  }



  template <int dim>
  double
  InertiaTerm<dim>::error_of_step(const StepContext<dim> &step,
                                  const NodalField       &unknowns) const
  {
    if (!is_active())
      return 0;
    const double dt     = step.step_size();
    const double factor = integrator->smooth_start(dt).velocity_per_jerk;
    // all schemes that are stable at any size of step have at least 1/12
    AssertThrow(std::abs(factor) > 1e-3 * dt * dt,
                ExcMessage("<Dynamics/Newmark beta> and <Newmark gamma> are "
                           "such that <Time/Tolerated error> has no measure of "
                           "the error: 1/6 - beta - (1/2 - gamma)/2 is zero. "
                           "Choose <Dynamics/Scheme = Bossak>, or set "
                           "<Tolerated error> to 0."));
    return std::abs(factor) *
           start.acceleration_change(step, unknowns, *integrator);
  }



  template <int dim>
  double
  InertiaTerm<dim>::work_of_jump(const StepContext<dim>    &step,
                                 const MaterialPoints<dim> &points,
                                 const LoadStepping        &time) const
  {
    const bool is_first = time.step == 0;
    if (!is_active() || !(is_first ? starts_with_impulse : time.starts_anew))
      return 0;
    double before = 0;
    for (unsigned int q = 0; is_first && q < step.points.mass.size(); ++q)
      before += step.points.mass[q] / 2 * step.points.velocity[q].norm_square();
    return start.kinetic_energy(step) -
           (is_first ? before : points.kinetic_energy());
  }



  template <int dim>
  void
  InertiaTerm<dim>::set_trial_increments(const StepContext<dim> &step,
                                         NodalConstraints &constraints) const
  {
    Assert(invariants::fits(start.velocity, step.nodes, dim), ExcOtherNodes());
    Assert(invariants::fits(start.acceleration, step.nodes, dim),
           ExcOtherNodes());
    const unsigned int nc        = step.n_components;
    const auto         increment = [this](const unsigned int i) {
      return trial.size *
             (start.velocity.local_element(i) +
              trial.size / 2 * start.acceleration.local_element(i));
    };
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (constraints.constrained[node * nc + d])
          constraints.increment[node * nc + d] = increment(node * dim + d);
    if (constraints.equations.empty())
      return;
    for (auto &equation : constraints.equations)
      {
        // an equation has displacements or pressures, not both
        if (constraints.entry[equation.first] % nc == dim)
          continue;
        equation.value = 0;
        for (std::size_t i = equation.first; i < equation.last; ++i)
          equation.value += constraints.coefficient[i] *
                            increment(constraints.entry[i] / nc * dim +
                                      constraints.entry[i] % nc);
      }
    constraints.resolve(nc);
  }



  template <int dim>
  void
  InertiaTerm<dim>::start_trial(
    const StepContext<dim>                                     &step,
    const TrialStep                                            &trial_step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    Assert(is_active(), ExcMessage("There is no inertia."));
    if (trial_step.size > 0) // the first of two
      start.prescribed = false;
    trial                   = trial_step;
    StepContext<dim> motion = step;
    motion.time             = end_of_motion(step);
    for (auto *const condition : with_role<ActsByAssembly<dim>>(conditions))
      condition->set_trial(motion, trial.size, smooth_start(step.step_size()));
  }



  template <int dim>
  void
  InertiaTerm<dim>::end_trial(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    trial = {};
    for (auto *const condition : with_role<ActsByAssembly<dim>>(conditions))
      condition->set_trial(step, 0., {});
  }



  template <int dim>
  void
  InertiaTerm<dim>::finish_trial(const StepContext<dim> &step,
                                 const NodalField       &unknowns,
                                 PointArrays<dim>       &points)
  {
    Assert(is_active(), ExcMessage("There is no inertia."));
    starts_with_impulse = trial.with_velocity;
    const double sign   = trial.is_past ? -1 : 1;
    finish_step(step, unknowns, NodalField());
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil     = points.stencil(step.grid.geometry(), k, q);
          const Tensor<1, dim> a = at_end.acceleration_at(step, stencil);
          points.acceleration[q] += sign / 2 * a;
          if (trial.with_velocity)
            points.velocity[q] += sign * trial.size / 4 * a;
        }
  }



  template class InertiaTerm<2>;
  template class InertiaTerm<3>;
} // namespace isochor
