/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_face_kernel.h>

#include <numeric>

namespace isochor
{
  template <int dim>
  typename SurfaceStress<dim>::Domain
  InteractionFaceKernel<dim>::domain(const StepContext<dim>     &step,
                                     const InteractionFace<dim> &face) const
  {
    const auto             &in_surface = faces.in_surface(face);
    const PointArrays<dim> &points     = step.points;
    const unsigned int      q          = in_surface.q;
    return {step.kernel.materials[points.material[q]].get(),
            points.F[q],
            points.history.data() + q * std::size_t(points.n_history),
            points.radius.empty() ? 0. : points.radius[q],
            points.stencil(step.grid.geometry(), in_surface.k, q),
            history.gaps.kept(BodySurface<dim>::key(in_surface))};
  }



  template <int dim>
  void
  InteractionFaceKernel<dim>::start_step(const StepContext<dim> &step,
                                         InteractionFace<dim>   &face)
  {
    const auto &in_surface = faces.in_surface(face);
    const auto  of         = domain(step, face);
    const auto  status     = stress.evaluate(
      step.kernel,
      of,
      in_surface.normal,
      [](const unsigned int) { return Tensor<1, dim>(); },
      [&](const unsigned int) {
        return double(step.points.pressure[in_surface.q]);
      },
      true);
    AssertThrow(status == EvaluationStatus::success,
                ExcMessage("The stress of a point can't be evaluated as it "
                           "was at the end of the last step."));
    face.start.clear();
    face.gamma =
      2 *
      surface_stiffness(step, stress, *of.material, in_surface.area_per_volume);
    face.area_ratio = stress.area.norm();
    face.normal     = stress.area / face.area_ratio;
    face.adjoint.clear();
    for (unsigned int J = 0; J < of.stencil.n_nodes && step.has_inertia; ++J)
      for (unsigned int b = 0; b < dim; ++b)
        face.adjoint.push_back(stress.elastic_traction_by_displacement(J, b));
  }



  template <int dim>
  void
  InteractionFaceKernel<dim>::start_element(
    const StepContext<dim>                    &step,
    const InteractionFace<dim>                &face,
    const typename SurfaceStress<dim>::Domain &domain,
    const bool                                 with_matrix)
  {
    unsigned int n_nodes = domain.stencil.n_nodes;
    N.resize(n_nodes);
    own_nodes.resize(n_nodes);
    std::iota(own_nodes.begin(), own_nodes.end(), 0);
    first_of_partner.clear();
    for (const unsigned int i : face.partners)
      {
        first_of_partner.push_back(n_nodes);
        n_nodes +=
          interactions[i]->partner->control_vertices(step.nodes).size();
      }
    kernel.start_element(n_nodes, step.n_components, with_matrix);
  }



  template <int dim>
  void
  InteractionFaceKernel<dim>::go_to(
    const StepContext<dim>                    &step,
    const NodalField                          &unknowns,
    const InteractionFace<dim>                &face,
    const typename SurfaceStress<dim>::Domain &domain,
    const unsigned int                         g)
  {
    const auto              &in_surface = faces.in_surface(face);
    const NodalUnknowns<dim> nodal(step, unknowns);
    const auto              &stencil = domain.stencil;
    const Tensor<1, dim>     remembered =
      history.gaps.get(BodySurface<dim>::key(in_surface), g);
    place.g     = g;
    place.p     = 0;
    place.start = BodySurface<dim>::place(step, in_surface, g);
    if (face.is_tied)
      place.start.shift(remembered);
    place.at = {&place.start, {}, remembered, face.normal};
    for (unsigned int I = 0; I < stencil.n_nodes; ++I)
      {
        const double by_r = stencil.gradient[I] * place.start.r;
        N[I]              = stencil.shape[I] + by_r;
        place.at.increment += N[I] * nodal.increment(stencil.vertex[I]);
        if (step.mixed())
          place.p += N[I] * nodal.pressure(stencil.vertex[I]);
      }
    place.given =
      loads.traction(face.loads, place.start.X, in_surface.stretch, step.time);
  }



  template <int dim>
  void
  InteractionFaceKernel<dim>::find_acting(const InteractionFace<dim> &face)
  {
    const Tensor<1, dim> t = stress.traction(place.p) - place.given.dead +
                             place.given.pressure * stress.area;
    acting.clear();
    unsigned int nearest = 0, n_closed = 0;
    bool         nearest_is_closed = false;
    for (unsigned int i = 0; i < face.partners.size(); ++i)
      {
        const Interaction<dim> &one = *interactions[face.partners[i]];
        if (!one.law->is_unilateral())
          {
            acting.assign(1, {i, one.partner->original(place.at), true});
            return;
          }
        if (face.facing[place.g][i] == 0)
          continue;
        acting.push_back({i, one.partner->nearest(place.at), false});
        const PartnerPlace<dim> &found = acting.back().place;
        const bool is_closed = t * found.normal > face.gamma * found.normal_gap;
        n_closed += is_closed;
        if (acting.size() == 1 ||
            found.normal_gap < acting[nearest].place.normal_gap)
          {
            nearest           = acting.size() - 1;
            nearest_is_closed = is_closed;
          }
      }
    if (!acting.empty())
      acting[nearest].is_alone = n_closed == (nearest_is_closed ? 1 : 0);
  }



