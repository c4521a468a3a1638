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
    for (auto &field : pressure_by)
      field.assign(n_dofs, 0.);
    t = Tensor<1, dim>();
    sides.clear();
    turns.clear();
    xi_by.clear();
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_side(const Side &side)
  {
    AssertIndexRange(sides.size(), pressure_by.size());
    std::vector<double> &p_by = pressure_by[sides.size()];
    sides.push_back(side);
    const SurfaceStress<dim> &stress = *side.stress;
    t += side.weight * (stress.traction(side.pressure) - side.given.dead +
                        side.given.pressure * stress.area);
    for (unsigned int J = 0; J < side.n_nodes; ++J)
      {
        const unsigned int first = side.node[J] * n_components;
        for (unsigned int b = 0; b < dim; ++b)
          {
            trace[first + b][b] += side.sign * side.shape[J];
            if (with_matrix)
              t_by[first + b] +=
                side.weight *
                (stress.traction_by_displacement(J, b, side.pressure) +
                 side.given.pressure * stress.area_by_u[J * dim + b]);
            if (side.adjoint != nullptr)
              adjoint[first + b] += side.weight * side.adjoint[J * dim + b];
          }
        if (with_matrix && stress.mixed)
          {
            p_by[first + dim] = side.shape[J];
            t_by[first + dim] +=
              side.weight * (side.shape[J] * stress.volume +
                             side.point_shape[J] * stress.deviatoric_by_p);
          }
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
        {
          const double dp = pressure_by_xi * xi_by[j];
          pressure_by[sides.size() - 1][j] += dp;
          t_by[j] += side.weight * dp * side.stress->volume;
        }
  }



  template <int dim>
  typename InteractionKernel<dim>::Projection
  InteractionKernel<dim>::project(const InteractionLaw<dim> &law,
                                  const Tensor<1, dim>      &w,
                                  const Tensor<1, dim>      &n,
                                  const PartnerPlace<dim>   &place,
                                  const Measure             &measure)
  {
    const double pull    = law.is_unilateral() ? -(w * n) : 0.;
    const bool   touches = pull > 0 && pull < measure.rounding;
    Projection   result =
      law.project(touches ? w + pull * n : w, n, measure.area_ratio);
    if (touches)
      result.f -= pull * n;
    result.f      = place.mask * result.f;
    result.f_by_w = place.mask * result.f_by_w;
    result.f_by_n = place.mask * result.f_by_n;
    return result;
  }



  template <int dim>
  void
  InteractionKernel<dim>::set_mean_pressures(const Measure &measure)
  {
    const StartOfStep<dim> &start = *measure.start;
    const double            m     = measure.end_weight;
    w_0                           = start.w;
    if (with_matrix)
      w_0_by.assign(n_dofs, Tensor<1, dim>());
    for (unsigned int s = 0; s < sides.size(); ++s)
      {
        const Side &side = sides[s];
        if (!side.stress->mixed)
          continue;
        const double         change = side.pressure - start.pressure[s];
        const Tensor<1, dim> t_by_p = side.weight * side.stress->volume;
        t_end -= (1 - m) * change * t_by_p;
        w_0 += m * change * start.t_by_pressure[s];
        if (!with_matrix)
          continue;
        for (unsigned int j = 0; j < n_dofs; ++j)
          {
            t_end_by[j] -= (1 - m) * pressure_by[s][j] * t_by_p;
            w_0_by[j] += m * pressure_by[s][j] * start.t_by_pressure[s];
          }
        for (unsigned int J = 0; J < side.n_nodes; ++J)
          for (unsigned int b = 0; b < dim; ++b)
            t_end_by[side.node[J] * n_components + b] -=
              (1 - m) * change * side.weight *
              side.stress->volume_by_u[J * dim + b];
      }
  }



  template <int dim>
  typename InteractionKernel<dim>::Acting
  InteractionKernel<dim>::in_step(const Projection     &f_1,
                                  const Tensor<1, dim> &w_1,
                                  const Tensor<1, dim> &n_1,
                                  const Projection     &f_0,
                                  const Tensor<1, dim> &w_0,
                                  const Measure        &measure,
                                  const bool            is_unilateral)
  {
    const Tensor<1, dim> &n_0   = measure.start->normal;
    const double          start = 1 / measure.end_weight - 1; // (1 - m)/m
    const Tensor<1, dim>  sum   = start * f_0.f + f_1.f;
    const double          a = w_0 * n_0, b = w_1 * n_1, change = b - a;
    Acting                acting{sum - start * measure.start->f,
                  f_1.f_by_w,
                  f_1.f_by_n,
                  start * f_0.f_by_w};
    if (!is_unilateral || !(a * b < 0))
      return acting;
    // contact begins or ends: ρ, and its derivatives with respect to a and b
    const double sign = b > 0 ? 1 : -1, rho = (b > 0 ? b : -a) / change,
                 by_a = sign * b / (change * change),
                 by_b = -sign * a / (change * change);
    acting.f          = rho * sum - start * measure.start->f;
    acting.by_w       = rho * acting.by_w + by_b * outer_product(sum, n_1);
    acting.by_n       = rho * acting.by_n + by_b * outer_product(sum, w_1);
    acting.by_start   = rho * acting.by_start + by_a * outer_product(sum, n_0);
    return acting;
  }



  template <int dim>
  typename InteractionKernel<dim>::Projection
  InteractionKernel<dim>::add(const InteractionLaw<dim> &law,
                              const PartnerPlace<dim>   &place,
                              const Measure             &measure)
  {
    const Tensor<1, dim> &n     = place.normal;
    const auto           *start = measure.start;
    t_end                       = t;
    if (with_matrix)
      t_end_by = t_by;
    if (start != nullptr)
      set_mean_pressures(measure);
    const Tensor<1, dim> w   = t_end - measure.gamma * place.gap;
    const Projection     f_1 = project(law, w, n, place, measure);
    Acting               acting{f_1.f, f_1.f_by_w, f_1.f_by_n, {}};
    bool                 is_open = f_1.state == SurfaceState::open;
    if (start != nullptr)
      {
        const Projection f_0 = project(law, w_0, start->normal, place, measure);
        is_open              = is_open && f_0.state == SurfaceState::open;
        acting = in_step(f_1, w, n, f_0, w_0, measure, law.is_unilateral());
      }
    mean = f_1.f;
    if (start != nullptr)
      mean =
        (1 - measure.end_weight) * start->f + measure.end_weight * acting.f;

    // of a tie acting.f is f_1 with the pressure at the end
    end        = StartOfStep<dim>();
    end.w      = t - measure.gamma * place.gap;
    end.f      = acting.f;
    end.normal = n;
    for (unsigned int s = 0; s < sides.size(); ++s)
      if (sides[s].stress->mixed)
        {
          end.pressure[s]      = sides[s].pressure;
          end.t_by_pressure[s] = sides[s].weight * sides[s].stress->volume;
        }
    gap_left = Tensor<1, dim>();
    if (law.constrains_tangent() && f_1.state != SurfaceState::open)
      gap_left = place.mask * (t_end - f_1.f) / measure.gamma;
    if (law.is_unilateral())
      gap_left -= (gap_left * n) * n;
    if (is_open && measure.is_farther)
      return f_1;

    const Tensor<1, dim> in_pressure_equation =
                           (f_1.f - constrained(law, place, t_end)) /
                           measure.gamma,
                         adjoint_to = (acting.f - constrained(law, place, t)) /
                                      measure.gamma;
    add_to_residual(acting, measure, in_pressure_equation, adjoint_to);
    if (with_matrix)
      {
        add_to_matrix(law, place, acting, f_1, measure, in_pressure_equation);
        add_turns_to_matrix(law, place, acting, measure);
        if (!xi_by.empty())
          add_sliding_to_matrix(acting, measure, in_pressure_equation);
      }
    return f_1;
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_to_residual(
    const Acting         &acting,
    const Measure        &measure,
    const Tensor<1, dim> &in_pressure_equation,
    const Tensor<1, dim> &adjoint_to)
  {
    const double W = measure.weight;
    for (unsigned int i = 0; i < n_dofs; ++i)
      residual[i] +=
        W * (measure.theta * (adjoint_to * adjoint[i]) - acting.f * trace[i]);
    for (const Side &side : sides)
      for (unsigned int I = 0; I < side.n_nodes && side.stress->mixed; ++I)
        residual[side.node[I] * n_components + dim] +=
          W * side.weight * side.shape[I] *
          (in_pressure_equation * side.stress->volume);
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_to_matrix(
    const InteractionLaw<dim> &law,
    const PartnerPlace<dim>   &place,
    const Acting              &acting,
    const Projection          &f_1,
    const Measure             &measure,
    const Tensor<1, dim>      &in_pressure_equation)
  {
    const double          W = measure.weight;
    const Tensor<1, dim> &n = place.normal;
    // of M t
    const auto change_of = [&](const Tensor<1, dim> &of,
                               const Tensor<1, dim> &by,
                               const Tensor<1, dim> &dn) {
      return law.constrains_tangent() ?
               Tensor<1, dim>(place.mask * by) :
               Tensor<1, dim>((by * n + of * dn) * n + (of * n) * dn);
    };
    for (unsigned int j = 0; j < n_dofs; ++j)
      {
        const Tensor<1, dim> dn =
          place.normal_by_x * trace[j] + turn_of_normal[j];
        const Tensor<1, dim> dg = place.gap_by_x * trace[j] + turn_of_gap[j],
                             dw = t_end_by[j] - measure.gamma * dg;
        Tensor<1, dim> df       = acting.by_w * dw + acting.by_n * dn;
        if (measure.start != nullptr)
          df += acting.by_start * w_0_by[j];
        const Tensor<1, dim> d_adjoint =
                               (df - change_of(t, t_by[j], dn)) / measure.gamma,
                             d_in_pressure =
                               (f_1.f_by_w * dw + f_1.f_by_n * dn -
                                change_of(t_end, t_end_by[j], dn)) /
                               measure.gamma;
        for (unsigned int i = 0; i < n_dofs; ++i)
          matrix[i * n_dofs + j] +=
            W * (measure.theta * (d_adjoint * adjoint[i]) - df * trace[i]);
        for (const Side &side : sides)
          {
            if (!side.stress->mixed)
              continue;
            const double change = d_in_pressure * side.stress->volume;
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
              (in_pressure_equation * side.stress->volume_by_u[J * dim + b]);
            for (unsigned int I = 0; I < side.n_nodes; ++I)
              matrix[(side.node[I] * n_components + dim) * n_dofs +
                     side.node[J] * n_components + b] += side.shape[I] * change;
          }
  }



  template <int dim>
  void
  InteractionKernel<dim>::add_turns_to_matrix(const InteractionLaw<dim> &law,
                                              const PartnerPlace<dim>   &place,
                                              const Acting              &acting,
                                              const Measure &measure)
  {
    const Tensor<1, dim>  f = measure.weight * acting.f;
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
  InteractionKernel<dim>::add_sliding_to_matrix(
    const Acting         &acting,
    const Measure        &measure,
    const Tensor<1, dim> &in_pressure_equation)
  {
    const Side &side = sides.back();
    for (unsigned int I = 0; I < side.n_nodes; ++I)
      for (unsigned int j = 0; j < n_dofs; ++j)
        {
          const double       dN  = measure.weight * (shape_by_xi[I] * xi_by[j]);
          const unsigned int row = side.node[I] * n_components;
          for (unsigned int b = 0; b < dim; ++b)
            matrix[(row + b) * n_dofs + j] -= side.sign * dN * acting.f[b];
          if (side.stress->mixed)
            matrix[(row + dim) * n_dofs + j] +=
              side.weight * dN * (in_pressure_equation * side.stress->volume);
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
