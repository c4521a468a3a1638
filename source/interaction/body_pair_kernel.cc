/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of BodyPairTerm that evaluate an element.
#include <isochor/interaction/body_pair_term.h>

#include <algorithm>
#include <numeric>

namespace isochor
{
  namespace
  {
    /** What turns at the other side with its unknowns: the derivatives of
     * normal and coordinates of the projection, given to the kernel. */
    template <int dim>
    void
    add_motion_of_face(const FaceCopy<dim>             &other,
                       const std::vector<unsigned int> &nodes,
                       const FaceProjection<dim>       &projection,
                       const Tensor<1, dim>            &slip,
                       const std::vector<double>       &pressures,
                       const unsigned int               n_dofs,
                       const unsigned int               n_components,
                       InteractionKernel<dim>          &kernel)
    {
      constexpr unsigned int n_tangents = dim - 1;
      using Tangents    = std::array<Tensor<1, dim>, n_tangents>;
      using Coordinates = typename InteractionKernel<dim>::FaceCoordinates;
      std::vector<Coordinates> shape_by_xi(other.vertex.size());
      Coordinates              pressure_by_xi;
      for (unsigned int I = 0; I < other.vertex.size(); ++I)
        for (unsigned int a = 0; a < n_tangents; ++a)
          {
            shape_by_xi[I][a] =
              other.gradient[I] * (other.r[a + 1] - other.r[0]);
            if (!pressures.empty())
              pressure_by_xi[a] += shape_by_xi[I][a] * pressures[I];
          }
      std::vector<Coordinates> xi_by(n_dofs);
      for (unsigned int i = 0; i < n_dofs; ++i)
        xi_by[i] = projection.xi_change(kernel.trace_of(i), Tangents());
      const Tensor<1, dim> &n = projection.normal;
      for (unsigned int I = 0; I < other.vertex.size(); ++I)
        for (unsigned int b = 0; b < dim; ++b)
          {
            Tangents of_tangent;
            for (unsigned int a = 0; a < n_tangents; ++a)
              of_tangent[a][b] = shape_by_xi[I][a];
            const unsigned int i = nodes[I] * n_components + b;
            xi_by[i] = projection.xi_change(kernel.trace_of(i), of_tangent);
            const Tensor<1, dim> dn = projection.normal_change(of_tangent);
            // of g = g_n n + s - (s·n) n
            const Tensor<1, dim> dg =
              (projection.distance - slip * n) * dn - (slip * dn) * n;
            kernel.add_partner(nodes[I], b, {Tensor<1, dim>(), dn, dg});
          }
      kernel.add_sliding(xi_by, shape_by_xi, pressure_by_xi);
    }
  } // namespace



