/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/rounding.h>
#include <isochor/interaction/body_pair_kernel.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace isochor
{
  template <int dim>
  void
  PairElement<dim>::number_vertices(const std::vector<FaceCopy<dim>> &copies)
  {
    of_other.clear();
    vertices = copies[own].vertex;
    for (const unsigned int i : others)
      {
        std::vector<unsigned int> places;
        for (const unsigned int vertex : copies[i].vertex)
          {
            const auto found =
              std::find(vertices.begin(), vertices.end(), vertex);
            places.push_back(found - vertices.begin());
            if (found == vertices.end())
              vertices.push_back(vertex);
          }
        of_other.push_back(places);
      }
  }



  template <int dim>
  Tensor<1, dim>
  increment_at(const NodalUnknowns<dim> &nodal,
               const FaceCopy<dim>      &face,
               const Tensor<1, dim>     &r)
  {
    Tensor<1, dim> increment;
    for (unsigned int I = 0; I < face.vertex.size(); ++I)
      increment += face.shape_at(I, r) * nodal.increment(face.vertex[I]);
    return increment;
  }



  template <int dim>
  BodyPairKernel<dim>::BodyPairKernel(const StepContext<dim> &step,
                                      const NodalField       &unknowns,
                                      const std::vector<FaceCopy<dim>> &copies,
                                      const PairLaws<dim>              &laws,
                                      const InteractionLaw<dim>        &tie,
                                      const SurfaceMemory<dim>         &memory,
                                      const FaceLoads<dim>             *loads,
                                      const double                      reach)
    : step(step)
    , nodal(step, unknowns)
    , copies(copies)
    , laws(laws)
    , tie(tie)
    , memory(memory)
    , loads(loads)
    , reach(reach)
  {}



  template <int dim>
  EvaluationStatus
  BodyPairKernel<dim>::set_face(const FaceCopy<dim> &face,
                                const bool           with_matrix,
                                Side                &side)
  {
    side.face = &face;
    return side.stress.evaluate(
      step.kernel,
      face.domain(step.kernel),
      face.normal,
      [&](const unsigned int I) { return nodal.increment(face.vertex[I]); },
      [&](const unsigned int I) { return nodal.pressure(face.vertex[I]); },
      with_matrix);
  }



  template <int dim>
  void
  BodyPairKernel<dim>::set_place(const std::array<double, dim> &weights,
                                 const Tensor<1, dim>          &shift,
                                 Side                          &side) const
  {
    const FaceCopy<dim> &face = *side.face;
    side.r = side.start = shift;
    side.X              = Tensor<1, dim>();
    for (unsigned int i = 0; i < dim; ++i)
      {
        side.r += weights[i] * face.r[i];
        side.start += weights[i] * Tensor<1, dim>(face.x[i]);
        side.X += weights[i] * Tensor<1, dim>(face.X[i]);
      }
    side.p = 0;
    side.N.resize(face.vertex.size());
    for (unsigned int I = 0; I < side.N.size(); ++I)
      {
        side.N[I] = face.shape_at(I, side.r);
        if (step.mixed())
          side.p += side.N[I] * nodal.pressure(face.vertex[I]);
      }
  }



  template <int dim>
  typename BodyPairKernel<dim>::Meeting
  BodyPairKernel<dim>::find_meeting(const PairElement<dim> &element,
                                    const Point<dim>       &x) const
  {
    const auto on = [&](const unsigned int i) {
      const FaceCopy<dim> &other = copies[element.others[i]];
      Meeting              meeting;
      meeting.place = i;
      for (unsigned int c = 0; c < dim; ++c)
        meeting.corners[c] =
          other.x[c] + increment_at(nodal, other, other.r[c]);
      meeting.projection =
        std::make_unique<FaceProjection<dim>>(x, meeting.corners);
      return meeting;
    };
    Meeting nearest;
    if (element.touches >= 0)
      nearest = on(element.touches);
    if (!nearest.projection || nearest.projection->distance_beyond() > reach)
      for (unsigned int i = 0; i < element.others.size(); ++i)
        {
          Meeting meeting = on(i);
          if (nearest.projection)
            {
              // of faces that meet at the nearest place the one is the surface
              // there that x is farther out of
              const double d     = meeting.projection->distance_square,
                           least = nearest.projection->distance_square;
              const bool is_same =
                std::abs(d - least) <= rounding::accumulated * least;
              if (is_same ? meeting.projection->distance <=
                              nearest.projection->distance :
                            d > least)
                continue;
            }
          nearest = std::move(meeting);
        }
    if (!nearest.projection || element.is_tied)
      return nearest;
    const FaceCopy<dim> &own   = copies[element.own],
                        &other = copies[element.others[nearest.place]];
    // what slides in the step leaves the faces that the element has, not the
    // body
    const auto slid = [&]() {
      const Tensor<1, dim> none;
      return (increment_at(nodal, own, none) - increment_at(nodal, other, none))
        .norm();
    };
    const double beyond = nearest.projection->distance_beyond();
    if (facing(own.normal_now, other.normal_now) == 0 ||
        (beyond > reach && beyond > reach + slid()))
      nearest.projection.reset();
    return nearest;
  }



  template <int dim>
  int
  BodyPairKernel<dim>::touched(const PairElement<dim> &element)
  {
    return evaluate(element, false) == EvaluationStatus::success &&
               result.is_closed ?
             std::find(element.others.begin(),
                       element.others.end(),
                       result.other) -
               element.others.begin() :
             -1;
  }



  template <int dim>
  double
  BodyPairKernel<dim>::gap(const PairElement<dim> &element)
  {
    own.face = &copies[element.own];
    set_place(BodySurface<dim>::coordinates(element.gauss_point),
              Tensor<1, dim>(),
              own);
    const Tensor<1, dim> du = increment_at(nodal, *own.face, own.r);
    const Meeting meeting   = find_meeting(element, Point<dim>(own.start + du));
    if (!meeting.projection)
      return std::numeric_limits<double>::max();
    // beside the face it is no deeper in the body than it is apart
    return meeting.projection->distance_beyond() > 0 ?
             std::sqrt(meeting.projection->distance_square) :
             meeting.projection->distance;
  }



  template <int dim>
  void
  BodyPairKernel<dim>::add_sides(const double share)
  {
    const auto add =
      [&](const Side &side, const double part, const double sign) {
        const FaceCopy<dim> &face = *side.face;
        kernel.add_side({&side.stress,
                         static_cast<unsigned int>(side.N.size()),
                         side.nodes.data(),
                         side.N.data(),
                         face.shape.data(),
                         side.p,
                         part,
                         sign,
                         face.adjoint.empty() ? nullptr : face.adjoint.data(),
                         loads == nullptr ? GivenTraction<dim>() :
                                            loads->traction(face.loads,
                                                            Point<dim>(side.X),
                                                            face.stretch,
                                                            step.time)});
      };
    kernel.start_place();
    add(own, share, 1.);
    add(other, share - 1, -1.);
  }



  template <int dim>
  void
  BodyPairKernel<dim>::add_motion_of_face(const FaceProjection<dim> &projection,
                                          const Tensor<1, dim>      &slip,
                                          const unsigned int         n_dofs)
  {
    constexpr unsigned int n_tangents = dim - 1;
    using Tangents                    = std::array<Tensor<1, dim>, n_tangents>;
    using Coordinates = typename InteractionKernel<dim>::FaceCoordinates;
    const FaceCopy<dim>     &face = *other.face;
    std::vector<Coordinates> shape_by_xi(face.vertex.size());
    Coordinates              pressure_by_xi;
    for (unsigned int I = 0; I < face.vertex.size(); ++I)
      for (unsigned int a = 0; a < n_tangents; ++a)
        {
          shape_by_xi[I][a] = face.gradient[I] * (face.r[a + 1] - face.r[0]);
          if (step.mixed())
            pressure_by_xi[a] +=
              shape_by_xi[I][a] * nodal.pressure(face.vertex[I]);
        }
    std::vector<Coordinates> xi_by(n_dofs);
    for (unsigned int i = 0; i < n_dofs; ++i)
      xi_by[i] = projection.xi_change(kernel.trace_of(i), Tangents());
    const Tensor<1, dim> &n = projection.normal;
    for (unsigned int I = 0; I < face.vertex.size(); ++I)
      for (unsigned int b = 0; b < dim; ++b)
        {
          Tangents of_tangent;
          for (unsigned int a = 0; a < n_tangents; ++a)
            of_tangent[a][b] = shape_by_xi[I][a];
          const unsigned int i = other.nodes[I] * step.n_components + b;
          xi_by[i] = projection.xi_change(kernel.trace_of(i), of_tangent);
          const Tensor<1, dim> dn = projection.normal_change(of_tangent);
          // of g = g_n n + s - (s·n) n
          const Tensor<1, dim> dg =
            (projection.distance - slip * n) * dn - (slip * dn) * n;
          kernel.add_partner(other.nodes[I], b, {Tensor<1, dim>(), dn, dg});
        }
    kernel.add_sliding(xi_by, shape_by_xi, pressure_by_xi);
  }



  template <int dim>
  PartnerPlace<dim>
  BodyPairKernel<dim>::place_of_law(const PairElement<dim>    &element,
                                    const InteractionLaw<dim> &law,
                                    const FaceProjection<dim> &at,
                                    const Tensor<1, dim>      &du,
                                    const Tensor<1, dim>      &x,
                                    const Tensor<1, dim>      &y,
                                    const bool                 with_matrix)
  {
    if (element.is_tied)
      {
        PartnerPlace<dim> place;
        // u - u' at places that were together at t = 0
        place.gap      = (x - y) - (own.X - other.X);
        place.gap_by_x = unit_symmetric_tensor<dim>();
        return place;
      }
    const Tensor<1, dim> slip =
      (law.constrains_tangent() ?
         memory.get(own.face->key, element.gauss_point) :
         Tensor<1, dim>()) +
      du - (y - other.start);
    if (with_matrix)
      add_motion_of_face(at, slip, element.vertices.size() * step.n_components);
    return nearest_place<dim>(at.distance,
                              at.normal,
                              SymmetricTensor<2, dim>(),
                              slip,
                              unit_symmetric_tensor<dim>());
  }



  template <int dim>
  typename InteractionKernel<dim>::Measure
  BodyPairKernel<dim>::measure_of(const PairElement<dim> &element,
                                  const FaceCopy<dim>    &face_met,
                                  const double            share) const
  {
    const FaceCopy<dim> &face = *own.face;
    // R = r / F_θθ, as in InteractionTerm
    double A =
      face.area *
      thickness(step.kernel.axisymmetric,
                own.start[0] / step.kernel.hoop_stretch(face.history.data()));
    if (!element.is_tied)
      A *= facing(face.normal_now, face_met.normal_now);
    return {share * A / BodySurface<dim>::n_gauss,
            2 * face.gamma * share,
            step.has_inertia ? 1. : 0.,
            face.area_ratio,
            rounding_of_contact(2 * face.gamma * share, face.area_per_volume),
            step.unknowns_at_start != nullptr && step.step_size() > 0 &&
                element.has_start ?
              &element.start :
              nullptr,
            step.end_weight,
            element.is_farther};
  }



  template <int dim>
  EvaluationStatus
  BodyPairKernel<dim>::evaluate(const PairElement<dim> &element,
                                const bool              with_matrix)
  {
    result                        = Action();
    const FaceCopy<dim>   &face   = copies[element.own];
    const EvaluationStatus status = set_face(face, with_matrix, own);
    if (status != EvaluationStatus::success)
      return status;
    kernel.start_element(element.vertices.size(),
                         step.n_components,
                         with_matrix);
    const Tensor<1, dim> shift = element.is_tied ?
                                   memory.get(face.key, element.gauss_point) :
                                   Tensor<1, dim>();
    set_place(BodySurface<dim>::coordinates(element.gauss_point), shift, own);
    own.nodes.resize(own.N.size());
    std::iota(own.nodes.begin(), own.nodes.end(), 0);
    const Tensor<1, dim> du = increment_at(nodal, face, own.r);
    const Point<dim>     x  = Point<dim>(own.start + du);

    const Meeting meeting = find_meeting(element, x);
    if (!meeting.projection)
      return EvaluationStatus::success;
    result.other                  = element.others[meeting.place];
    const FaceCopy<dim> &face_met = copies[result.other];
    FaceProjection<dim>  at       = *meeting.projection;
    if (element.is_tied)
      at.xi = element.tied_at;
    const EvaluationStatus status_of_other =
      set_face(face_met, with_matrix, other);
    if (status_of_other != EvaluationStatus::success)
      return status_of_other;
    const auto on_other = at.corner_weights();
    set_place(on_other, Tensor<1, dim>(), other);
    other.nodes = element.of_other[meeting.place];
    Tensor<1, dim> y;
    for (unsigned int i = 0; i < dim; ++i)
      y += on_other[i] * Tensor<1, dim>(meeting.corners[i]);

    const double share = face_met.gamma / (face.gamma + face_met.gamma);
    add_sides(share);
    const InteractionLaw<dim> &law =
      element.is_tied ? tie : laws.of(face, face_met);
    const PartnerPlace<dim> place =
      place_of_law(element, law, at, du, x, y, with_matrix);
    const auto measure = measure_of(element, face_met, share);
    result.is_closed =
      kernel.add(law, place, measure).state != SurfaceState::open;
    result.meets = true;
    result.force = measure.weight * kernel.mean_traction();
    result.end   = kernel.at_end();
    // each side has its part of the gap
    const auto of_own = flow(element, own), of_other = flow(element, other);
    const auto mean = [&](const double a, const double b) {
      return share * a + (1 - share) * b;
    };
    result.kept       = of_own.kept;
    result.remembered = kernel.remembered(law,
                                          own.stress.carried(shift),
                                          {mean(of_own.strain, of_other.strain),
                                           mean(of_own.kept, of_other.kept)});
    return EvaluationStatus::success;
  }



  template struct PairElement<2>;
  template struct PairElement<3>;
  template class BodyPairKernel<2>;
  template class BodyPairKernel<3>;
  template Tensor<1, 2>
  increment_at(const NodalUnknowns<2> &,
               const FaceCopy<2> &,
               const Tensor<1, 2> &);
  template Tensor<1, 3>
  increment_at(const NodalUnknowns<3> &,
               const FaceCopy<3> &,
               const Tensor<1, 3> &);
} // namespace isochor