  template <int dim>
  typename InteractionKernel<dim>::Measure
  InteractionFaceKernel<dim>::measure_of(const StepContext<dim>     &step,
                                         const InteractionFace<dim> &face,
                                         const ActingPartner &acting) const
  {
    const auto         &in_surface = faces.in_surface(face);
    const double *const of_point =
      step.points.history.data() +
      in_surface.q * static_cast<std::size_t>(step.points.n_history);
    // R = r / F_θθ, not X: flips give a point the mean of what flows in
    return {place.start.weight * in_surface.area *
              face.facing[place.g][acting.partner] *
              thickness(step.kernel.axisymmetric,
                        place.start.x[0] / step.kernel.hoop_stretch(of_point)),
            face.gamma,
            step.has_inertia ? 1. : 0.,
            face.area_ratio,
            rounding_of_contact(face.gamma, in_surface.area_per_volume),
            step.unknowns_at_start != nullptr && step.step_size() > 0 &&
                !face.start.empty() ?
              &face.start[place.g * face.partners.size() + acting.partner] :
              nullptr,
            step.end_weight,
            face.is_farther[place.g] || !acting.is_alone};
  }



  template <int dim>
  void
  InteractionFaceKernel<dim>::add_sides(
    const InteractionFace<dim>                &face,
    const typename SurfaceStress<dim>::Domain &domain,
    const unsigned int                         partner)
  {
    const Interaction<dim> &interaction = *interactions[face.partners[partner]];
    kernel.start_place();
    kernel.add_side({&stress,
                     domain.stencil.n_nodes,
                     own_nodes.data(),
                     N.data(),
                     domain.stencil.shape,
                     place.p,
                     1.,
                     1.,
                     face.adjoint.empty() ? nullptr : face.adjoint.data(),
                     place.given});
    interaction.partner->motion(place.at,
                                interaction.law->is_unilateral(),
                                motions);
    for (unsigned int c = 0; c < motions.size(); ++c)
      for (unsigned int a = 0; a < motions[c].size(); ++a)
        kernel.add_partner(first_of_partner[partner] + c, a, motions[c][a]);
  }



  template <int dim>
  EvaluationStatus
  InteractionFaceKernel<dim>::evaluate(const StepContext<dim>     &step,
                                       const NodalField           &unknowns,
                                       const InteractionFace<dim> &face,
                                       const bool                  with_matrix,
                                       std::vector<Action>        *actions)
  {
    const auto               of = domain(step, face);
    const NodalUnknowns<dim> nodal(step, unknowns);
    const EvaluationStatus   status = stress.evaluate(
      step.kernel,
      of,
      faces.in_surface(face).normal,
      [&](const unsigned int I) {
        return nodal.increment(of.stencil.vertex[I]);
      },
      [&](const unsigned int I) {
        return nodal.pressure(of.stencil.vertex[I]);
      },
      with_matrix);
    if (status != EvaluationStatus::success)
      return status;

    const auto key = BodySurface<dim>::key(faces.in_surface(face));
    // the work of statics begins with what there was
    const bool is_known =
      !step.has_inertia && step.step_size() == 0 && history.forces.knows(key);
    start_element(step, face, of, with_matrix);
    for (unsigned int g = 0; g < BodySurface<dim>::n_gauss; ++g)
      {
        go_to(step, unknowns, face, of, g);
        find_acting(face);
        for (const ActingPartner &one : acting)
          {
            add_sides(face, of, one.partner);
            if (is_known)
              {
                kernel.add_force(history.forces.get(key, g));
                break;
              }
            add_action(step, face, of, one, actions);
          }
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  void
  InteractionFaceKernel<dim>::add_action(
    const StepContext<dim>                    &step,
    const InteractionFace<dim>                &face,
    const typename SurfaceStress<dim>::Domain &domain,
    const ActingPartner                       &one,
    std::vector<Action>                       *actions)
  {
    const auto &law        = *interactions[face.partners[one.partner]]->law;
    const auto  measure    = measure_of(step, face, one);
    const bool  is_contact = law.is_unilateral();
    kernel.add(law, one.place, measure);
    if (actions == nullptr)
      return;
    const auto flow = flow_at(step, face, domain);
    actions->push_back(
      {one.partner,
       place.g,
       place.start.x + place.at.increment -
         (is_contact ? one.place.normal_gap * one.place.normal : one.place.gap),
       measure.weight *
         (is_contact ? kernel.mean_traction() : kernel.at_end().f),
       kernel.remembered(law, stress.carried(place.at.slip), flow),
       flow.kept,
       kernel.at_end()});
  }



  template class InteractionFaceKernel<2>;
  template class InteractionFaceKernel<3>;
} // namespace isochor