  template <int dim>
  EvaluationStatus
  BodyPairTerm<dim>::evaluate_element(const StepContext<dim> &step,
                                      const NodalField       &unknowns,
                                      const PairElement      &element,
                                      const bool              with_matrix,
                                      InteractionKernel<dim> &kernel,
                                      Action                 &action) const
  {
    const NodalUnknowns<dim> nodal(step, unknowns);
    const FaceCopy<dim>     &own = copies[element.own];
    const auto stress_of = [&](const FaceCopy<dim> &copy, auto &stress) {
      return stress.evaluate(
        step.kernel,
        copy.domain(step.kernel),
        copy.normal,
        [&](const unsigned int I) { return nodal.increment(copy.vertex[I]); },
        [&](const unsigned int I) { return nodal.pressure(copy.vertex[I]); },
        with_matrix);
    };
    /** N_I at r from the point of a subdomain, and p there. */
    const auto values_at = [&](const FaceCopy<dim>  &copy,
                               const Tensor<1, dim> &r,
                               std::vector<double>  &N) {
      double p = 0;
      N.resize(copy.vertex.size());
      for (unsigned int I = 0; I < N.size(); ++I)
        {
          N[I] = copy.shape_at(I, r);
          if (step.mixed())
            p += N[I] * nodal.pressure(copy.vertex[I]);
        }
      return p;
    };

    action                        = Action();
    const EvaluationStatus status = stress_of(own, own_stress);
    if (status != EvaluationStatus::success)
      return status;
    kernel.start_element(element.vertices.size(),
                         step.n_components,
                         with_matrix);
    const auto     weights = BodySurface<dim>::coordinates(element.gauss_point);
    Tensor<1, dim> r, x_start;
    Point<dim>     X;
    for (unsigned int i = 0; i < dim; ++i)
      {
        r += weights[i] * own.r[i];
        x_start += weights[i] * own.x[i];
        X += weights[i] * Tensor<1, dim>(own.X[i]);
      }
    std::vector<double>  N, N_other;
    const double         p  = values_at(own, r, N);
    const Tensor<1, dim> du = increment_at(step, unknowns, own, r);
    const Point<dim>     x  = Point<dim>(x_start + du);

    const Meeting meeting = find_meeting(step, unknowns, element, x);
    if (!meeting.projection)
      return EvaluationStatus::success;
    action.other               = element.others[meeting.place];
    const FaceCopy<dim> &other = copies[action.other];
    const auto          &nodes = element.of_other[meeting.place];
    FaceProjection<dim>  at    = *meeting.projection;
    if (element.is_tied)
      at.xi = element.tied_at;
    const EvaluationStatus status_of_other = stress_of(other, other_stress);
    if (status_of_other != EvaluationStatus::success)
      return status_of_other;

    const auto     on_other = at.corner_weights();
    Tensor<1, dim> r_other, y, y_start, Y;
    for (unsigned int i = 0; i < dim; ++i)
      {
        r_other += on_other[i] * other.r[i];
        y += on_other[i] * Tensor<1, dim>(meeting.corners[i]);
        y_start += on_other[i] * Tensor<1, dim>(other.x[i]);
        Y += on_other[i] * Tensor<1, dim>(other.X[i]);
      }
    const double p_other = values_at(other, r_other, N_other);
    const double share   = other.gamma / (own.gamma + other.gamma);

    std::vector<unsigned int> own_nodes(N.size());
    std::iota(own_nodes.begin(), own_nodes.end(), 0);
    const auto adjoint = [](const FaceCopy<dim> &copy) {
      return copy.adjoint.empty() ? nullptr : copy.adjoint.data();
    };
    kernel.start_place();
    kernel.add_side({&own_stress,
                     static_cast<unsigned int>(N.size()),
                     own_nodes.data(),
                     N.data(),
                     own.shape.data(),
                     p,
                     share,
                     1.,
                     adjoint(own)});
    kernel.add_side({&other_stress,
                     static_cast<unsigned int>(N_other.size()),
                     nodes.data(),
                     N_other.data(),
                     other.shape.data(),
                     p_other,
                     share - 1,
                     -1.,
                     adjoint(other)});

    const InteractionLaw<dim> &law =
      element.is_tied ? *default_tie : laws.of(own, other);
    PartnerPlace<dim> place;
    if (element.is_tied)
      {
        // u - u' at places that were together at t = 0
        place.gap      = (Tensor<1, dim>(x) - y) - (Tensor<1, dim>(X) - Y);
        place.gap_by_x = unit_symmetric_tensor<dim>();
      }
    else
      {
        const Tensor<1, dim> slip =
          (law.constrains_tangent() ? slips.get(own.key, element.gauss_point) :
                                      Tensor<1, dim>()) +
          du - (y - y_start);
        place = nearest_place<dim>(at.distance,
                                   at.normal,
                                   SymmetricTensor<2, dim>(),
                                   slip,
                                   unit_symmetric_tensor<dim>());
        if (with_matrix)
          {
            std::vector<double> pressures;
            if (step.mixed())
              for (const unsigned int vertex : other.vertex)
                pressures.push_back(nodal.pressure(vertex));
            add_motion_of_face<dim>(other,
                                    nodes,
                                    at,
                                    slip,
                                    pressures,
                                    element.vertices.size() * step.n_components,
                                    step.n_components,
                                    kernel);
          }
      }
    double A = own.area * thickness(step.kernel.axisymmetric, X[0]);
    if (!element.is_tied)
      A *= facing(own.normal_now, other.normal_now);
    const typename InteractionKernel<dim>::Measure measure{
      share * A / BodySurface<dim>::n_gauss,
      2 * own.gamma * share,
      step.has_inertia ? 1. : 0.,
      own.area_ratio,
      rounding_of_contact(2 * own.gamma * share, own.area_per_volume),
      step.step_size() > 0 && element.has_start ? &element.start : nullptr};
    kernel.add(law, place, measure);
    action.meets = true;
    action.force = measure.weight * kernel.mean_traction();
    action.end   = kernel.at_end();
    action.slip  = kernel.slip();
    return EvaluationStatus::success;
  }



  template <int dim>
  EvaluationStatus
  BodyPairTerm<dim>::assemble(const StepContext<dim> &step,
                              const NodalField       &unknowns,
                              const NodalField       &pending,
                              const unsigned int      first_element,
                              const bool              with_matrix,
                              MixedSystem<dim>       &system)
  {
    InteractionKernel<dim> kernel;
    Action                 action;
    for (unsigned int e = 0; e < elements.size(); ++e)
      {
        const EvaluationStatus status = evaluate_element(
          step, unknowns, elements[e], with_matrix, kernel, action);
        if (status != EvaluationStatus::success)
          return status;
        system.add_element(first_element + e,
                           kernel.residual.data(),
                           with_matrix ? kernel.matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template EvaluationStatus
  BodyPairTerm<2>::assemble(const StepContext<2> &,
                            const NodalField &,
                            const NodalField &,
                            const unsigned int,
                            const bool,
                            MixedSystem<2> &);
  template EvaluationStatus
  BodyPairTerm<3>::assemble(const StepContext<3> &,
                            const NodalField &,
                            const NodalField &,
                            const unsigned int,
                            const bool,
                            MixedSystem<3> &);
  template EvaluationStatus
  BodyPairTerm<2>::evaluate_element(const StepContext<2> &,
                                    const NodalField &,
                                    const PairElement &,
                                    const bool,
                                    InteractionKernel<2> &,
                                    Action &) const;
  template EvaluationStatus
  BodyPairTerm<3>::evaluate_element(const StepContext<3> &,
                                    const NodalField &,
                                    const PairElement &,
                                    const bool,
                                    InteractionKernel<3> &,
                                    Action &) const;
} // namespace isochor
