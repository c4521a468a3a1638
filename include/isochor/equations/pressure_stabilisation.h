/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_pressure_stabilisation_h
#define isochor_pressure_stabilisation_h

#include <isochor/equations/element.h>

#include <array>
#include <type_traits>

namespace isochor
{
  /** What keeps the pressures of P1 displacements and pressures from
   * oscillating: projected cell by cell here, or OrthogonalSubscales with the
   * same coefficients. */
  template <int dim>
  class PressureStabilisation
  {
  public:
    /** α of the Polynomial Pressure Projection (Dohrmann & Bochev 2004), P(26);
     * 0 for none. */
    double coefficient = 0;

    /** Whether it is that of OrthogonalSubscales. */
    bool has_orthogonal_subscales = false;

    /** Whether it is PPP, cell by cell. */
    bool
    projects_pressures() const
    {
      return coefficient > 0 && !has_orthogonal_subscales;
    }

    /** Gravity in statics (m/s²): the stabilisation leaves out the pressure
     * that is in equilibrium with it. Zero: as it stands in the paper. */
    Tensor<1, dim> hydrostatic_acceleration;

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
     * the pressure's part of @p element is changed. @p upper_blocks_only: see
     * MixedKernel.
     */
    template <std::size_t max_nodes>
    void
    add_projection(Element<dim, dim + 1, max_nodes>      &element,
                   const CellCompliance                  &compliance,
                   const std::array<Point<dim>, dim + 1> &corners,
                   const bool                             with_matrix,
                   const bool upper_blocks_only) const;

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
    projection_energy(const Element<dim, dim + 1, max_nodes> &element,
                      const CellCompliance                   &compliance,
                      const std::array<Point<dim>, dim + 1>  &corners,
                      const Tensor<1, dim>                   &weight) const;

    /** S_e,IJ = α/G V (M_IJ - 1/(d+1)²) of a cell. */
    double
    projection_entry(const CellCompliance &compliance,
                     const unsigned int    I,
                     const unsigned int    J) const
    {
      return coefficient * compliance.volume *
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



  template <int dim>
  template <std::size_t max_nodes>
  void
  PressureStabilisation<dim>::add_projection(
    Element<dim, dim + 1, max_nodes>      &element,
    const CellCompliance                  &compliance,
    const std::array<Point<dim>, dim + 1> &corners,
    const bool                             with_matrix,
    const bool                             upper_blocks_only) const
  {
    Assert(compliance.volume > 0, ExcMessage("No points are in the cell."));
    constexpr unsigned int nc     = dim + 1;
    const unsigned int     n_dofs = element.n_dofs();
    const Tensor<1, dim>   weight =
      weight_density(compliance, hydrostatic_acceleration);
    // derivatives of d_I: 1 by p_I, ρ g by the displacement
    std::array<double, nc> derivative;
    for (unsigned int a = 0; a < dim; ++a)
      derivative[a] = weight[a];
    derivative[dim]      = 1;
    const auto deviation = pressure_deviation(element, weight, corners);
    const auto add       = [&](const auto first) {
      for (unsigned int I = 0; I <= dim; ++I)
        for (unsigned int J = 0; J <= dim; ++J)
          {
            const double entry = projection_entry(compliance, I, J);
            for (unsigned int a = first; a < nc; ++a)
              element.residual[I * nc + a] -=
                derivative[a] * entry * deviation[J];
            if (!with_matrix || (upper_blocks_only && J < I))
              continue;
            for (unsigned int a = first; a < nc; ++a)
              for (unsigned int b = first; b < nc; ++b)
                element.matrix[(I * nc + a) * n_dofs + J * nc + b] -=
                  derivative[a] * entry * derivative[b];
          }
    };
    if (weight.norm_square() > 0)
      add(std::integral_constant<unsigned int, 0>());
    else
      add(std::integral_constant<unsigned int, dim>());
  }



  template <int dim>
  template <std::size_t max_nodes>
  typename PressureStabilisation<dim>::ProjectionEnergy
  PressureStabilisation<dim>::projection_energy(
    const Element<dim, dim + 1, max_nodes> &element,
    const CellCompliance                   &compliance,
    const std::array<Point<dim>, dim + 1>  &corners,
    const Tensor<1, dim>                   &weight) const
  {
    const double density = compliance.mass / compliance.volume;
    const auto   deviation =
      pressure_deviation(element, weight_density(compliance, weight), corners);
    ProjectionEnergy energy;
    for (unsigned int I = 0; I <= dim; ++I)
      {
        double volume = 0; // of the stabilisation, at node I
        for (unsigned int J = 0; J <= dim; ++J)
          volume += projection_entry(compliance, I, J) * deviation[J];
        // p + h = 2 p - d
        energy.stored += (element.pressure[I] - deviation[I] / 2) * volume;
        energy.moment += density * volume *
                         (corners[I] - corners[0] + element.increment[I] -
                          element.increment[0]);
      }
    return energy;
  }
} // namespace isochor

#endif
