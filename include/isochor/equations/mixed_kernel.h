/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mixed_kernel_h
#define isochor_mixed_kernel_h

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

  /** What can go wrong in an evaluation; the largest of all ranks counts. */
  enum class EvaluationStatus : unsigned int
  {
    success           = 0,
    inverted_point    = 1,
    return_map_failed = 2
  };

  /**
   * The part of the body that shares one list of nodes: a background cell with
   * its points. Nodes are local to the element. Input is filled by the caller,
   * output by the kernel. Unknown a of node I is entry I * n_components + a;
   * the pressure, if any, is component dim.
   *
   * @tparam n_components dim for u, dim + 1 for u-p.
   * @tparam max_nodes dim + 1 for cells (then n_nodes is ignored).
   */
  template <int dim, int n_components, std::size_t max_nodes>
  struct Element
  {
    static constexpr int  n_max = max_nodes * n_components;
    static constexpr bool mixed = (n_components == dim + 1);

    unsigned int                          n_nodes = max_nodes;
    std::array<Tensor<1, dim>, max_nodes> gradient;  ///< ∇_n N_I
    std::array<Tensor<1, dim>, max_nodes> increment; ///< Δu_I
    std::array<double, max_nodes>         pressure;  ///< p_I
    /** p_I at the start of the step, and the share 1 - m that they have in the
     * mean of the step; 0: the pressures at its end count. */
    std::array<double, max_nodes>     pressure_at_start;
    double                            start_weight = 0;
    std::array<double, n_max>         residual;
    std::array<double, n_max * n_max> matrix; ///< row-major, n_dofs wide
    /** Of the points that it has been summed over. */
    CellCompliance compliance;

    /** (1 - m) (p - p_n) at a point with the shape values @p N. */
    template <typename Shape>
    double
    pressure_change(const Shape &N) const
    {
      double sum = 0;
      if (start_weight > 0)
        for (unsigned int I = 0; I < nodes(); ++I)
          sum += start_weight * N(I) * (pressure[I] - pressure_at_start[I]);
      return sum;
    }

    constexpr unsigned int
    nodes() const
    {
      return max_nodes == dim + 1 ? dim + 1 : n_nodes;
    }
    constexpr unsigned int
    n_dofs() const
    {
      return nodes() * n_components;
    }
  };

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

    /** α of the Polynomial Pressure Projection (Dohrmann & Bochev 2004), P(26);
     * 0 for none. */
    double ppp_coefficient = 0;

    /** Whether the stabilisation is that of OrthogonalSubscales. */
    bool has_orthogonal_subscales = false;

    /** Whether it is PPP, cell by cell. */
    bool
    projects_pressures() const
    {
      return ppp_coefficient > 0 && !has_orthogonal_subscales;
    }

    /** Gravity in statics (m/s²): the stabilisation leaves out the pressure
     * that is in equilibrium with it. Zero: as it stands in the paper. */
    Tensor<1, dim> hydrostatic_acceleration;

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

    /**
     * The stabilisation of one cell, P(26) over the part of the cell that is
     * filled: subtract the derivatives of its energy
     *   Φ = α/(2G) V Σ_IJ d_I (M_IJ - 1/(d+1)²) d_J,
     * from @p element, with V the reference volume of the cell's points, M_IJ
     * the P1 mass matrix of unit measure and d_I = p_I - h_I. In closed form:
     * with a point at the centroid only, integration by points would give zero.
     *
     * h_I = - ρ g·x_I is the pressure at rest under the body's weight
     * (hydrostatic_acceleration), with x_I the vertices at the end of the step:
     * @p corners and the increments. P(26), which has h = 0, would take it for
     * an oscillation and answer with a change of volume. Without weight only
     * the pressure's part of @p element is changed.
     */
    template <std::size_t max_nodes>
    void
    add_pressure_projection(Element<dim, dim + 1, max_nodes>      &element,
                            const CellCompliance                  &compliance,
                            const std::array<Point<dim>, dim + 1> &corners,
                            const bool with_matrix) const;

    /** What the stabilisation of one cell stores. */
    struct ProjectionEnergy
    {
      double         stored = 0; ///< J
      Tensor<1, dim> moment;     ///< kg m
    };
    /**
     * Of the same cell, for an acceleration g of @p weight that may be another
     * one than hydrostatic_acceleration. As the pressure equation is
     * θ = p/K + S d, the power of the volume p·θ' is that of p²/(2K) and
     *   p·S d' = d/dt (p + h)·S (p - h) / 2 - h'·S d,
     * where h' is the change of h in time at places that stay. The first term
     * is the change of what is stored, the second the power of a weight that
     * changes, as h'·S d = -g'·m with the moment m = Σ_IJ ρ x_I S_IJ d_J.
     */
    template <std::size_t max_nodes>
    ProjectionEnergy
    pressure_projection_energy(const Element<dim, dim + 1, max_nodes> &element,
                               const CellCompliance &compliance,
                               const std::array<Point<dim>, dim + 1> &corners,
                               const Tensor<1, dim> &weight) const;

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

    /** S_e,IJ = α/G V (M_IJ - 1/(d+1)²) of a cell. */
    double
    projection_entry(const CellCompliance &compliance,
                     const unsigned int    I,
                     const unsigned int    J) const
    {
      return ppp_coefficient * compliance.volume *
             ((I == J ? 2. : 1.) / ((dim + 1) * (dim + 2)) -
              1. / ((dim + 1) * (dim + 1)));
    }

  private:
    /** ρ g of a cell (N/m³). */
    static Tensor<1, dim>
    weight_density(const CellCompliance &compliance, const Tensor<1, dim> &g)
    {
      return compliance.mass / compliance.volume * g;
    }

    /** d_I of a cell but for a constant, which doesn't matter. */
    template <std::size_t max_nodes>
    std::array<double, dim + 1>
    pressure_deviation(const Element<dim, dim + 1, max_nodes> &element,
                       const Tensor<1, dim>                   &weight_density,
                       const std::array<Point<dim>, dim + 1>  &corners) const
    {
      std::array<double, dim + 1> d;
      for (unsigned int I = 0; I <= dim; ++I)
        d[I] = element.pressure[I] +
               weight_density * (corners[I] - corners[0] +
                                 element.increment[I] - element.increment[0]);
      return d;
    }
  };
} // namespace isochor

#include <isochor/equations/mixed_kernel.templates.h>
#include <isochor/equations/mixed_kernel_points.templates.h>

#endif
