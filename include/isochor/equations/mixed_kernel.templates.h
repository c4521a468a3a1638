/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mixed_kernel_templates_h
#define isochor_mixed_kernel_templates_h

#include <isochor/equations/element_sums.h>
#include <isochor/equations/mixed_kernel.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/equations/pack_sums.h>

#include <algorithm>

namespace isochor
{
  namespace internal
  {
    /** Σ V τ g_I with the part of the start of the step, and R_p. */
    template <int dim, int n_components, std::size_t max_nodes>
    void
    set_residual(Element<dim, n_components, max_nodes>       &element,
                 const std::array<Tensor<1, dim>, max_nodes> &g,
                 const ElementSums<dim, max_nodes>           &sums)
    {
      for (unsigned int I = 0; I < element.nodes(); ++I)
        {
          const Tensor<1, dim> force =
            times(sums.stress, g[I]) + sums.at_start * element.gradient[I];
          for (unsigned int a = 0; a < dim; ++a)
            element.residual[I * n_components + a] = force[a];
          if (element.mixed)
            element.residual[I * n_components + n_components - 1] =
              sums.constraint[I];
        }
    }

    /** Matrix block of displacements: material part sym(e_a ⊗ g_I) : c :
     * sym(e_b ⊗ g_J) and geometric part δ_ab g_I · τ g_J. @p upper_blocks_only:
     * see MixedKernel. */
    template <int dim, int n_components, std::size_t max_nodes>
    void
    add_stiffness(Element<dim, n_components, max_nodes>       &element,
                  const std::array<Tensor<1, dim>, max_nodes> &g,
                  const ElementSums<dim, max_nodes>           &sums,
                  const bool upper_blocks_only)
    {
      const unsigned int n = element.nodes(), n_dofs = element.n_dofs();
      // c_aibl
      const auto c = [&](const unsigned int a,
                         const unsigned int i,
                         const unsigned int b,
                         const unsigned int l) {
        return sums.modulus[component_in_plane<dim>(a, i) * sums.n +
                            component_in_plane<dim>(b, l)];
      };
      for (unsigned int J = 0; J < n; ++J)
        {
          double cg[dim][dim][dim]; // c_aibl g_J,l
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int b = 0; b < dim; ++b)
                {
                  double sum = 0;
                  for (unsigned int l = 0; l < dim; ++l)
                    sum += c(a, i, b, l) * g[J][l];
                  cg[a][i][b] = sum;
                }
          const Tensor<1, dim> stress_g = times(sums.stress, g[J]);
          for (unsigned int I = 0; I < (upper_blocks_only ? J + 1 : n); ++I)
            {
              const double geometric = g[I] * stress_g;
              for (unsigned int a = 0; a < dim; ++a)
                for (unsigned int b = 0; b < dim; ++b)
                  {
                    double sum = (a == b ? geometric : 0.);
                    for (unsigned int i = 0; i < dim; ++i)
                      sum += g[I][i] * cg[a][i][b];
                    element.matrix[(I * n_components + a) * n_dofs +
                                   J * n_components + b] = sum;
                  }
            }
        }
    }

