/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_kernel.h>

#include <cmath>

namespace isochor
{
  template <int dim>
  void
  InteractionKernel<dim>::start_element(const unsigned int n_nodes,
                                        const unsigned int components,
                                        const bool         matrix_too)
  {
    n_components = components;
    n_dofs       = n_nodes * n_components;
    with_matrix  = matrix_too;
    residual.assign(n_dofs, 0.);
    if (with_matrix)
      matrix.assign(n_dofs * n_dofs, 0.);
  }



  template <int dim>
  void
  InteractionKernel<dim>::start_place()
  {
    for (auto *field : {&trace, &t_by, &turn_of_normal, &turn_of_gap, &adjoint})
      field->assign(n_dofs, Tensor<1, dim>());
    t = Tensor<1, dim>();
    sides.clear();
    turns.clear();
    xi_by.clear();
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_side(const Side &side)
  {
    sides.push_back(side);
    const SurfaceStress<dim> &stress = *side.stress;
    t += side.weight * stress.traction(side.pressure);
    for (unsigned int J = 0; J < side.n_nodes; ++J)
      {
        const unsigned int first = side.node[J] * n_components;
        for (unsigned int b = 0; b < dim; ++b)
          {
            trace[first + b][b] += side.sign * side.shape[J];
            if (with_matrix)
              t_by[first + b] +=
                side.weight *
                stress.traction_by_displacement(J, b, side.pressure);
            if (side.adjoint != nullptr)
              adjoint[first + b] += side.weight * side.adjoint[J * dim + b];
          }
        if (with_matrix && stress.mixed)
          t_by[first + dim] +=
            side.weight * (side.shape[J] * stress.volume +
                           side.point_shape[J] * stress.deviatoric_by_p);
      }
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_sliding(
    const std::vector<FaceCoordinates> &by_unknown,
    const std::vector<FaceCoordinates> &by_xi,
    const FaceCoordinates              &pressure_by_xi)
  {
    xi_by            = by_unknown;
    shape_by_xi      = by_xi;
    const Side &side = sides.back();
    if (side.stress->mixed)
      for (unsigned int j = 0; j < n_dofs; ++j)
        t_by[j] +=
          side.weight * (pressure_by_xi * xi_by[j]) * side.stress->volume;
  }



  template <int dim>
  typename InteractionKernel<dim>::Projection
  InteractionKernel<dim>::in_step(const Projection       &at_end,
                                  const StartOfStep<dim> &start,
                                  const Tensor<1, dim>   &w_vector,
                                  const Tensor<1, dim>   &n)
  {
    const double w = w_vector * n, w_0 = start.w;
    if (!(w * w_0 < 0))
      return at_end;
    // f times a factor or f_0 times one, and its derivative
    const bool   begins = w > 0;
    const double change = std::abs(w - w_0), factor = w / change,
                 by_w            = std::abs(w_0) / (change * change);
    const Tensor<1, dim> &f      = begins ? at_end.f : start.f;
    Projection            result = at_end;
    result.f                     = factor * f;
    result.f_by_w *= begins ? factor : 0.;
    result.f_by_n *= begins ? factor : 0.;
    result.f_by_w += by_w * outer_product(f, n);
    result.f_by_n += by_w * outer_product(f, w_vector);
    return result;
  }



  template <int dim>
  typename InteractionKernel<dim>::Projection
  InteractionKernel<dim>::add(const InteractionLaw<dim> &law,
                              const PartnerPlace<dim>   &place,
                              const Measure             &measure)
  {
    const Tensor<1, dim> w    = t - measure.gamma * place.gap;
    const double         pull = law.is_unilateral() ? -(w * place.normal) : 0.;
    const bool           touches = pull > 0 && pull < measure.rounding;
    Projection at_end = law.project(touches ? w + pull * place.normal : w,
                                    place.normal,
                                    measure.area_ratio);
    if (touches)
      at_end.f -= pull * place.normal;
    at_end.f      = place.mask * at_end.f;
    at_end.f_by_w = place.mask * at_end.f_by_w;
    at_end.f_by_n = place.mask * at_end.f_by_n;
    const Projection acting =
      measure.start != nullptr && law.is_unilateral() ?
        in_step(at_end, *measure.start, w, place.normal) :
        at_end;
    end = {w * place.normal, at_end.f};
    mean =
      measure.start != nullptr ? (measure.start->f + acting.f) / 2 : at_end.f;
    to_remember = Tensor<1, dim>();
    if (law.is_unilateral() && law.constrains_tangent() &&
        at_end.state != SurfaceState::open)
      to_remember = (t - at_end.f) / measure.gamma;
    to_remember -= (to_remember * place.normal) * place.normal;
    // (f - M t) / γ
    const Tensor<1, dim> constrained = law.constrains_tangent() ?
                                         place.mask * t :
                                         (t * place.normal) * place.normal;
    const Tensor<1, dim> mismatch    = (acting.f - constrained) / measure.gamma,
                         mismatch_at_end =
                           (at_end.f - constrained) / measure.gamma;
    add_to_residual(acting, measure, mismatch, mismatch_at_end);
    if (with_matrix)
      {
        add_to_matrix(law, place, acting, at_end, measure, mismatch_at_end);
        add_turns_to_matrix(law, place, acting, measure);
        if (!xi_by.empty())
          add_sliding_to_matrix(acting, measure, mismatch_at_end);
      }
    return at_end;
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_to_residual(const Projection     &projection,
                                          const Measure        &measure,
                                          const Tensor<1, dim> &mismatch,
                                          const Tensor<1, dim> &at_end)
  {
    const double W = measure.weight;
    for (unsigned int i = 0; i < n_dofs; ++i)
      residual[i] +=
        W * (measure.theta * (mismatch * adjoint[i]) - projection.f * trace[i]);
    for (const Side &side : sides)
      for (unsigned int I = 0; I < side.n_nodes && side.stress->mixed; ++I)
        residual[side.node[I] * n_components + dim] +=
          W * side.weight * side.shape[I] * (at_end * side.stress->volume);
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_to_matrix(const InteractionLaw<dim> &law,
                                        const PartnerPlace<dim>   &place,
                                        const Projection          &projection,
                                        const Projection          &at_end,
                                        const Measure             &measure,
                                        const Tensor<1, dim> &mismatch_at_end)
  {
    const double          W = measure.weight;
    const Tensor<1, dim> &n = place.normal;
    for (unsigned int j = 0; j < n_dofs; ++j)
      {
        const Tensor<1, dim> dn =
          place.normal_by_x * trace[j] + turn_of_normal[j];
        const Tensor<1, dim> dg = place.gap_by_x * trace[j] + turn_of_gap[j],
                             dw = t_by[j] - measure.gamma * dg;
        const Tensor<1, dim> df =
          projection.f_by_w * dw + projection.f_by_n * dn;
        const Tensor<1, dim> constrained =
          law.constrains_tangent() ? place.mask * t_by[j] :
                                     (t_by[j] * n + t * dn) * n + (t * n) * dn;
        const Tensor<1, dim> d_mismatch = (df - constrained) / measure.gamma,
                             d_at_end   = (at_end.f_by_w * dw +
                                         at_end.f_by_n * dn - constrained) /
                                        measure.gamma;
        for (unsigned int i = 0; i < n_dofs; ++i)
          matrix[i * n_dofs + j] +=
            W * (measure.theta * (d_mismatch * adjoint[i]) - df * trace[i]);
        for (const Side &side : sides)
          {
            if (!side.stress->mixed)
              continue;
            const double change = d_at_end * side.stress->volume;
            for (unsigned int I = 0; I < side.n_nodes; ++I)
              matrix[(side.node[I] * n_components + dim) * n_dofs + j] +=
                W * side.weight * side.shape[I] * change;
          }
      }
    for (const Side &side : sides)
      for (unsigned int J = 0; J < side.n_nodes && side.stress->mixed; ++J)
        for (unsigned int b = 0; b < dim; ++b)
          {
            const double change =
              W * side.weight *
              (mismatch_at_end * side.stress->volume_by_u[J * dim + b]);
            for (unsigned int I = 0; I < side.n_nodes; ++I)
              matrix[(side.node[I] * n_components + dim) * n_dofs +
                     side.node[J] * n_components + b] += side.shape[I] * change;
          }
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_turns_to_matrix(const InteractionLaw<dim> &law,
                                              const PartnerPlace<dim>   &place,
                                              const Projection &projection,
                                              const Measure    &measure)
  {
    const Tensor<1, dim>  f = measure.weight * projection.f;
    const Tensor<1, dim> &n = place.normal;
    for (const Turn &turn : turns)
      {
        double *const row = matrix.data() + turn.unknown * n_dofs;
        for (unsigned int a = 0; a < dim; ++a)
          row[turn.first + a] += f * turn.motion.place_by_component[a];
        if (!law.is_unilateral()) // its place is always the same
          continue;
        const Tensor<1, dim> by_y = f * turn.motion.place_by_y;
        for (unsigned int j = 0; j < n_dofs; ++j)
          row[j] += by_y * (trace[j] - (n * trace[j]) * n -
                            place.normal_gap * (place.normal_by_x * trace[j] +
                                                turn_of_normal[j]));
      }
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_sliding_to_matrix(const Projection &projection,
                                                const Measure    &measure,
                                                const Tensor<1, dim> &mismatch)
  {
    const Side &side = sides.back();
    for (unsigned int I = 0; I < side.n_nodes; ++I)
      for (unsigned int j = 0; j < n_dofs; ++j)
        {
          const double       dN  = measure.weight * (shape_by_xi[I] * xi_by[j]);
          const unsigned int row = side.node[I] * n_components;
          for (unsigned int b = 0; b < dim; ++b)
            matrix[(row + b) * n_dofs + j] -= side.sign * dN * projection.f[b];
          if (side.stress->mixed)
            matrix[(row + dim) * n_dofs + j] +=
              side.weight * dN * (mismatch * side.stress->volume);
        }
  }



  template <int dim>
  void
  add_rounding_of_gap(const StepContext<dim>   &step,
                      const unsigned int        n_nodes,
                      const unsigned int *const vertices,
                      const double *const       shape,
                      const double              area,
                      const double              gamma,
                      const double              r,
                      NodalField               &scale)
  {
    constexpr double tenth = 0.1; // of the unit, 1e-14
    for (unsigned int I = 0; I < n_nodes; ++I)
      {
        const unsigned int entry =
          step.nodes.node(vertices[I]) * step.n_components;
        const double volume = tenth * area * r * std::abs(shape[I]);
        for (unsigned int a = 0; a < dim; ++a)
          scale.local_element(entry + a) += gamma * volume;
        if (step.mixed())
          scale.local_element(entry + dim) += volume;
      }
  }



  template void
  add_rounding_of_gap(const StepContext<2> &,
                      const unsigned int,
                      const unsigned int *const,
                      const double *const,
                      const double,
                      const double,
                      const double,
                      NodalField &);
  template void
  add_rounding_of_gap(const StepContext<3> &,
                      const unsigned int,
                      const unsigned int *const,
                      const double *const,
                      const double,
                      const double,
                      const double,
                      NodalField &);
  template class InteractionKernel<2>;
  template class InteractionKernel<3>;
} // namespace isochor
