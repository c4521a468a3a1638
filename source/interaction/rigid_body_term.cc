/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/rigid_body_term.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace isochor
{
  template <int dim>
  std::array<unsigned int, RigidBody<dim>::n_components>
  RigidBodyInScene<dim>::entries(const StepContext<dim> &step) const
  {
    std::array<unsigned int, RigidBody<dim>::n_components> result;
    result.fill(numbers::invalid_unsigned_int);
    if (first_control_node == numbers::invalid_unsigned_int)
      return result;
    for (unsigned int i = 0; i < result.size(); ++i)
      {
        const unsigned int node = step.nodes.node(
          step.nodes.control_vertex(first_control_node + (i < dim ? 0 : 1)));
        if (node != numbers::invalid_unsigned_int)
          result[i] = node * step.n_components + (i < dim ? i : i - dim);
      }
    return result;
  }



  template <int dim>
  typename RigidBodyInScene<dim>::Components
  RigidBodyInScene<dim>::increments(const StepContext<dim> &step,
                                    const NodalField       &unknowns) const
  {
    Components result{};
    const auto at = entries(step);
    for (unsigned int i = 0; i < result.size(); ++i)
      if (body.is_free(i) && at[i] != numbers::invalid_unsigned_int)
        result[i] = unknowns.local_element(at[i]) / scale(i);
    return result;
  }



  template <int dim>
  std::vector<ControlNode<dim>>
  RigidBodyTerm<dim>::control_nodes() const
  {
    std::vector<ControlNode<dim>> nodes;
    for (const auto &one : bodies)
      if (one->body.has_free_components())
        {
          ControlNode<dim> node;
          node.position =
            one->body.old_pose().place(one->body.shape().centre());
          nodes.push_back(node);
          node.rotation_arm = one->arm;
          nodes.push_back(node);
        }
    return nodes;
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::set_first_control_node(const unsigned int first)
  {
    unsigned int next = first;
    for (const auto &one : bodies)
      if (one->body.has_free_components())
        {
          one->first_control_node = next;
          next += 2;
        }
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::touch_masters(const ActiveNodes<dim>    &nodes,
                                    std::vector<unsigned int> &vertices)
  {
    for (const auto &one : bodies)
      if (one->body.has_free_components())
        for (const unsigned int k : {0, 1})
          vertices.push_back(nodes.control_vertex(one->first_control_node + k));
  }



  template <int dim>
  bool
  RigidBodyTerm<dim>::owns(const StepContext<dim>      &step,
                           const RigidBodyInScene<dim> &one) const
  {
    return one.body.has_free_components() &&
           one.entries(step)[0] < step.nodes.n_owned() * step.n_components;
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::collect_elements(const StepContext<dim> &step,
                                       ElementNodes           &elements)
  {
    for (const auto &one : bodies)
      if (owns(step, *one))
        {
          const auto                        at    = one->entries(step);
          const std::array<unsigned int, 2> nodes = {
            {at[0] / step.n_components, at[dim] / step.n_components}};
          elements.add(nodes.begin(), nodes.end());
        }
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::constrain(const StepContext<dim> &step,
                                NodalConstraints       &constraints) const
  {
    // a search for accelerations: rigid bodies know theirs
    const bool is_trial = in_trial || step.time == step.old_time;
    for (const auto &one : bodies)
      {
        const auto at = one->entries(step);
        if (at[0] == numbers::invalid_unsigned_int)
          continue;
        const auto coasts = one->body.coast(step.time - step.old_time);
        for (unsigned int i = 0; i < n_components; ++i)
          if (is_trial || !one->body.is_free(i))
            constraints.constrain(
              at[i], one->body.is_free(i) ? coasts[i] * one->scale(i) : 0.);
        // components of the second node that are no rotation
        for (unsigned int a = RigidBody<dim>::n_rotations; a < dim; ++a)
          constraints.constrain(at[dim] + a, 0.);
        if (step.mixed()) // neither node has a pressure
          for (const unsigned int first : {at[0], at[dim]})
            constraints.constrain(first + dim, 0.);
      }
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::set_trial(const StepContext<dim> &step,
                                const double            trial_size,
                                const SmoothStart      &start)
  {
    in_trial = trial_size != 0 && step.time != step.old_time;
    for (const auto &one : bodies)
      one->body.set_trial({step.old_time, step.time, trial_size, start});
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::note_start(const StepContext<dim> &start,
                                 const NodalField & /*unknowns*/,
                                 const NodalField &forces)
  {
    for (const auto &one : bodies)
      {
        if (!one->body.has_free_components())
          continue;
        std::vector<double> sums(n_components);
        if (owns(start, *one))
          for (unsigned int i = 0; i < n_components; ++i)
            sums[i] =
              forces.local_element(one->entries(start)[i]) * one->scale(i);
        Utilities::MPI::sum(sums, start.grid.communicator(), sums);
        typename RigidBody<dim>::Components all;
        std::copy(sums.begin(), sums.end(), all.begin());
        one->body.accelerate(all);
      }
  }



  template <int dim>
  EvaluationStatus
  RigidBodyTerm<dim>::assemble(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const NodalField       &pending,
                               const unsigned int      first_element,
                               const bool              with_matrix,
                               MixedSystem<dim>       &system)
  {
    const unsigned int  nc = step.n_components, n_dofs = 2 * nc;
    std::vector<double> residual(n_dofs), matrix(n_dofs * n_dofs);
    unsigned int        element = first_element;
    for (const auto &one : bodies)
      {
        if (!owns(step, *one))
          continue;
        typename RigidBody<dim>::Components R{};
        typename RigidBody<dim>::Matrix     K{};
        one->body.equations(step.time,
                            RigidScheme(step.has_inertia ? step.step_size() :
                                                           0),
                            one->increments(step, unknowns),
                            R,
                            K);
        std::fill(residual.begin(), residual.end(), 0.);
        std::fill(matrix.begin(), matrix.end(), 0.);
        const auto place = [&](const unsigned int i) {
          return i < dim ? i : nc + i - dim;
        };
        for (unsigned int i = 0; i < n_components; ++i)
          {
            residual[place(i)] = R[i] / one->scale(i);
            for (unsigned int j = 0; j < n_components; ++j)
              matrix[place(i) * n_dofs + place(j)] =
                K[i][j] / (one->scale(i) * one->scale(j));
          }
        system.add_element(element++,
                           residual.data(),
                           with_matrix ? matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  bool
  RigidBodyTerm<dim>::assembles_load(const StepContext<dim> &step) const
  {
    return std::any_of(bodies.begin(), bodies.end(), [&](const auto &one) {
      typename RigidBody<dim>::Components R{};
      typename RigidBody<dim>::Matrix     K{};
      one->body.equations(step.time, RigidScheme(), {}, R, K);
      return std::any_of(R.begin(), R.end(), [](const double load) {
        return load != 0.;
      });
    });
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::add_boundary_force(const StepContext<dim> &step,
                                         const NodalField & /*unknowns*/,
                                         NodalField &force) const
  {
    // the loads
    for (const auto &one : bodies)
      {
        if (!owns(step, *one))
          continue;
        typename RigidBody<dim>::Components R{};
        typename RigidBody<dim>::Matrix     K{};
        one->body.equations(step.time, RigidScheme(), {}, R, K);
        const auto at = one->entries(step);
        for (unsigned int i = 0; i < n_components; ++i)
          force.local_element(at[i]) -= R[i] / one->scale(i);
      }
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::evaluate(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const MixedSystem<dim> & /*system*/,
                               const NodalConstraints & /*constraints*/,
                               Statistics &statistics) const
  {
    for (const auto &one : bodies)
      one->body.set_statistics(step.time,
                               one->increments(step, unknowns),
                               statistics);
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::advance(const StepContext<dim> &step,
                              const NodalField       &unknowns)
  {
    for (const auto &one : bodies)
      one->body.advance(step.time,
                        RigidScheme(step.has_inertia ? step.step_size() : 0),
                        one->increments(step, unknowns));
  }



  template <int dim>
  std::optional<double>
  RigidBodyTerm<dim>::kinetic_energy() const
  {
    std::optional<double> energy;
    for (const auto &one : bodies)
      if (one->body.has_free_components())
        energy = energy.value_or(0) + one->body.kinetic_energy();
    return energy;
  }



  template <int dim>
  std::string
  RigidBodyTerm<dim>::save_state() const
  {
    std::string text;
    for (const auto &one : bodies)
      {
        const std::string state = one->body.save_state();
        text += std::to_string(state.size()) + ' ' + state;
      }
    return text;
  }



  template <int dim>
  void
  RigidBodyTerm<dim>::load_state(const std::string &state)
  {
    std::istringstream text(state);
    for (const auto &one : bodies)
      {
        std::size_t n = 0;
        text >> n;
        text.get();
        std::string of_body(n, ' ');
        text.read(of_body.data(), n);
        one->body.load_state(of_body);
      }
  }



  template struct RigidBodyInScene<2>;
  template struct RigidBodyInScene<3>;
  template class RigidBodyTerm<2>;
  template class RigidBodyTerm<3>;
} // namespace isochor
