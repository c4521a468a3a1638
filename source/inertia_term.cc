/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/inertia_term.h>

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
                      "Whether the body has inertia (Newmark's scheme), or is "
                      "in equilibrium at all times.");
    prm.declare_entry("Newmark beta",
                      "0.25",
                      Patterns::Double(0.0001, 0.5),
                      "0.25 with gamma = 0.5: constant average acceleration.");
    prm.declare_entry("Newmark gamma",
                      "0.5",
                      Patterns::Double(0.5, 1),
                      "Above 0.5 high frequencies are damped.");
    prm.declare_entry("Initial velocity",
                      "",
                      Patterns::Anything(),
                      "Velocity (m/s) of the points at t = 0, formulas in x, "
                      "y(, z): 'v_x, v_y(, v_z)'. Empty: at rest.");
    prm.leave_subsection();
  }



  template <int dim>
  bool
  InertiaTerm<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Dynamics");
    const bool dynamic = prm.get_bool("Inertia");
    beta               = prm.get_double("Newmark beta");
    gamma              = prm.get_double("Newmark gamma");
    initial_velocity   = prm.get("Initial velocity");
    prm.leave_subsection();
    AssertThrow(dynamic || initial_velocity.empty(),
                ExcMessage("The parameter <Dynamics/Initial velocity> needs "
                           "<Dynamics/Inertia = true>."));
    return dynamic;
  }



  template <int dim>
  void
  InertiaTerm<dim>::start_step(const StepContext<dim> &step)
  {
    const PointArrays<dim> &points = step.points;
    step.nodes.initialize(mapped, n_mapped);
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = points.stencil(step.grid.geometry(), k, q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const double       Nm = stencil.shape[I] * points.mass[q];
              const unsigned int entry =
                step.nodes.node(stencil.vertex[I]) * n_mapped;
              mapped.local_element(entry) += Nm;
              for (unsigned int a = 0; a < dim; ++a)
                {
                  mapped.local_element(entry + 1 + a) +=
                    Nm * points.velocity[q][a];
                  mapped.local_element(entry + 1 + dim + a) +=
                    Nm * points.acceleration[q][a];
                }
            }
        }
    mapped.compress(VectorOperation::add);
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      if (mapped.local_element(node * n_mapped) > 0)
        for (unsigned int i = 1; i < n_mapped; ++i)
          mapped.local_element(node * n_mapped + i) /=
            mapped.local_element(node * n_mapped);
    mapped.update_ghost_values();
  }



  template <int dim>
  void
  InertiaTerm<dim>::set_initial_acceleration(
    const StepContext<dim>                                     &step,
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    const NodalConstraints                                     &constraints,
    const NodalField                                           &unknowns,
    PointArrays<dim>                                           &points) const
  {
    StepContext<dim> start          = step;
    start.time                      = step.old_time;
    const unsigned int n_components = step.n_components;
    NodalField         force, mass;
    step.nodes.initialize(force, n_components);
    step.nodes.initialize(mass, 1);
    for (const auto &condition : conditions)
      {
        condition->add_external_force(start, force);
        condition->add_boundary_force(start, unknowns, force);
      }
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = points.stencil(step.grid.geometry(), k, q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            mass.local_element(step.nodes.node(stencil.vertex[I])) +=
              stencil.shape[I] * points.mass[q];
        }
    force.compress(VectorOperation::add);
    mass.compress(VectorOperation::add);
    for (unsigned int i = 0; i < step.nodes.n_owned() * n_components; ++i)
      {
        const double m         = mass.local_element(i / n_components);
        force.local_element(i) = constraints.constrained[i] || m == 0. ?
                                   0. :
                                   force.local_element(i) / m;
      }
    force.update_ghost_values();

    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = points.stencil(step.grid.geometry(), k, q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            for (unsigned int a = 0; a < dim; ++a)
              points.acceleration[q][a] +=
                stencil.shape[I] *
                force.local_element(
                  step.nodes.node(stencil.vertex[I]) * n_components + a);
        }
  }



  template <int dim>
  void
  InertiaTerm<dim>::collect_elements(const StepContext<dim> &step,
                                     ElementNodes           &elements)
  {
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      elements.add(&node, &node + 1);
  }



  template <int dim>
  Tensor<1, dim>
  InertiaTerm<dim>::acceleration(const StepContext<dim> &step,
                                 const NodalField       &unknowns,
                                 const unsigned int      node) const
  {
    const double   dt = step.step_size();
    Tensor<1, dim> a;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double u   = unknowns.local_element(node * step.n_components + d);
        const double v   = mapped.local_element(node * n_mapped + 1 + d);
        const double a_n = mapped.local_element(node * n_mapped + 1 + dim + d);
        a[d] = (u - dt * v) / (beta * dt * dt) - (0.5 / beta - 1.) * a_n;
      }
    return a;
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
    const unsigned int                        n  = step.n_components;
    const double                              dt = step.step_size();
    std::array<double, dim + 1>               residual{};
    std::array<double, (dim + 1) * (dim + 1)> matrix{};
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      {
        const double mass = mapped.local_element(node * n_mapped);
        const auto   a    = acceleration(step, unknowns, node);
        for (unsigned int d = 0; d < dim; ++d)
          {
            residual[d]       = mass * a[d];
            matrix[d * n + d] = mass / (beta * dt * dt);
          }
        system.add_element(first_element + node,
                           residual.data(),
                           with_matrix ? matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template class InertiaTerm<2>;
  template class InertiaTerm<3>;
} // namespace isochor
