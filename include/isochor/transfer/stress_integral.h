/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_stress_integral_h
#define isochor_stress_integral_h

#include <isochor/equations/equation_term.h>
#include <isochor/equations/nodal_unknowns.h>

#include <array>

namespace isochor
{
  /**
   * How far the integral of the Cauchy stress over the body, as the quadrature
   * forms it, is from that over the volumes that the material points stand for:
   *
   *   e = |Σ (w_p - V_p) J_p σ_p| / Σ V_p J_p |σ_p|,
   *
   * w_p the volume of integration and V_p the reference volume of a point. In
   * equilibrium the integral of the stress is that of the surface's forces t
   * times their places, ∫ σ dv = ∫ t ⊗ x da (Signorini's theorem of the mean
   * stress). A homogeneous body between plates therefore presses by e too much
   * or too little, whatever its law.
   */
  template <int dim>
  class StressIntegral
  {
  public:
    /** Add a material point: its @p stress (Pa) and determinant @p J at the end
     * of the step, its @p volume and volume of integration, @p weight, at t = 0
     * (m^dim; in axisymmetry m^3). */
    void
    add(const SymmetricTensor<2, 3> &stress,
        const double                 J,
        const double                 volume,
        const double                 weight);

    /** Add the massless points of @p step, which integrate where no material
     * point lies. */
    void
    add_massless_points(const StepContext<dim>   &step,
                        const NodalUnknowns<dim> &nodal);

    /** To be called in statics, where the integral is one of forces: warn if
     * it is off by more than one per cent, where the stress has one direction
     * in most of the body, as if it is pressed: where tension and pressure
     * balance, as in bending, the measure says nothing. Collective. */
    void
    check(const StepContext<dim> &step) const;

  private:
    SymmetricTensor<2, 3> difference; ///< Σ (w - V) J σ
    SymmetricTensor<2, 3> integral;   ///< Σ V J σ
    double                norm   = 0; ///< Σ V J |σ|
    double                volume = 0; ///< Σ V J
  };
} // namespace isochor

#endif
