/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/interaction/interaction_term.h>

#include <algorithm>
#include <array>
#include <utility>

namespace isochor
{
  template <int dim>
  InteractionTerm<dim>::InteractionTerm(Interactions<dim> &&interactions,
                                        Interactions<dim> &&loads,
                                        const std::vector<OneSidedWall> &walls)
    : interactions(std::move(interactions))
    , loads(std::move(loads))
    , walls(walls)
    , faces(this->interactions)
    , kernel(this->interactions, this->loads, faces, history)
  {
    this->name = "Interactions";
  }



  template <int dim>
  void
  InteractionTerm<dim>::set_nodes(const StepContext<dim>     &step,
                                  const InteractionFace<dim> &element,
                                  std::vector<unsigned int>  &nodes) const
  {
    const auto &face    = faces.in_surface(element);
    const auto  stencil = points->stencil(grid->geometry(), face.k, face.q);
    nodes.clear();
    for (unsigned int I = 0; I < stencil.n_nodes; ++I)
      nodes.push_back(step.nodes.node(stencil.vertex[I]));
    for (const unsigned int i : element.partners)
      for (const unsigned int vertex :
           interactions[i]->partner->control_vertices(step.nodes))
        nodes.push_back(step.nodes.node(vertex));
  }



  template <int dim>
  void
  InteractionTerm<dim>::collect_elements(const StepContext<dim> &step,
                                         ElementNodes           &elements)
  {
    std::vector<unsigned int> nodes;
    for (const InteractionFace<dim> &element : faces.all())
      {
        set_nodes(step, element, nodes);
        elements.add(nodes.begin(), nodes.end());
      }
    loads.collect_elements(step, elements);
  }



  template <int dim>
  void
  InteractionTerm<dim>::prepare(const StepContext<dim> &step)
  {
    if (!faces
           .are_known()) // a run that is resumed on a kept grid; on all ranks
      find_faces();
    NodalField rest;
    step.nodes.initialize(rest, step.n_components);
    rest.update_ghost_values();
    update_partners(step, rest);
    for (InteractionFace<dim> &face : faces.all())
      {
        kernel.start_step(step, face);
        faces.look_at_partners(step, face);
      }
  }



  template <int dim>
  void
  InteractionTerm<dim>::note_start(const StepContext<dim> &start,
                                   const NodalField       &unknowns,
                                   const NodalField & /*forces*/)
  {
    update_partners(start, unknowns);
    std::vector<Action> actions;
    for (InteractionFace<dim> &element : faces.all())
      {
        actions.clear();
        kernel.evaluate(start, unknowns, element, false, &actions);
        element.start.assign(BodySurface<dim>::n_gauss *
                               element.partners.size(),
                             {});
        for (const Action &action : actions)
          element.start[action.gauss_point * element.partners.size() +
                        action.partner] = action.end;
      }
  }



  template <int dim>
  EvaluationStatus
  InteractionTerm<dim>::assemble(const StepContext<dim> &step,
                                 const NodalField       &unknowns,
                                 const NodalField       &pending,
                                 const unsigned int      first_element,
                                 const bool              with_matrix,
                                 MixedSystem<dim>       &system)
  {
    update_partners(step, unknowns);
    for (unsigned int e = 0; e < faces.all().size(); ++e)
      {
        const EvaluationStatus status =
          kernel.evaluate(step, unknowns, faces.all()[e], with_matrix);
        if (status != EvaluationStatus::success)
          return status;
        system.add_element(first_element + e,
                           kernel.residual().data(),
                           with_matrix ? kernel.matrix().data() : nullptr,
                           pending);
      }
    return loads.assemble(step,
                          unknowns,
                          pending,
                          first_element + faces.all().size(),
                          with_matrix,
                          system);
  }



  template <int dim>
  void
  InteractionTerm<dim>::add_unit_residual(const StepContext<dim> &step,
                                          NodalField             &scale) const
  {
    for (const InteractionFace<dim> &element : faces.all())
      {
        const auto &face    = faces.in_surface(element);
        const auto  stencil = points->stencil(grid->geometry(), face.k, face.q);
        const Point<dim> x = points->location(grid->geometry(), face.k, face.q);
        add_rounding_of_gap(step,
                            stencil.n_nodes,
                            stencil.vertex,
                            stencil.shape,
                            face.area *
                              thickness(step.kernel.axisymmetric, x[0]),
                            element.gamma,
                            x.norm(),
                            scale);
      }
  }



  template <int dim>
  void
  InteractionTerm<dim>::add_boundary_force(const StepContext<dim> &step,
                                           const NodalField       &unknowns,
                                           NodalField             &force) const
  {
    update_partners(step, unknowns);
    std::vector<unsigned int> nodes;
    for (const InteractionFace<dim> &element : faces.all())
      {
        // what can't be evaluated stops assemble(), too
        if (kernel.evaluate(step, unknowns, element, false) !=
            EvaluationStatus::success)
          return;
        set_nodes(step, element, nodes);
        for (unsigned int I = 0; I < nodes.size(); ++I)
          for (unsigned int a = 0; a < step.n_components; ++a)
            force.local_element(nodes[I] * step.n_components + a) -=
              kernel.residual()[I * step.n_components + a];
      }
    loads.add_pressures(step, unknowns, force);
  }



