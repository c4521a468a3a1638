/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mixed_kernel_points_templates_h
#define isochor_mixed_kernel_points_templates_h

// MixedKernel::evaluate_points(), the general way.

#include <isochor/equations/mixed_kernel.h>
#include <isochor/material_model/axisymmetric_material.h>

namespace isochor
{
  namespace internal
  {
    /** A law's response in all directions in which the strain can change: those
     * of the plane or space, in axisymmetry also the hoop's. */
    template <int dim>
    StressStatus
    respond(const MaterialModel<dim> &material,
            const Kinematics<dim>    &kinematics,
            const double             *history_n,
            double                   *history,
            StressResponse<dim>      &response)
    {
      return material.evaluate(kinematics, history_n, history, response);
    }

    inline StressStatus
    respond(const MaterialModel<2> &material,
            const Kinematics<2>    &kinematics,
            const double           *history_n,
            double                 *history,
            StressResponse<3>      &response)
    {
      return static_cast<const AxisymmetricMaterial &>(material).evaluate(
        kinematics, history_n, history, response);
    }

    /**
     * Adds one point to an element. @p strain_dim is the dimension of the
     * changes of strain, dim or, with a hoop strain, 3.
     */
    template <int dim, int strain_dim, int n_components, std::size_t max_nodes>
    class PointSum
    {
    public:
      /** What the unknown u_I,a changes: the strain by B_I,a = sym(e_a ⊗ g_I)
       * (+ h_I e_θ ⊗ e_θ for a = r). */
      std::array<Tensor<1, dim>, max_nodes> g; ///< ΔF^{-T} ∇_n N_I
      std::array<double, max_nodes>         h; ///< N_I / r; with a hoop only
      const double                         *N;

      PointSum(Element<dim, n_components, max_nodes> &element)
        : element(element)
      {}

      void
      set_strains()
      {
        for (unsigned int I = 0; I < element.nodes(); ++I)
          for (unsigned int a = 0; a < dim; ++a)
            {
              auto &b = B[I * dim + a];
              b       = 0;
              for (unsigned int i = 0; i < dim; ++i)
                b[a][i] += (i == a ? 1. : 0.5) * g[I][i];
              if (strain_dim > dim && a == 0)
                b[strain_dim - 1][strain_dim - 1] = h[I];
            }
      }

      /** @p stress: V τ. */
      void
      add_residual(const SymmetricTensor<2, strain_dim> &stress,
                   const double                          constraint)
      {
        for (unsigned int I = 0; I < element.nodes(); ++I)
          {
            for (unsigned int a = 0; a < dim; ++a)
              element.residual[I * n_components + a] += stress * B[I * dim + a];
            if (n_components > dim)
              element.residual[I * n_components + n_components - 1] +=
                N[I] * constraint;
          }
      }

      /** V τ and its modulus: B:c:B and (g_I·τ g_J) 1 (+ h_I τ_θθ h_J). */
      void
      add_stiffness(const SymmetricTensor<2, strain_dim> &stress,
                    const SymmetricTensor<4, strain_dim> &modulus)
      {
        const unsigned int n_dofs = element.n_dofs();
        for (unsigned int J = 0; J < element.nodes(); ++J)
          {
            Tensor<1, dim> stress_g;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                stress_g[i] += stress[i][j] * g[J][j];
            for (unsigned int b = 0; b < dim; ++b)
              {
                const SymmetricTensor<2, strain_dim> change =
                  modulus * B[J * dim + b];
                for (unsigned int I = 0; I < element.nodes(); ++I)
                  for (unsigned int a = 0; a < dim; ++a)
                    {
                      double entry = B[I * dim + a] * change;
                      if (a == b)
                        entry += g[I] * stress_g;
                      if (strain_dim > dim && a == 0 && b == 0)
                        entry +=
                          h[I] * h[J] * stress[strain_dim - 1][strain_dim - 1];
                      element.matrix[(I * n_components + a) * n_dofs +
                                     J * n_components + b] += entry;
                    }
              }
          }
      }

