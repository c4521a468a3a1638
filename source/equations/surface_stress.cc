/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/equations/surface_stress.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    /** The part of @p A in the plane times @p a. */
    template <int dim, int strain_dim>
    Tensor<1, dim>
    in_plane(const SymmetricTensor<2, strain_dim> &A, const Tensor<1, dim> &a)
    {
      Tensor<1, dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i] += A[i][j] * a[j];
      return result;
    }

    /** sym(e_b ⊗ g) + h e_θ ⊗ e_θ for b = r. */
    template <int dim, int strain_dim>
    SymmetricTensor<2, strain_dim>
    strain_of(const unsigned int b, const Tensor<1, dim> &g, const double h)
    {
      SymmetricTensor<2, strain_dim> B;
      for (unsigned int i = 0; i < dim; ++i)
        B[b][i] += (i == b ? 1. : 0.5) * g[i];
      if (strain_dim > dim && b == 0)
        B[strain_dim - 1][strain_dim - 1] = h;
      return B;
    }

    /** The largest eigenvalue of a · @p elastic · a + @p geometric 1 +
     * @p bulk a ⊗ a (Pa). */
    template <int dim, int strain_dim>
    double
    largest_modulus(const SymmetricTensor<4, strain_dim> &elastic,
                    const Tensor<1, dim>                 &a,
                    const double                          geometric,
                    const double                          bulk)
    {
      SymmetricTensor<2, dim> Q = bulk * symmetrize(outer_product(a, a));
      for (unsigned int b = 0; b < dim; ++b)
        {
          const Tensor<1, dim> column =
            in_plane<dim>(elastic * strain_of<dim, strain_dim>(b, a, 0.), a);
          for (unsigned int i = 0; i < dim; ++i)
            Q[i][b] += (i == b ? 1. : 0.5) * column[i];
          Q[b][b] += geometric;
        }
      return eigenvalues(Q)[0];
    }
  } // namespace



  template <int dim>
  EvaluationStatus
  SurfaceStress<dim>::evaluate(const MixedKernel<dim> &kernel,
                               const Domain           &domain,
                               const Tensor<1, dim>   &N,
                               const double            p,
                               const bool              with_derivatives)
  {
    if constexpr (dim == 2)
      if (kernel.axisymmetric)
        return evaluate_in<3>(kernel, domain, N, p, with_derivatives);
    return evaluate_in<dim>(kernel, domain, N, p, with_derivatives);
  }



  template <int dim>
  template <int strain_dim>
  EvaluationStatus
  SurfaceStress<dim>::evaluate_in(const MixedKernel<dim> &kernel,
                                  const Domain           &domain,
                                  const Tensor<1, dim>   &N,
                                  const double            p,
                                  const bool              with_derivatives)
  {
    constexpr bool             hoop     = (strain_dim > dim);
    const auto                &stencil  = domain.stencil;
    const MaterialModel<dim>  &material = *domain.material;
    Kinematics<dim>            kinematics;
    StressResponse<strain_dim> response;
    mixed                   = kernel.has_pressures;
    kinematics.with_history = !with_derivatives; // for flow()
    F_increment             = deformation_increment<dim>(
      stencil.n_nodes,
      [&](const unsigned int I) -> const Tensor<1, dim>             &{
        return increments[I];
      },
      stencil.gradient);
    if (!(determinant(F_increment) > 0))
      return EvaluationStatus::inverted_point;
    kinematics.set_increment(F_increment);
    kinematics.F = F_increment * domain.F;
    kinematics.J = determinant(kinematics.F);
    double u_r   = 0;
    if (hoop)
      {
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          u_r += stencil.shape[I] * increments[I][0];
        kinematics.hoop_increment = 1 + u_r / domain.radius;
        kinematics.J *=
          kinematics.hoop_increment * kernel.hoop_stretch(domain.history);
      }
    if (!(kinematics.J > 0) || !(kinematics.hoop_increment > 0))
      return EvaluationStatus::inverted_point;
    if (mixed && material.depends_on_pressure())
      kinematics.pressure = p;
    if (internal::respond(
          material, kinematics, domain.history, history.data(), response) !=
        StressStatus::success)
      return EvaluationStatus::return_map_failed;

    const internal::PressureFactor factor(material.volumetric_measure(),
                                          kinematics.J);
    const double                   inverse_K = material.inverse_bulk_modulus();
    const Tensor<1, dim>           a         = N * invert(kinematics.F);
    // plane strain: with τ_zz
    stress_norm     = std::hypot(response.deviatoric_stress.norm(),
                             trace(response.deviatoric_stress));
    deviatoric      = in_plane<dim>(response.deviatoric_stress, a);
    volume          = factor.s * a;
    area            = kinematics.J * a;
    own_pressure    = mixed ? 0. : response.volumetric_strain / inverse_K;
    deviatoric_by_p = mixed && material.depends_on_pressure() ?
                        in_plane<dim>(response.deviatoric_pressure_tangent, a) :
                        Tensor<1, dim>();
    if (!with_derivatives)
      return EvaluationStatus::success;

    const unsigned int n = stencil.n_nodes * dim;
    for (auto *field :
         {&deviatoric_by_u, &elastic_by_u, &volume_by_u, &area_by_u})
      field->resize(n);
    own_pressure_by_u.assign(n, 0.);
    // laws that may yield: what is elastic of them
    const SymmetricTensor<4, strain_dim> elastic =
      material.dissipates() ?
        2 * material.shear_modulus() * std::sqrt(domain.kept) *
          deviator_tensor<strain_dim>() :
        response.tangent;
    const Tensor<2, dim> inverse = invert(F_increment);
    for (unsigned int J = 0; J < stencil.n_nodes; ++J)
      {
        const Tensor<1, dim> g = stencil.gradient[J] * inverse;
        const double h = hoop ? stencil.shape[J] / (domain.radius + u_r) : 0.;
        const double geometric = g * deviatoric;
        for (unsigned int b = 0; b < dim; ++b)
          {
            const unsigned int i       = J * dim + b;
            const auto         B       = strain_of<dim, strain_dim>(b, g, h);
            const double       trace_l = trace(B);
            deviatoric_by_u[i]         = in_plane<dim>(response.tangent * B, a);
            deviatoric_by_u[i][b] += geometric;
            elastic_by_u[i] = in_plane<dim>(elastic * B, a);
            elastic_by_u[i][b] += geometric;
            volume_by_u[i] =
              factor.Js_prime * trace_l * a - factor.s * a[b] * g;
            area_by_u[i] = kinematics.J * (trace_l * a - a[b] * g);
            if (mixed)
              continue;
            own_pressure_by_u[i] = response.volumetric_tangent * B / inverse_K;
            elastic_by_u[i] += (factor.s * factor.s * trace_l / inverse_K) * a;
          }
      }

    normal_modulus =
      largest_modulus(elastic,
                      a,
                      std::max(0., a * deviatoric),
                      mixed ? 0. : factor.s * factor.s / inverse_K);
    return EvaluationStatus::success;
  }



  template class SurfaceStress<2>;
  template class SurfaceStress<3>;
} // namespace isochor
