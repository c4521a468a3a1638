/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_term.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace isochor
{
  template <int dim>
  InteractionTerm<dim>::InteractionTerm(
    std::vector<std::unique_ptr<Interaction<dim>>> &&interactions,
    std::vector<std::unique_ptr<Interaction<dim>>> &&loads,
    const std::vector<OneSidedWall>                 &walls)
    : interactions(std::move(interactions))
    , loads(std::move(loads))
    , walls(walls)
  {
    this->name = "Interactions";
  }



  template <int dim>
  void
  InteractionTerm<dim>::set_nodes(const StepContext<dim>    &step,
                                  const FaceElement         &element,
                                  std::vector<unsigned int> &nodes) const
  {
    const auto &face    = surface.faces()[element.face];
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
    for (const FaceElement &element : faces)
      {
        set_nodes(step, element, nodes);
        elements.add(nodes.begin(), nodes.end());
      }
    loads.collect_elements(step, elements);
  }



  template <int dim>
  typename SurfaceStress<dim>::Domain
  InteractionTerm<dim>::domain(const StepContext<dim> &step,
                               const unsigned int      f) const
  {
    const auto &face = surface.faces()[f];
    return {step.kernel.materials[points->material[face.q]].get(),
            points->F[face.q],
            points->history.data() + face.q * std::size_t(points->n_history),
            points->radius.empty() ? 0. : points->radius[face.q],
            points->stencil(grid->geometry(), face.k, face.q),
            memory.kept(BodySurface<dim>::key(face))};
  }



  template <int dim>
  void
  InteractionTerm<dim>::prepare(const StepContext<dim> &step)
  {
    if (!is_checked) // a run that is resumed on a kept grid; on all ranks
      find_faces();
    NodalField rest;
    step.nodes.initialize(rest, step.n_components);
    rest.update_ghost_values();
    update_partners(step, rest);
    for (FaceElement &element : faces)
      {
        const auto &face   = surface.faces()[element.face];
        const auto  of     = domain(step, element.face);
        const auto  status = stress.evaluate(
          step.kernel,
          of,
          face.normal,
          [](const unsigned int) { return Tensor<1, dim>(); },
          [&](const unsigned int) { return double(points->pressure[face.q]); },
          true);
        AssertThrow(status == EvaluationStatus::success,
                    ExcMessage("The stress of a point can't be evaluated as it "
                               "was at the end of the last step."));
        element.start.clear();
        element.gamma =
          2 *
          surface_stiffness(step, stress, *of.material, face.area_per_volume);
        element.area_ratio = stress.area.norm();
        element.normal     = stress.area / element.area_ratio;
        for (unsigned int g = 0; g < BodySurface<dim>::n_gauss; ++g)
          look_at_partners(step, g, element);
        element.adjoint.clear();
        for (unsigned int J = 0; J < of.stencil.n_nodes && step.has_inertia;
             ++J)
          for (unsigned int b = 0; b < dim; ++b)
            element.adjoint.push_back(
              stress.elastic_traction_by_displacement(J, b));
      }
  }



  template <int dim>
  void
  InteractionTerm<dim>::note_start(const StepContext<dim> &start,
                                   const NodalField       &unknowns,
                                   const NodalField & /*forces*/)
  {
    update_partners(start, unknowns);
    InteractionKernel<dim> kernel;
    std::vector<Action>    actions;
    for (FaceElement &element : faces)
      {
        actions.clear();
        evaluate_face(start, unknowns, element, false, kernel, &actions);
        element.start.assign(BodySurface<dim>::n_gauss *
                               element.partners.size(),
                             {});
        for (const Action &action : actions)
          element.start[action.gauss_point * element.partners.size() +
                        action.partner] = action.end;
      }
  }



  template <int dim>
  typename InteractionTerm<dim>::ActingPartners
  InteractionTerm<dim>::acting(const FaceElement &element,
                               const unsigned int g,
                               const typename Partner<dim>::SurfacePlace &place,
                               const double                               p,
                               const GivenTraction<dim> &given) const
  {
    const Tensor<1, dim> t =
      stress.traction(p) - given.dead + given.pressure * stress.area;
    ActingPartners all;
    unsigned int   nearest = 0, n_closed = 0;
    bool           nearest_is_closed = false;
    for (unsigned int i = 0; i < element.partners.size(); ++i)
      {
        const Interaction<dim> &one = *interactions[element.partners[i]];
        if (!one.law->is_unilateral())
          return {{i, one.partner->original(place), true}};
        if (element.facing[g][i] == 0)
          continue;
        all.push_back({i, one.partner->nearest(place), false});
        const PartnerPlace<dim> &found = all.back().place;
        const bool               is_closed =
          t * found.normal > element.gamma * found.normal_gap;
        n_closed += is_closed;
        if (all.size() == 1 || found.normal_gap < all[nearest].place.normal_gap)
          {
            nearest           = all.size() - 1;
            nearest_is_closed = is_closed;
          }
      }
    if (!all.empty())
      all[nearest].is_alone = n_closed == (nearest_is_closed ? 1 : 0);
    return all;
  }



  template <int dim>
  typename InteractionKernel<dim>::Measure
  InteractionTerm<dim>::measure_of(
    const StepContext<dim>                 &step,
    const FaceElement                      &element,
    const unsigned int                      g,
    const unsigned int                      partner,
    const typename BodySurface<dim>::Place &start,
    const bool                              is_alone) const
  {
    const auto         &face = surface.faces()[element.face];
    const double *const history =
      step.points.history.data() +
      face.q * static_cast<std::size_t>(step.points.n_history);
    // R = r / F_θθ, not X: flips give a point the mean of what flows in
    return {start.weight * face.area * element.facing[g][partner] *
              thickness(step.kernel.axisymmetric,
                        start.x[0] / step.kernel.hoop_stretch(history)),
            element.gamma,
            step.has_inertia ? 1. : 0.,
            element.area_ratio,
            rounding_of_contact(element.gamma, face.area_per_volume),
            step.unknowns_at_start != nullptr && step.step_size() > 0 &&
                !element.start.empty() ?
              &element.start[g * element.partners.size() + partner] :
              nullptr,
            step.end_weight,
            element.body_is_nearer[g] || !is_alone};
  }



  template <int dim>
  EvaluationStatus
  InteractionTerm<dim>::evaluate_face(const StepContext<dim> &step,
                                      const NodalField       &unknowns,
                                      const FaceElement      &element,
                                      const bool              with_matrix,
                                      InteractionKernel<dim> &kernel,
                                      std::vector<Action>    *actions) const
  {
    const auto              &face = surface.faces()[element.face];
    const auto               of   = domain(step, element.face);
    const auto              &N_p  = of.stencil;
    const NodalUnknowns<dim> nodal(step, unknowns);
    const auto               pressure = [&](const unsigned int I) {
      return nodal.pressure(N_p.vertex[I]);
    };
    const EvaluationStatus status = stress.evaluate(
      step.kernel,
      of,
      face.normal,
      [&](const unsigned int I) { return nodal.increment(N_p.vertex[I]); },
      pressure,
      with_matrix);
    if (status != EvaluationStatus::success)
      return status;

    std::vector<unsigned int> first_of_partner;
    unsigned int              n_nodes = N_p.n_nodes;
    for (const unsigned int i : element.partners)
      {
        first_of_partner.push_back(n_nodes);
        n_nodes +=
          interactions[i]->partner->control_vertices(step.nodes).size();
      }
    kernel.start_element(n_nodes, step.n_components, with_matrix);
    std::vector<double>       N(N_p.n_nodes);
    std::vector<unsigned int> own_nodes(N_p.n_nodes);
    std::iota(own_nodes.begin(), own_nodes.end(), 0);
    std::vector<std::vector<typename InteractionKernel<dim>::PartnerMotion>>
      motions;
    for (unsigned int g = 0; g < BodySurface<dim>::n_gauss; ++g)
      {
        auto                 start = BodySurface<dim>::place(step, face, g);
        const Tensor<1, dim> remembered =
          memory.get(BodySurface<dim>::key(face), g);
        if (element.is_tied)
          start.shift(remembered);
        typename Partner<dim>::SurfacePlace place{&start,
                                                  {},
                                                  remembered,
                                                  element.normal};
        double                              p = 0;
        for (unsigned int I = 0; I < N_p.n_nodes; ++I)
          {
            const double by_r = N_p.gradient[I] * start.r;
            N[I]              = N_p.shape[I] + by_r;
            place.increment += N[I] * nodal.increment(N_p.vertex[I]);
            if (step.mixed())
              p += N[I] * pressure(I);
          }
        const auto given =
          loads.traction(element.loads, start.X, face.stretch, step.time);
        for (const auto &[chosen, found, is_alone] :
             acting(element, g, place, p, given))
          {
            const Interaction<dim> &interaction =
              *interactions[element.partners[chosen]];
            kernel.start_place();
            kernel.add_side(
              {&stress,
               N_p.n_nodes,
               own_nodes.data(),
               N.data(),
               N_p.shape,
               p,
               1.,
               1.,
               element.adjoint.empty() ? nullptr : element.adjoint.data(),
               given});
            interaction.partner->motion(place,
                                        interaction.law->is_unilateral(),
                                        motions);
            for (unsigned int c = 0; c < motions.size(); ++c)
              for (unsigned int a = 0; a < motions[c].size(); ++a)
                kernel.add_partner(first_of_partner[chosen] + c,
                                   a,
                                   motions[c][a]);
            // the work of statics begins with what there was
            if (const auto key = BodySurface<dim>::key(face);
                !step.has_inertia && step.step_size() == 0 && forces.knows(key))
              {
                kernel.add_force(forces.get(key, g));
                break;
              }
            const auto measure =
              measure_of(step, element, g, chosen, start, is_alone);
            const auto projection =
              kernel.add(*interaction.law, found, measure);
            if (actions == nullptr)
              continue;
            const auto flow = flow_at(step, element, of);
            actions->push_back(
              {chosen,
               g,
               start.x + place.increment -
                 (interaction.law->is_unilateral() ?
                    found.normal_gap * found.normal :
                    found.gap),
               measure.weight * (interaction.law->is_unilateral() ?
                                   kernel.mean_traction() :
                                   kernel.at_end().f),
               kernel.remembered(*interaction.law,
                                 stress.carried(remembered),
                                 flow),
               flow.kept,
               projection.state,
               kernel.at_end()});
          }
      }
    return EvaluationStatus::success;
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
    InteractionKernel<dim> kernel;
    for (unsigned int e = 0; e < faces.size(); ++e)
      {
        const EvaluationStatus status =
          evaluate_face(step, unknowns, faces[e], with_matrix, kernel, nullptr);
        if (status != EvaluationStatus::success)
          return status;
        system.add_element(first_element + e,
                           kernel.residual.data(),
                           with_matrix ? kernel.matrix.data() : nullptr,
                           pending);
      }
    return loads.assemble(step,
                          unknowns,
                          pending,
                          first_element + faces.size(),
                          with_matrix,
                          system);
  }



  template <int dim>
  void
  InteractionTerm<dim>::add_unit_residual(const StepContext<dim> &step,
                                          NodalField             &scale) const
  {
    for (const FaceElement &element : faces)
      {
        const auto &face    = surface.faces()[element.face];
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
    InteractionKernel<dim>    kernel;
    std::vector<unsigned int> nodes;
    for (const FaceElement &element : faces)
      {
        // what can't be evaluated stops assemble(), too
        if (evaluate_face(step, unknowns, element, false, kernel, nullptr) !=
            EvaluationStatus::success)
          return;
        set_nodes(step, element, nodes);
        for (unsigned int I = 0; I < nodes.size(); ++I)
          for (unsigned int a = 0; a < step.n_components; ++a)
            force.local_element(nodes[I] * step.n_components + a) -=
              kernel.residual[I * step.n_components + a];
      }
    loads.add_pressures(step, unknowns, force);
  }



  template class InteractionTerm<2>;
  template class InteractionTerm<3>;
} // namespace isochor
