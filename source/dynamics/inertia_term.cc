/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/body_quadrature/body_quadrature.h>
#include <isochor/dynamics/inertia_term.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  InertiaTerm<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Dynamics");
    prm.declare_entry("Inertia",
                      "false",
                      Patterns::Bool(),
                      "Whether the body has inertia, or is in equilibrium at "
                      "all times.");
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
  bool
  InertiaTerm<dim>::parse_parameters(ParameterHandler          &prm,
                                     const BodyQuadrature<dim> &quadrature)
  {
    prm.enter_subsection("Dynamics");
    const bool dynamic      = prm.get_bool("Inertia");
    integrator              = TimeIntegrator::create(prm);
    kept_part               = prm.get("Transfer") == "FLIP" ? 1 : 0;
    initial_velocity        = prm.get("Initial velocity");
    const std::string start = prm.get("Acceleration");
    prm.leave_subsection();
    from_stresses = start != "carried" && !quadrature.forces_jump();
    AssertThrow(!dynamic || from_stresses || start != "from stresses",
                ExcMessage("<Dynamics/Acceleration = from stresses> needs "
                           "<Quadrature/Type = CPDI>: with other quadratures "
                           "forces jump when points change cells."));
    AssertThrow(dynamic || initial_velocity.empty(),
                ExcMessage("The parameter <Dynamics/Initial velocity> needs "
                           "<Dynamics/Inertia = true>."));
    return dynamic;
  }



  template <int dim>
  void
  InertiaTerm<dim>::start_step(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    MaterialPoints<dim>                                        &points,
    const bool                                                  is_first)
  {
    by_stresses = from_stresses && !is_first;
    mass.reinit(step, by_stresses);
    mass.collect(step, step.points.velocity, momentum);
    if (by_stresses)
      collect_forces(step, conditions, points);
    else
      mass.collect(step, step.points.acceleration, force);
    prescribed = false;
    step.nodes.initialize(velocity, dim);
    step.nodes.initialize(acceleration, dim);
    step.nodes.initialize(inertial_acceleration, dim);
  }



  template <int dim>
  void
  InertiaTerm<dim>::collect_forces(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    MaterialPoints<dim>                                        &points)
  {
    StepContext<dim> start = step;
    start.time             = step.old_time;
    NodalField loads, rest;
    step.nodes.initialize(loads, step.n_components);
    step.nodes.initialize(rest, step.n_components);
    for (const auto &condition : conditions)
      {
        condition->add_external_force(start, loads);
        condition->add_boundary_force(start, rest, loads);
      }
    const PointLayout &l = points.layout();
    points.for_each([&](const unsigned int k,
                        const unsigned int q,
                        Point<dim> & /*location*/,
                        ArrayView<double> properties) {
      const auto   stencil = step.points.stencil(step.grid.geometry(), k, q);
      const auto   stress  = load_symmetric<dim>(&properties[l.stress]);
      const double V = step.points.weight[q] * determinant(step.points.F[q]);
      for (unsigned int I = 0; I < stencil.n_nodes; ++I)
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            loads.local_element(
              step.nodes.node(stencil.vertex[I]) * step.n_components + a) -=
              V * stress[a][b] * stencil.gradient[I][b];
    });
    loads.compress(VectorOperation::add);
    // the points have what a_n differs by from the acceleration of the forces
    mass.collect(step, step.points.acceleration, force);
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      for (unsigned int a = 0; a < dim; ++a)
        force.local_element(node * dim + a) +=
          loads.local_element(node * step.n_components + a);
  }



  template <int dim>
  void
  InertiaTerm<dim>::project(const StepContext<dim>    &step,
                            const NodalField          &load,
                            const Followers           &followers,
                            const std::vector<double> &given,
                            NodalField                &solution,
                            const bool                 with_domains) const
  {
    const auto solve = [&](const bool by_domains) {
      solution.zero_out_ghost_values();
      for (unsigned int i = 0; i < step.nodes.n_owned() * dim; ++i)
        if (const double m = mass.lumped.local_element(i / dim);
            !held[i] && m > 0)
          solution.local_element(i) = load.local_element(i) / m;
      return mass.solve(
        step, load, held, followers, given, solution, by_domains);
    };
    // the points' own mass conserves angular momentum best; where it is
    // singular and the load not in its range, that of their domains takes its
    // place
    double error = solve(false);
    if (with_domains && !(error < 1e-8))
      error = solve(true);
    if (!(error < 1e-8))
      step.warnings.add("projection of velocities",
                        "Velocities or accelerations of the points could not "
                        "be projected to the nodes to more than " +
                          rounded(error) +
                          " of their size. Use more <Material points/Points "
                          "per cell>, larger steps or, with <Quadrature/Type = "
                          "CPDI>, <Dynamics/Acceleration = carried>.");
  }



  template <int dim>
  void
  InertiaTerm<dim>::start_trial(
    const StepContext<dim>                                     &step,
    const double                                                trial_step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    trial_size = trial_step;
    for (const auto &condition : conditions)
      condition->set_trial(step, trial_step);
  }



  template <int dim>
  void
  InertiaTerm<dim>::end_trial(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    trial_size = 0;
    for (const auto &condition : conditions)
      condition->set_trial(step, 0.);
  }



  template <int dim>
  void
  InertiaTerm<dim>::finish_trial(
    const StepContext<dim>                                     &step,
    const NodalField                                           &unknowns,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    PointArrays<dim>                                           &points)
  {
    unsigned int by_surface = 0;
    for (const auto &condition : conditions)
      if (condition->starts_suddenly(step, velocity))
        by_surface = 1;
    const bool impulse =
      starts_suddenly(step) ||
      Utilities::MPI::max(by_surface, step.grid.communicator()) != 0;
    finish_step(step, unknowns);
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const Tensor<1, dim> a =
            point(step,
                  points.stencil(step.grid.geometry(), k, q),
                  points.velocity[q])
              .second;
          points.acceleration[q] += a / 2;
          if (impulse)
            points.velocity[q] += trial_size / 4 * a;
        }
  }



  template <int dim>
  bool
  InertiaTerm<dim>::starts_suddenly(const StepContext<dim> &step) const
  {
    // the impulse on held nodes, against what would stop the body
    NodalField product;
    mass.vmult(step, velocity, product);
    double impulse = 0, scale = 0;
    for (unsigned int i = 0; i < step.nodes.n_owned() * dim; ++i)
      {
        scale = std::max({scale,
                          std::abs(product.local_element(i)),
                          std::abs(momentum.local_element(i))});
        if (held[i] && velocity.local_element(i) != 0.)
          impulse = std::max(impulse,
                             std::abs(product.local_element(i) -
                                      momentum.local_element(i)));
      }
    for (unsigned int k = 0; k < given_velocity.size(); ++k)
      if (const unsigned int i = followers.entry[k];
          i < step.nodes.n_owned() * dim && given_velocity[k] != 0.)
        impulse = std::max(impulse,
                           std::abs(product.local_element(i) -
                                    momentum.local_element(i)));
    const MPI_Comm comm = step.grid.communicator();
    return Utilities::MPI::max(impulse, comm) >
           1e-8 * Utilities::MPI::max(scale, comm);
  }



  template <int dim>
  template <typename Acceleration>
  Tensor<1, dim>
  InertiaTerm<dim>::mean_over_mass(const StepContext<dim> &step,
                                   const Acceleration     &of_entry) const
  {
    std::array<double, dim + 1> sums{};
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      {
        const double m = mass.lumped.local_element(node);
        for (unsigned int d = 0; d < dim; ++d)
          sums[d] += m * of_entry(node, d);
        sums[dim] += m;
      }
    sum_over_ranks(sums, step.grid.communicator());
    Tensor<1, dim> mean;
    if (sums[dim] > 0)
      for (unsigned int d = 0; d < dim; ++d)
        mean[d] = sums[d] / sums[dim];
    return mean;
  }



  template <int dim>
  Tensor<1, dim>
  InertiaTerm<dim>::mean_acceleration(const StepContext<dim> &step) const
  {
    return mean_over_mass(step,
                          [&](const unsigned int node, const unsigned int d) {
                            return acceleration.local_element(node * dim + d);
                          });
  }



  template <int dim>
  Tensor<1, dim>
  InertiaTerm<dim>::mean_trial_acceleration(const StepContext<dim> &step,
                                            const NodalField &unknowns) const
  {
    return mean_over_mass(
      step, [&](const unsigned int node, const unsigned int d) {
        return scheme().acceleration(unknowns.local_element(
                                       node * step.n_components + d),
                                     velocity.local_element(node * dim + d),
                                     acceleration.local_element(node * dim + d),
                                     step_size(step));
      });
  }



  template <int dim>
  void
  InertiaTerm<dim>::collect_elements(const StepContext<dim> &step,
                                     ElementNodes           &elements)
  {
    for (unsigned int e = 0; e < mass.n_elements(step); ++e)
      {
        mass.element_nodes(step, e, nodes);
        elements.add(nodes.begin(), nodes.end());
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
    const unsigned int nc        = step.n_components;
    const double       dt        = step_size(step);
    const double       stiffness = scheme().stiffness(dt);
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i   = node * dim + d;
          const double       a_n = acceleration.local_element(i);
          inertial_acceleration.local_element(i) =
            scheme().inertial_acceleration(
              a_n,
              scheme().acceleration(unknowns.local_element(node * nc + d),
                                    velocity.local_element(i),
                                    a_n,
                                    dt));
        }
    for (unsigned int e = 0; e < mass.n_elements(step); ++e)
      {
        mass.element_nodes(step, e, nodes);
        mass.element_matrix(step, e, element_mass);
        const unsigned int n = nodes.size(), n_dofs = n * nc;
        element_residual.assign(n_dofs, 0.);
        for (unsigned int I = 0; I < n; ++I)
          for (unsigned int J = 0; J < n; ++J)
            for (unsigned int d = 0; d < dim; ++d)
              element_residual[I * nc + d] +=
                element_mass[I * n + J] *
                inertial_acceleration.local_element(nodes[J] * dim + d);
        if (with_matrix)
          {
            element_matrix.assign(n_dofs * n_dofs, 0.);
            for (unsigned int I = 0; I < n; ++I)
              for (unsigned int J = 0; J < n; ++J)
                for (unsigned int d = 0; d < dim; ++d)
                  element_matrix[(I * nc + d) * n_dofs + J * nc + d] =
                    stiffness * element_mass[I * n + J];
          }
        system.add_element(first_element + e,
                           element_residual.data(),
                           with_matrix ? element_matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  void
  InertiaTerm<dim>::finish_step(const StepContext<dim> &step,
                                const NodalField       &unknowns)
  {
    const double dt = step_size(step);
    step.nodes.initialize(new_velocity, dim);
    step.nodes.initialize(new_acceleration, dim);
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i   = node * dim + d;
          const double       v_n = velocity.local_element(i);
          const double       a_n = acceleration.local_element(i);
          const double       a   = scheme().acceleration(
            unknowns.local_element(node * step.n_components + d), v_n, a_n, dt);
          new_velocity.local_element(i) = scheme().velocity(v_n, a_n, a, dt);
          new_acceleration.local_element(i) =
            from_stresses && !in_trial() ?
              a - scheme().inertial_acceleration(a_n, a) :
              a;
        }
    for (const Stopped &node : stopped)
      {
        new_velocity.local_element(node.entry) = node.velocity;
        new_acceleration.local_element(node.entry) =
          from_stresses && !in_trial() ? 0. : node.acceleration;
      }
    stop_at_walls();
  }



  template <int dim>
  std::pair<Tensor<1, dim>, Tensor<1, dim>>
  InertiaTerm<dim>::point(const StepContext<dim>                   &step,
                          const typename PointArrays<dim>::Stencil &stencil,
                          const Tensor<1, dim> &old_velocity) const
  {
    Tensor<1, dim> v = kept_part * old_velocity, a;
    for (unsigned int I = 0; I < stencil.n_nodes; ++I)
      {
        const double       N     = stencil.shape[I];
        const unsigned int first = step.nodes.node(stencil.vertex[I]) * dim;
        for (unsigned int d = 0; d < dim; ++d)
          {
            v[d] += N * new_velocity.local_element(first + d);
            if (kept_part > 0)
              v[d] -= N * kept_part * projected.local_element(first + d);
            a[d] += N * new_acceleration.local_element(first + d);
          }
      }
    return {v, a};
  }



  template class InertiaTerm<2>;
  template class InertiaTerm<3>;
} // namespace isochor