      /** V (s 1 + ∂(dev τ)/∂p), V ∂θ^e/∂d and V (1/K - ∂θ^e/∂p) between
       * unknowns; @p pressure_dependent: whether there are derivatives by p. */
      void
      add_coupling(const StressResponse<strain_dim> &response,
                   const double                      V,
                   const double                      s,
                   const double                      kappa,
                   const double                      inverse_K,
                   const bool                        pressure_dependent)
      {
        double compliance = inverse_K;
        if (pressure_dependent)
          compliance -= response.volumetric_pressure_tangent;
        SymmetricTensor<2, strain_dim> force =
          (V * s * (1 - kappa * compliance)) *
          unit_symmetric_tensor<strain_dim>();
        if (pressure_dependent)
          force += V * response.deviatoric_pressure_tangent;
        const double                         seen = V * (1 - kappa * inverse_K);
        const SymmetricTensor<2, strain_dim> volume =
          seen * response.volumetric_tangent;
        const double       compressibility = seen * compliance;
        const unsigned int n_dofs          = element.n_dofs();
        for (unsigned int I = 0; I < element.nodes(); ++I)
          for (unsigned int J = 0; J < element.nodes(); ++J)
            {
              const unsigned int p_I = I * n_components + dim,
                                 p_J = J * n_components + dim;
              for (unsigned int a = 0; a < dim; ++a)
                {
                  element.matrix[(I * n_components + a) * n_dofs + p_J] +=
                    (force * B[I * dim + a]) * N[J];
                  element.matrix[p_J * n_dofs + I * n_components + a] +=
                    (volume * B[I * dim + a]) * N[J];
                }
              element.matrix[p_I * n_dofs + p_J] -=
                N[I] * N[J] * compressibility;
            }
      }

      /** Of Element::start_weight, @p V_s = V s at the end,
       * @p V_s_n at the start: there u_I,a changes θ by G_I,a (+ N_I/r_n). */
      void
      add_at_start(const Tensor<1, dim> *const G,
                   const double                r_n,
                   const double                V_s,
                   const double                V_s_n,
                   const double                pressure_change,
                   const bool                  in_matrix)
      {
        const unsigned int n_dofs = element.n_dofs();
        for (unsigned int I = 0; I < element.nodes(); ++I)
          for (unsigned int a = 0; a < dim; ++a)
            {
              const double at_start =
                V_s_n *
                (G[I][a] + (strain_dim > dim && a == 0 ? N[I] / r_n : 0.));
              const unsigned int i = I * n_components + a;
              element.residual[i] += pressure_change * at_start;
              if (!in_matrix)
                continue;
              const double change =
                element.start_weight * (at_start - V_s * trace(B[I * dim + a]));
              for (unsigned int J = 0; J < element.nodes(); ++J)
                element.matrix[i * n_dofs + J * n_components + dim] +=
                  change * N[J];
            }
      }

    private:
      Element<dim, n_components, max_nodes>                      &element;
      std::array<SymmetricTensor<2, strain_dim>, max_nodes * dim> B;
    };



