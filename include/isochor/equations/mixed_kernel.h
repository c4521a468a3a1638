/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mixed_kernel_h
#define isochor_mixed_kernel_h

#include <isochor/equations/pressure_stabilisation.h>
#include <isochor/material_model/material_model.h>
#include <isochor/material_points/material_points.h>

#include <array>
#include <memory>
#include <vector>

namespace isochor
{
  /** The longest history a material may have, so that hot loops need no heap.
   */
  constexpr unsigned int max_history = 16;

  /**
   * The discrete equations of one element, the only place where they stand.
   * With V_p the reference volume a point integrates, τ = dev τ + p s 1 the
   * Kirchhoff stress, g_I = ΔF^{-T} ∇_n N_I the spatial gradient of N_I:
   *
   *   R_u,I = Σ_p V_p (τ + κ e s 1) g_I                    (P(12), P(18))
   *   R_p,I = Σ_p V_p N_I (1 - κ/K) e,  e = θ^e - p/K      (doc/method.md)
   *
   * u-p: p = Σ_I N_I p_I, κ = unseen_stiffness(). u: p = K θ^e at the point,
   * here as p_I = 0 and κ = K. Tension is positive.
   * In dynamics a step takes a mean of the forces at its start and its end,
   * with the weights 1 - m and m (TimeIntegrator::end_weight()). Of pressures
   * that is to be p̄ times the mean of ∇θ, with the mean p̄ of p: their part of
   * R_u is then
   *   Σ_p V_p [ p̄ s g_I + (1 - m) (p_{n+1} - p_n) s_n ∇_n N_I ],
   * as p_n s_n ∇_n N_I has acted at the start. With m = 1/2 they do the work
   * p̄ Δθ, up to third order in Δu however much p changes; the mean of p ∇θ
   * would add Δp Δu·∇²θ Δu/4. Where the matrix is symmetric otherwise, its
   * block ∂R_u/∂p stays that without (upper_blocks_only): what is left out is
   * of the order of a step's strain.
   * In u-p a law whose strength depends on p is evaluated at that p, so that τ
   * is on its yield surface. Without such laws both are the derivatives of
   *   Π = Σ_p V_p [ W_dev(ΔF F_n) + p θ - p²/(2K) + κ e²/2 ],
   * so that the matrix is symmetric and 1/K = 0 allowed.
   */
  template <int dim>
  class MixedKernel
  {
  public:
    std::vector<std::unique_ptr<MaterialModel<dim>>> materials;

    /** Whether the plane is a section of a body of revolution, x being the
     * distance from the axis. All materials are AxisymmetricMaterials then. */
    bool axisymmetric = false;

    /** Whether pressures are unknowns: the u-p form. */
    bool has_pressures = false;

    /** Whether of the matrix of an element only the blocks of nodes I and
     * J >= I are asked for, as it is symmetric. The others are not set. */
    bool upper_blocks_only = false;

    /** Of the pressures. */
    PressureStabilisation<dim> stabilisation;

    /** Add point @p q, which integrates @p V of the cell, to what the cell's
     * stabilisation needs. */
    void
    add_compliance(const PointArrays<dim> &points,
                   const unsigned int      q,
                   const double            V,
                   CellCompliance         &compliance) const
    {
      const MaterialModel<dim> &material = *materials[points.material[q]];
      compliance.add(V / material.shear_modulus(), material.density());
    }

    /** The same where the cell is as compliant as @p mean_over_G, the mean of
     * 1/G of the points in it (1/Pa). */
    void
    add_compliance(const PointArrays<dim> &points,
                   const unsigned int      q,
                   const double            V,
                   const double            mean_over_G,
                   CellCompliance         &compliance) const
    {
      compliance.add(V * mean_over_G, materials[points.material[q]]->density());
    }

    /** That of the points [begin, end) of a cell. */
    CellCompliance
    compliance_of_points(const PointArrays<dim> &points,
                         const unsigned int      begin,
                         const unsigned int      end) const
    {
      CellCompliance compliance;
      for (unsigned int q = begin; q < end;)
        {
          // those of one material at once
          const unsigned int first = q;
          double             V     = 0;
          for (; q < end && points.material[q] == points.material[first]; ++q)
            V += points.measure(q);
          add_compliance(points, first, V, compliance);
        }
      return compliance;
    }