  template <int dim>
  std::vector<std::array<double, dim + 3>>
  InteractionTerm<dim>::resultants(const StepContext<dim> &step,
                                   const NodalField       &unknowns) const
  {
    std::vector<std::array<double, dim + 3>> sums(interactions.size());
    std::vector<Action>                      actions;
    history.start_noting();
    update_partners(step, unknowns);
    for (const InteractionFace<dim> &element : faces.all())
      {
        actions.clear();
        kernel.evaluate(step, unknowns, element, false, &actions);
        const auto key = BodySurface<dim>::key(faces.in_surface(element));
        std::array<Tensor<1, dim>, BodySurface<dim>::n_gauss> on_place;
        for (const Action &action : actions)
          {
            const unsigned int i   = element.partners[action.partner];
            auto              &sum = sums[i];
            for (unsigned int a = 0; a < dim; ++a)
              sum[a] += action.force[a];
            const Tensor<1, 3> moment =
              interactions[i]->partner->moment(action.y,
                                               action.force,
                                               step.has_inertia);
            for (unsigned int a = 0; a < 3; ++a)
              sum[dim + a] += moment[a];
            on_place[action.gauss_point] += action.force;
            history.forces.set_next(key,
                                    action.gauss_point,
                                    on_place[action.gauss_point]);
            if (action.kept < 1 || action.remembered.norm_square() > 0)
              history.gaps.set_next(key,
                                    action.gauss_point,
                                    action.remembered,
                                    action.kept);
          }
      }
    for (auto &sum : sums)
      sum_over_ranks(sum, step.grid.communicator());
    return sums;
  }



  template <int dim>
  void
  InteractionTerm<dim>::evaluate(const StepContext<dim> &step,
                                 const NodalField       &unknowns,
                                 const MixedSystem<dim> & /*system*/,
                                 const NodalConstraints &constraints,
                                 Statistics             &statistics) const
  {
    loads.evaluate(step, unknowns, constraints, statistics);
    if (interactions.empty())
      return;
    const auto sums = resultants(step, unknowns);
    for (unsigned int i = 0; i < interactions.size(); ++i)
      {
        const std::string of = " on " + interactions[i]->body + " by " +
                               interactions[i]->partner_name;
        for (unsigned int a = 0; a < dim; ++a)
          statistics.set(interactions[i]->force_column(a), sums[i][a]);
        const bool turns =
          interactions[i]->partner->has_moments() && !step.kernel.axisymmetric;
        for (unsigned int a = (dim == 2 ? 2 : 0); a < 3 && turns; ++a)
          statistics.set((dim == 2 ? std::string("Moment") :
                                     std::string("Moment ") + "xyz"[a]) +
                           of + " (N m)",
                         sums[i][dim + a]);
      }
  }



  template <int dim>
  std::string
  InteractionTerm<dim>::objection(const StepContext<dim> &step,
                                  const NodalField       &unknowns) const
  {
    update_partners(step, unknowns);
    const NodalUnknowns<dim> nodal(step, unknowns);
    std::vector<double>      depths(interactions.size());
    for (const InteractionFace<dim> &element : faces.all())
      {
        const auto      &face = faces.in_surface(element);
        const auto       N = points->stencil(grid->geometry(), face.k, face.q);
        const Point<dim> x = points->location(grid->geometry(), face.k, face.q);
        std::array<typename Partner<dim>::Way, dim + 1> corners;
        Tensor<1, dim>                                  opposite;
        for (unsigned int c = 0; c <= dim; ++c)
          {
            const Tensor<1, dim> r =
              c < dim ? points->F[face.q] * face.corners[c] : opposite;
            opposite -= r;
            corners[c] = {{x + r, x + r}};
            for (unsigned int I = 0; I < N.n_nodes; ++I)
              corners[c][1] +=
                (N.shape[I] + N.gradient[I] * r) * nodal.increment(N.vertex[I]);
          }
        for (const unsigned int i : element.partners)
          if (interactions[i]->law->is_unilateral())
            depths[i] =
              std::max(depths[i], interactions[i]->partner->depth(corners));
      }
    Utilities::MPI::max(depths, step.grid.communicator(), depths);
    for (unsigned int i = 0; i < depths.size(); ++i)
      if (depths[i] > 0)
        return "<" + interactions[i]->partner_name + "> is " +
               rounded(depths[i]) + " m deep in <" + interactions[i]->body +
               ">, from where contact can't push it out (<" +
               interactions[i]->section +
               ">): let them be apart at t = 0, or take smaller steps";
    return {};
  }



  template class InteractionTerm<2>;
  template class InteractionTerm<3>;
} // namespace isochor
