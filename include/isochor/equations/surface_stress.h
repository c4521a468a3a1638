/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_stress_h
#define isochor_surface_stress_h

#include <isochor/equations/mixed_kernel.h>
#include <isochor/material_model/plastic_strain.h>

#include <vector>

namespace isochor
{
  /**
   * The traction that a CPDI subdomain exerts on a plane with the reference
   * normal N, per reference area, and its derivatives with respect to the nodal
   * unknowns of the step. With a = F^{-T} N and the Kirchhoff stress
   * τ = dev τ + p s 1 of MixedKernel,
   *   t = P N = τ a = dev τ a + p s a,
   * and for a change l = e_b ⊗ g_J of the velocity gradient, g_J = ΔF^{-T}
   * ∇N_J, δ(dev τ a) = e_b (g_J · dev τ a) + (c : sym l) a, δ(s a)     = s' J
   * (tr l) a - s a_b g_J, δ(J a)     = J ((tr l) a - a_b g_J), with c of
   * StressResponse and, in axisymmetry, the hoop strain N_J/r in sym l. J a is
   * the current area vector (Nanson). dev τ is constant in the subdomain; in
   * u-p, p is that of the place where the traction is asked for.
   */
  template <int dim>
  class SurfaceStress
  {
  public:
    /** What is known of the subdomain's point: a point of this rank, or a copy
     * of one of another rank. */
    struct Domain
    {
      const MaterialModel<dim>          *material;
      Tensor<2, dim>                     F; ///< at the start of the step
      const double                      *history;
      double                             radius; ///< in axisymmetry (m)
      typename PointArrays<dim>::Stencil stencil;
      double kept = 1; ///< m: Flow::kept of the last step
    };

    /** Evaluate for the reference normal @p N. @p increment(I) and
     * @p pressure(I) are the nodal unknowns of the stencil's node I; the latter
     * is not called in the u form. */
    template <typename Increment, typename Pressure>
    EvaluationStatus
    evaluate(const MixedKernel<dim> &kernel,
             const Domain           &domain,
             const Tensor<1, dim>   &N,
             const Increment        &increment,
             const Pressure         &pressure,
             const bool              with_derivatives)
    {
      increments.resize(domain.stencil.n_nodes);
      double p = 0;
      for (unsigned int I = 0; I < domain.stencil.n_nodes; ++I)
        {
          increments[I] = increment(I);
          if (kernel.has_pressures)
            p += domain.stencil.shape[I] * pressure(I);
        }
      return evaluate(kernel, domain, N, p, with_derivatives);
    }

    /** t at a place where the pressure unknown is @p p (ignored in the u form).
     */
    Tensor<1, dim>
    traction(const double p) const
    {
      return deviatoric + (mixed ? p : own_pressure) * volume;
    }

    /** ∂t/∂u_J,b there. */
    Tensor<1, dim>
    traction_by_displacement(const unsigned int J,
                             const unsigned int b,
                             const double       p) const
    {
      const unsigned int i = J * dim + b;
      return mixed ? deviatoric_by_u[i] + p * volume_by_u[i] :
                     deviatoric_by_u[i] + own_pressure * volume_by_u[i] +
                       own_pressure_by_u[i] * volume;
    }

    /** B_J,b of the adjoint consistency term, linear in the test function: the
     * constitutive and the initial-stress part of ∂t/∂u_J,b with the moduli A,
     * without δ(s a) of the pressure. A are elastic moduli, with G √m in place
     * of G where material that yields has kept the part m of its elastic shear
     * strain in the last step: the mean of G, if it unloads, and the secant
     * modulus G m, if it flows on. */
    Tensor<1, dim>
    elastic_traction_by_displacement(const unsigned int J,
                                     const unsigned int b) const
    {
      return elastic_by_u[J * dim + b];
    }

    /** What the material has flown in a step. */
    struct Flow
    {
      double strain = 0; ///< the change of the equivalent plastic strain
      double kept   = 1; ///< kept_shear_strain()
    };
    /** Of the step, which began with @p history_n. */
    Flow
    flow(const MaterialModel<dim> &material, const double *history_n) const
    {
      const unsigned int entry = entry_of_plastic_strain(material);
      if (entry == numbers::invalid_unsigned_int)
        return {};
      const double strain = history[entry] - history_n[entry];
      return {strain,
              kept_shear_strain(material.shear_modulus(), stress_norm, strain)};
    }

    /** What @p r in the subdomain has become by the end of the step. */
    Tensor<1, dim>
    carried(const Tensor<1, dim> &r) const
    {
      return F_increment * r;
    }

    /** |N · A · N| (Pa): the largest change of the traction with the gradient
     * v ⊗ N of the displacement; of A in u-p the deviatoric part. */
    double normal_modulus = 0;

    Tensor<1, dim>              deviatoric;             ///< dev τ a
    Tensor<1, dim>              volume;                 ///< s a
    Tensor<1, dim>              area;                   ///< J a
    std::vector<Tensor<1, dim>> volume_by_u, area_by_u; ///< J * dim + b
    /** ∂(dev τ)/∂p a, of laws that depend on the pressure, with p of the point.
     */
    Tensor<1, dim> deviatoric_by_p;
    /** Whether pressures are unknowns. */
    bool mixed = false;

  private:
    EvaluationStatus
    evaluate(const MixedKernel<dim> &kernel,
             const Domain           &domain,
             const Tensor<1, dim>   &N,
             const double            p,
             const bool              with_derivatives);
    template <int strain_dim>
    EvaluationStatus
    evaluate_in(const MixedKernel<dim> &kernel,
                const Domain           &domain,
                const Tensor<1, dim>   &N,
                const double            p,
                const bool              with_derivatives);

    Tensor<2, dim>                  F_increment;
    std::array<double, max_history> history; ///< at the end of the step
    double                          stress_norm  = 0; ///< |dev τ| (Pa)
    double                          own_pressure = 0; ///< K θ^e, in the u form
    std::vector<Tensor<1, dim>>     increments;
    std::vector<Tensor<1, dim>>     deviatoric_by_u, elastic_by_u;
    std::vector<double>             own_pressure_by_u;
  };
} // namespace isochor

#endif