    /** Whether evaluate() can be used: what multiplies the unknowns in the
     * strain is the same at all points of an element. */
    bool
    has_constant_gradients() const
    {
      return !axisymmetric;
    }

    /**
     * Residual and, if @p with_matrix, matrix of @p element from the points
     * [begin, end) of @p points. @p stencil(q) is that of point q
     * (PointArrays::Stencil), its nodes those of the element in the same order;
     * Element::gradient is not used. The general way: in axisymmetry also with
     *   B_I,r = sym(e_r ⊗ g_I) + N_I/r e_θ ⊗ e_θ,
     * the change of the strain with the displacement u_I,r, r = r_{n+1}.
     */
    template <int n_components, std::size_t max_nodes, typename Stencil>
    EvaluationStatus
    evaluate_points(Element<dim, n_components, max_nodes> &element,
                    const PointArrays<dim>                &points,
                    const unsigned int                     begin,
                    const unsigned int                     end,
                    const Stencil                         &stencil,
                    const bool                             with_matrix) const;

    /**
     * The same, fast, where has_constant_gradients(): stress and modulus are
     * summed over the points before they meet the gradients.
     * @p shape(q, I) is N_I at point q.
     */
    template <int n_components, std::size_t max_nodes, typename Shape>
    EvaluationStatus
    evaluate(Element<dim, n_components, max_nodes> &element,
             const PointArrays<dim>                &points,
             const unsigned int                     begin,
             const unsigned int                     end,
             const Shape                           &shape,
             const bool                             with_matrix) const;

    /** The state at the end of the step of point @p q: what the convective
     * phase stores. */
    struct PointState
    {
      Tensor<2, dim>        F;
      double                J; ///< of the volume: in axisymmetry det F F_θθ
      SymmetricTensor<2, 3> cauchy_stress;
      double                pressure;          ///< p, from the nodes or K θ^e
      double                volumetric_strain; ///< θ^e

      /** τ : @p gradient, with @p hoop its component out of the plane. */
      double
      power(const Tensor<2, dim> &gradient, const double hoop) const
      {
        double sum = cauchy_stress[2][2] * hoop;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            sum += cauchy_stress[i][j] * gradient[i][j];
        return sum * J;
      }
    };

    /** Of @p increment Kinematics::set_increment() and hoop_increment are set,
     * once for all points of an element in which they are the same.
     * @p nodal_pressure is Σ N_I p_I, ignored in the u form. @p history gets
     * the new history. */
    PointState
    final_state(const PointArrays<dim> &points,
                const unsigned int      q,
                const Kinematics<dim>  &increment,
                const bool              mixed,
                const double            nodal_pressure,
                double                 *history) const;

    /** The same. @p hoop_increment is r_{n+1}/r_n, see
     * NodalUnknowns::hoop_at(). */
    PointState
    final_state(const PointArrays<dim> &points,
                const unsigned int      q,
                const Tensor<2, dim>   &F_increment,
                const double            hoop_increment,
                const bool              mixed,
                const double            nodal_pressure,
                double                 *history) const;

    /** F_θθ of a point with @p history; 1 if the body is not one of revolution.
     */
    double
    hoop_stretch(const double *history) const
    {
      return axisymmetric ? history[0] : 1.;
    }

    /** s_n, that of the start of the step. */
    double
    pressure_factor_at_start(const PointArrays<dim> &points,
                             const unsigned int      q) const;

    /**
     * κ (Pa), what point @p q of a law that dissipates resists to volume that
     * no node sees: PointArrays::shear_stress in series with K. See
     * doc/method.md, Volume in long flows.
     */
    double
    unseen_stiffness(const PointArrays<dim> &points, const unsigned int q) const
    {
      const double stress =
        points.shear_stress.empty() ? 0. : points.shear_stress[q];
      return stress > 0 ?
               stress /
                 (1 + stress *
                        materials[points.material[q]]->inverse_bulk_modulus()) :
               0.;
    }
  };
} // namespace isochor

#include <isochor/equations/mixed_kernel.templates.h>
#include <isochor/equations/mixed_kernel_points.templates.h>

#endif