    /** See MixedKernel::evaluate_points(). */
    template <int         strain_dim,
              int         dim,
              int         n_components,
              std::size_t max_nodes,
              typename Stencil>
    EvaluationStatus
    evaluate_points(const MixedKernel<dim>                &kernel,
                    Element<dim, n_components, max_nodes> &element,
                    const PointArrays<dim>                &points,
                    const unsigned int                     begin,
                    const unsigned int                     end,
                    const Stencil                         &stencil_of,
                    const bool                             with_matrix)
    {
      constexpr bool mixed = (n_components == dim + 1);
      Assert(begin <= end && end <= points.n_points(), ExcInternalError());
      constexpr bool     hoop = (strain_dim > dim);
      const unsigned int n    = element.nodes();
      element.compliance      = {};
      std::fill_n(element.residual.begin(), element.n_dofs(), 0.);
      if (with_matrix)
        std::fill_n(element.matrix.begin(),
                    element.n_dofs() * element.n_dofs(),
                    0.);

      PointSum<dim, strain_dim, n_components, max_nodes> sum(element);
      Kinematics<dim>                                    kinematics;
      StressResponse<strain_dim>                         response;
      std::array<double, max_history>                    history;
      kinematics.with_tangent = with_matrix;
      kinematics.with_history = false;
      for (unsigned int q = begin; q < end; ++q)
        {
          const auto           stencil     = stencil_of(q);
          const Tensor<2, dim> F_increment = deformation_increment<dim>(
            n,
            [&](const unsigned int I) -> const Tensor<1, dim> & {
              return element.increment[I];
            },
            stencil.gradient);
          if (!(determinant(F_increment) > 0))
            return EvaluationStatus::inverted_point;
          double u_r = 0, p = 0;
          for (unsigned int I = 0; I < n; ++I)
            {
              u_r += stencil.shape[I] * element.increment[I][0];
              if (mixed)
                p += stencil.shape[I] * element.pressure[I];
            }
          const double *const history_n =
            points.history.data() + q * std::size_t(points.n_history);
          kinematics.set_increment(F_increment);
          kinematics.F = F_increment * points.F[q];
          kinematics.J = determinant(kinematics.F);
          if (hoop)
            {
              kinematics.hoop_increment = 1 + u_r / points.radius[q];
              kinematics.J *=
                kinematics.hoop_increment * kernel.hoop_stretch(history_n);
            }
          if (!(kinematics.J > 0) || !(kinematics.hoop_increment > 0))
            return EvaluationStatus::inverted_point;
          const MaterialModel<dim> &material =
            *kernel.materials[points.material[q]];
          const bool pressure_dependent =
            mixed && material.depends_on_pressure();
          kinematics.pressure =
            pressure_dependent ? std::optional<double>(p) : std::nullopt;
          if (respond(
                material, kinematics, history_n, history.data(), response) !=
              StressStatus::success)
            return EvaluationStatus::return_map_failed;
          const double V = points.measure(q);
          kernel.add_compliance(points, q, V, element.compliance);
          const double         inverse_K = material.inverse_bulk_modulus();
          const PressureFactor factor(material.volumetric_measure(),
                                      kinematics.J);

          const Tensor<2, dim> inverse = invert(F_increment);
          sum.N                        = stencil.shape;
          for (unsigned int I = 0; I < n; ++I)
            {
              sum.g[I] = stencil.gradient[I] * inverse;
              if (hoop)
                sum.h[I] = stencil.shape[I] / (points.radius[q] + u_r);
            }
          sum.set_strains();

          const auto   one = unit_symmetric_tensor<strain_dim>();
          const double kappa =
            mixed ? kernel.unseen_stiffness(points, q) : 1 / inverse_K;
          const double excess = response.volumetric_strain - p * inverse_K;
          const double change = element.pressure_change(
            [&](const unsigned int I) { return stencil.shape[I]; });
          const double                   p_force = p - change + kappa * excess;
          SymmetricTensor<2, strain_dim> stress =
            (V * p_force * factor.s) * one;
          for (unsigned int i = 0; i < strain_dim; ++i)
            for (unsigned int j = i; j < strain_dim; ++j)
              stress[i][j] += V * response.deviatoric_stress[i][j];
          sum.add_residual(stress, V * (1 - kappa * inverse_K) * excess);
          if (element.start_weight > 0)
            sum.add_at_start(stencil.gradient,
                             hoop ? points.radius[q] : 1.,
                             V * factor.s,
                             V * kernel.pressure_factor_at_start(points, q),
                             change,
                             with_matrix && !kernel.upper_blocks_only);
          if (!with_matrix)
            continue;
          SymmetricTensor<4, strain_dim> modulus =
            V * response.tangent +
            (V * p_force * factor.Js_prime) * outer_product(one, one) -
            (2 * V * p_force * factor.s) * identity_tensor<strain_dim>();
          if (kappa > 0)
            modulus += outer_product((V * factor.s * kappa) * one,
                                     response.volumetric_tangent);
          sum.add_stiffness(stress, modulus);
          if constexpr (mixed)
            sum.add_coupling(
              response, V, factor.s, kappa, inverse_K, pressure_dependent);
        }
      return EvaluationStatus::success;
    }
  } // namespace internal



  template <int dim>
  template <int n_components, std::size_t max_nodes, typename Stencil>
  EvaluationStatus
  MixedKernel<dim>::evaluate_points(
    Element<dim, n_components, max_nodes> &element,
    const PointArrays<dim>                &points,
    const unsigned int                     begin,
    const unsigned int                     end,
    const Stencil                         &stencil,
    const bool                             with_matrix) const
  {
    if constexpr (dim == 2)
      if (axisymmetric)
        return internal::evaluate_points<3>(
          *this, element, points, begin, end, stencil, with_matrix);
    return internal::evaluate_points<dim>(
      *this, element, points, begin, end, stencil, with_matrix);
  }
} // namespace isochor

#endif