    /** Matrix blocks of u-p: Σ V (s 1 + ∂(dev τ)/∂p) g_I N_J, Σ V N_I ∂θ^e/∂d
     * g_J, Σ V N_I N_J (∂θ^e/∂p - 1/K). Of the first, s g_I
     * is m s g_I + (1 - m) s_n ∇_n N_I with Element::start_weight = 1 - m. */
    template <int dim, std::size_t max_nodes>
    void
    add_coupling(Element<dim, dim + 1, max_nodes>            &element,
                 const std::array<Tensor<1, dim>, max_nodes> &g,
                 const ElementSums<dim, max_nodes>           &sums,
                 const bool                                   upper_blocks_only)
    {
      const unsigned int     n = element.nodes(), n_dofs = element.n_dofs();
      constexpr unsigned int nc = dim + 1;
      const double w = (upper_blocks_only ? 0. : element.start_weight);
      for (unsigned int I = 0; I < n; ++I)
        for (unsigned int J = (upper_blocks_only ? I : 0); J < n; ++J)
          {
            const Tensor<1, dim> theta_g =
              times(sums.volumetric_tangent[I], g[J]);
            Tensor<1, dim> force = sums.s[J] * g[I];
            if (w > 0)
              force += w * (sums.s_at_start[J] * element.gradient[I] -
                            sums.s_at_end[J] * g[I]);
            if (sums.pressure_dependent)
              force += times(sums.pressure_tangent[J], g[I]);
            for (unsigned int a = 0; a < dim; ++a)
              {
                element.matrix[(I * nc + a) * n_dofs + J * nc + dim] = force[a];
                element.matrix[(I * nc + dim) * n_dofs + J * nc + a] =
                  theta_g[a];
              }
            element.matrix[(I * nc + dim) * n_dofs + J * nc + dim] =
              -sums.compressibility[std::min(I, J) * n + std::max(I, J)];
          }
    }
  } // namespace internal



  template <int dim>
  template <int n_components, std::size_t max_nodes, typename Shape>
  EvaluationStatus
  MixedKernel<dim>::evaluate(Element<dim, n_components, max_nodes> &element,
                             const PointArrays<dim>                &points,
                             const unsigned int                     begin,
                             const unsigned int                     end,
                             const Shape                           &shape,
                             const bool with_matrix) const
  {
    Assert(begin <= end && end <= points.n_points(), ExcInternalError());
    constexpr bool     mixed = (n_components == dim + 1);
    const unsigned int n     = element.nodes();

    const Tensor<2, dim> F_increment = deformation_increment<dim>(
      element.nodes(),
      [&](const unsigned int I) -> const Tensor<1, dim> & {
        return element.increment[I];
      },
      element.gradient.data());
    if (!(determinant(F_increment) > 0))
      return EvaluationStatus::inverted_point;
    Kinematics<dim> kinematics;
    kinematics.set_increment(F_increment);
    kinematics.with_tangent                       = with_matrix;
    kinematics.with_history                       = false;
    const Tensor<2, dim>                  inverse = invert(F_increment);
    std::array<Tensor<1, dim>, max_nodes> g;
    for (unsigned int I = 0; I < n; ++I)
      g[I] = element.gradient[I] * inverse;

    internal::ElementSums<dim, max_nodes> sums;
    StressResponse<dim>                   response;
    std::array<double, max_history>       history;

    element.compliance = {};
    internal::LawOfPoints<dim> law(materials);
    // fewer don't make up for what the packs cost once
    constexpr unsigned int                            enough_for_packs = 5;
    std::optional<internal::PackSums<dim, max_nodes>> packs;
    for (unsigned int q = begin; q < end; ++q)
      {
        law.set(points.material[q]);
        if (law.evaluates_packs && end - q >= enough_for_packs &&
            element.start_weight == 0)
          {
            // at once, all that follow and have the same law
            unsigned int last = q + 1;
            double       V    = points.weight[q];
            for (; last < end && points.material[last] == points.material[q];
                 ++last)
              V += points.weight[last];
            if (last - q >= enough_for_packs)
              {
                if (!packs)
                  packs.emplace(kinematics);
                const EvaluationStatus status = packs->template add<mixed>(
                  *this, points, q, last, law, n, element.pressure, shape);
                if (status != EvaluationStatus::success)
                  return status;
                element.compliance.add(V * law.inverse_G, law.density);
                q = last - 1;
                continue;
              }
          }
        kinematics.F = F_increment * points.F[q];
        kinematics.J = determinant(kinematics.F);
        if (!(kinematics.J > 0))
          return EvaluationStatus::inverted_point;
        double p = 0;
        if (mixed)
          {
            for (unsigned int I = 0; I < n; ++I)
              p += shape(q, I) * element.pressure[I];
            kinematics.pressure =
              law.depends_on_pressure ? std::optional<double>(p) : std::nullopt;
          }
        if (law.material->evaluate(kinematics,
                                   points.history.data() +
                                     q * std::size_t(points.n_history),
                                   history.data(),
                                   response) != StressStatus::success)
          return EvaluationStatus::return_map_failed;

        const double V = points.weight[q], inverse_K = law.inverse_K;
        element.compliance.add(V * law.inverse_G, law.density);
        const internal::PressureFactor factor(law.measure, kinematics.J);
        const auto   N      = [&](const unsigned int I) { return shape(q, I); };
        const double change = element.pressure_change(N);
        if (element.start_weight > 0)
          sums.add_at_start(V * pressure_factor_at_start(points, q),
                            V * factor.s,
                            change,
                            n,
                            N);
        const double kappa =
          mixed ? unseen_stiffness(points, q) : 1 / inverse_K;
        const double excess  = response.volumetric_strain - p * inverse_K;
        const double p_force = p - change + kappa * excess;
        sums.add_stress(response, V, p_force, factor, with_matrix);
        if (kappa > 0 && with_matrix)
          sums.add_bulk_stiffness(response, V * factor.s * kappa);
        if (mixed)
          sums.add_constraint(
            response, law, V, excess, kappa, factor, n, N, with_matrix);
      }
    if (packs)
      packs->add_to(sums, n);
    sums.complete(with_matrix);

    internal::set_residual(element, g, sums);
    if (with_matrix)
      {
        internal::add_stiffness(element, g, sums, upper_blocks_only);
        if constexpr (mixed)
          internal::add_coupling(element, g, sums, upper_blocks_only);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  double
  MixedKernel<dim>::pressure_factor_at_start(const PointArrays<dim> &points,
                                             const unsigned int      q) const
  {
    const double *const history =
      points.history.data() + q * std::size_t(points.n_history);
    return internal::PressureFactor(
             materials[points.material[q]]->volumetric_measure(),
             determinant(points.F[q]) * hoop_stretch(history))
      .s;
  }



  template <int dim>
  typename MixedKernel<dim>::PointState
  MixedKernel<dim>::final_state(const PointArrays<dim> &points,
                                const unsigned int      q,
                                const Tensor<2, dim>   &F_increment,
                                const double            hoop_increment,
                                const bool              mixed,
                                const double            nodal_pressure,
                                double                 *history) const
  {
    Kinematics<dim> increment;
    increment.set_increment(F_increment);
    increment.hoop_increment = hoop_increment;
    return final_state(points, q, increment, mixed, nodal_pressure, history);
  }



  template <int dim>
  typename MixedKernel<dim>::PointState
  MixedKernel<dim>::final_state(const PointArrays<dim> &points,
                                const unsigned int      q,
                                const Kinematics<dim>  &increment,
                                const bool              mixed,
                                const double            nodal_pressure,
                                double                 *history) const
  {
    AssertIndexRange(q, points.n_points());
    AssertIndexRange(points.material[q], materials.size());
    const MaterialModel<dim> &material = *materials[points.material[q]];
    const double *const       old_history =
      points.history.data() + q * std::size_t(points.n_history);
    Kinematics<dim> kinematics = increment;
    kinematics.with_tangent    = false;
    kinematics.with_history    = true;
    kinematics.F               = increment.F_increment * points.F[q];
    kinematics.J               = determinant(kinematics.F);
    if (axisymmetric)
      kinematics.J *= increment.hoop_increment * hoop_stretch(old_history);
    if (mixed && material.depends_on_pressure())
      kinematics.pressure = nodal_pressure;
    StressResponse<dim> response;
    material.evaluate(kinematics, old_history, history, response);
    PointState state;
    state.J                 = kinematics.J;
    state.F                 = kinematics.F;
    state.volumetric_strain = response.volumetric_strain;
    state.pressure =
      mixed ? nodal_pressure :
              response.volumetric_strain / material.inverse_bulk_modulus();
    const internal::PressureFactor factor(material.volumetric_measure(),
                                          kinematics.J);
    state.cauchy_stress =
      (response.deviatoric_stress +
       state.pressure * factor.s * unit_symmetric_tensor<3>()) /
      kinematics.J;
    return state;
  }

} // namespace isochor

#endif
