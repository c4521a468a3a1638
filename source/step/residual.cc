/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/rounding.h>
#include <isochor/equations/invariants.h>
#include <isochor/step/residual.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  Residual<dim>::Residual(const Scene<dim>       &scene,
                          const StepSetup<dim>   &setup,
                          const NodalConstraints &constraints,
                          MixedSystem<dim>       &system)
    : scene(scene)
    , setup(setup)
    , constraints(constraints)
    , system(system)
  {}



  template <int dim>
  void
  Residual<dim>::start_step()
  {
    for (NodalField *field : {&pending, &external_force, &boundary_force})
      setup.active_nodes().initialize(*field, scene.n_components);
    // ranks write all that they hold themselves
    pending.set_ghost_state(true);
  }



  template <int dim>
  void
  Residual<dim>::set_loads()
  {
    external_force = 0.;
    external_force.zero_out_ghost_values();
    for (const auto &condition : scene.boundary_conditions)
      condition->add_external_force(setup.context(), external_force);
    external_force.compress(VectorOperation::add);
  }



  template <int dim>
  void
  Residual<dim>::compute_floor()
  {
    // strains carry rounding errors of some 1e-15: residuals of ten times that
    // are zero
    const ActiveNodes<dim> &nodes        = setup.active_nodes();
    const unsigned int      n_components = scene.n_components;
    const MPI_Comm          comm         = scene.grid.communicator();
    NodalField              unit;
    nodes.initialize(unit, n_components);
    const auto sums = [&]() {
      unit.compress(VectorOperation::add);
      double force = 0, volume = 0;
      for (unsigned int i = 0; i < nodes.n_owned() * n_components; ++i)
        (i % n_components == dim ? volume : force) +=
          unit.local_element(i) * unit.local_element(i);
      return std::make_pair(Utilities::MPI::sum(force, comm),
                            Utilities::MPI::sum(volume, comm));
    };
    terms.front()->add_unit_residual(setup.context(), unit); // the body
    strain_floor = rounding::numbers * std::sqrt(sums().first);
    unit.zero_out_ghost_values();
    for (const EquationTerm<dim> *term : terms)
      if (term != terms.front())
        term->add_unit_residual(setup.context(), unit);
    const auto [force, volume] = sums();
    force_floor                = rounding::numbers * std::sqrt(force);
    volume_floor               = rounding::numbers * std::sqrt(volume);
  }



  template <int dim>
  ResidualNorms
  Residual<dim>::assemble(const NodalField &unknowns,
                          const bool        with_matrix,
                          const bool        at_start)
  {
    Assert(is_same_on_all_ranks(with_matrix, scene.grid.communicator()),
           ExcMessage("Ranks assemble different things."));
    Assert(invariants::fits(unknowns, setup.active_nodes(), scene.n_components),
           ExcOtherNodes());
    const StepContext<dim> step       = setup.context();
    const bool             is_pending = update_pending(unknowns);
    const bool is_dragged = update_boundary_force(step, unknowns, at_start);
    const EvaluationStatus status = assemble_terms(step, unknowns, with_matrix);
    return measure(status, is_pending || is_dragged);
  }



  template <int dim>
  NodalField
  Residual<dim>::change_without_start(const NodalField &unknowns)
  {
    StepContext<dim> step  = setup.context();
    step.unknowns_at_start = nullptr;
    NodalField in_balance  = system.residual;
    const auto status      = assemble_terms(step, unknowns, false);
    AssertThrow(status == EvaluationStatus::success, ExcInternalError());
    std::swap(in_balance, system.residual);
    return in_balance;
  }



  template <int dim>
  bool
  Residual<dim>::update_pending(const NodalField &unknowns)
  {
    AssertDimension(constraints.increment.size(),
                    constraints.constrained.size());
    Assert(invariants::fits(pending, setup.active_nodes(), scene.n_components),
           ExcOtherNodes());
    bool any = false;
    for (unsigned int i = 0; i < constraints.constrained.size(); ++i)
      if (constraints.constrained[i])
        {
          double &rest = pending.local_element(i);
          rest         = constraints.increment[i] - unknowns.local_element(i);
          any          = any ||
                (constraints.constrained[i] != NodalConstraints::follows &&
                 std::abs(rest) >
                   rounding::arithmetic * std::abs(constraints.increment[i]));
        }
    // what follows comes where those that it follows will be
    const Followers &followers = constraints.followers;
    for (unsigned int k = 0; k < followers.size(); ++k)
      {
        double     size = std::abs(followers.value[k]);
        const auto goal = [&](const unsigned int i) {
          return constraints.constrained[i] ? constraints.increment[i] :
                                              unknowns.local_element(i);
        };
        const double place =
          followers.value[k] + followers.sum(k, [&](const unsigned int i) {
            size = std::max(size, std::abs(goal(i)));
            return goal(i);
          });
        double &rest = pending.local_element(followers.entry[k]);
        rest         = place - unknowns.local_element(followers.entry[k]);
        if (std::abs(rest) <= rounding::arithmetic * size)
          rest = 0.;
        any = any || rest != 0.;
      }
    return any;
  }



  template <int dim>
  bool
  Residual<dim>::update_boundary_force(const StepContext<dim> &step,
                                       const NodalField       &unknowns,
                                       const bool              at_start)
  {
    bool is_dragged = false;
    boundary_force  = 0.;
    boundary_force.zero_out_ghost_values();
    for (const auto *const condition :
         with_role<const ActsByAssembly<dim>>(scene.boundary_conditions))
      {
        if (at_start && condition->moves_body(step))
          is_dragged = true;
        condition->add_boundary_force(step, unknowns, boundary_force);
      }
    boundary_force.compress(VectorOperation::add);
    return is_dragged;
  }



  template <int dim>
  LoadChange
  Residual<dim>::change_of_loads(const TimeInterval &other) const
  {
    const auto loads_at = [&](const double time) {
      StepContext<dim> step = setup.context();
      step.time             = time;
      NodalField loads, rest;
      setup.active_nodes().initialize(loads, scene.n_components);
      setup.active_nodes().initialize(rest, scene.n_components);
      rest.update_ghost_values();
      for (const auto &condition : scene.boundary_conditions)
        condition->add_external_force(step, loads);
      for (const auto *const condition :
           with_role<const ActsByAssembly<dim>>(scene.boundary_conditions))
        if (condition->assembles_load(step))
          condition->add_boundary_force(step, rest, loads);
      loads.compress(VectorOperation::add);
      return loads;
    };
    const auto change_in = [&](const TimeInterval &interval) {
      NodalField   change = loads_at(interval.end);
      const double all    = change.l1_norm();
      if (interval.start > 0) // nothing has been applied at t = 0
        change -= loads_at(interval.start);
      if (!(change.l1_norm() > rounding::accumulated * all))
        change = 0.;
      return change;
    };
    const StepContext<dim> step   = setup.context();
    const NodalField       change = change_in({step.old_time, step.time});
    LoadChange             result;
    result.size = change.l1_norm();
    if (result.size > 0 && !other.empty())
      {
        const NodalField reference = change_in(other);
        const double     norm      = reference.l2_norm() * change.l2_norm();
        result.likeness            = norm > 0 ? reference * change / norm : 0.;
      }
    return result;
  }



  template <int dim>
  EvaluationStatus
  Residual<dim>::assemble_terms(const StepContext<dim> &step,
                                const NodalField       &unknowns,
                                const bool              with_matrix)
  {
    Assert(!terms.empty(), ExcMessage("initialize() comes first."));
    system.start_assembly(with_matrix);
    EvaluationStatus status = EvaluationStatus::success;
    for (unsigned int t = 0; t < terms.size(); ++t)
      status = std::max(status,
                        terms[t]->assemble(step,
                                           unknowns,
                                           pending,
                                           setup.first_of_term()[t],
                                           with_matrix,
                                           system));
    system.finish_assembly(external_force);
    return status;
  }



  template <int dim>
  ResidualNorms
  Residual<dim>::measure(const EvaluationStatus status,
                         const bool             anything_pending) const
  {
    const MPI_Comm        comm         = scene.grid.communicator();
    const unsigned int    n_components = scene.n_components;
    std::array<double, 4> squares{}; // displacement, pressure, reaction, load
    for (unsigned int i = 0; i < setup.active_nodes().n_owned() * n_components;
         ++i)
      {
        const double r = system.residual.local_element(i);
        const double f =
          external_force.local_element(i) + boundary_force.local_element(i);
        const bool pressure = (i % n_components == dim);
        squares[constraints.constrained[i] ? 2 : (pressure ? 1 : 0)] += r * r;
        // what walls do, apart from prescribed unknowns
        const unsigned char how = constraints.constrained[i];
        if (system.has_equations() && system.is_held(i) &&
            how != NodalConstraints::prescribed)
          squares[2] += std::pow(system.reaction().local_element(i), 2);
        if (!pressure)
          squares[3] += f * f;
      }
    ResidualNorms norms;
    norms.status = static_cast<EvaluationStatus>(
      Utilities::MPI::max(static_cast<unsigned int>(status), comm));
    norms.pending =
      Utilities::MPI::max(static_cast<int>(anything_pending), comm) != 0;
    sum_over_ranks(squares, comm);
    norms.displacement = std::sqrt(squares[0]);
    norms.pressure     = std::sqrt(squares[1]);
    norms.force_scale =
      norms.pending ? 0. : std::sqrt(std::max(squares[2], squares[3]));
    norms.displacement_floor = force_floor;
    norms.pressure_floor     = volume_floor;
    norms.volume_per_force =
      strain_floor > 0 ? volume_floor / strain_floor : 0.;
    return norms;
  }



  template class Residual<2>;
  template class Residual<3>;
} // namespace isochor
