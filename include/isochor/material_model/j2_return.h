/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_j2_return_h
#define isochor_j2_return_h

#include <isochor/material_model/point_pack.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace isochor
{
  /** The radial return of J2 plasticity in logarithmic strains: the formulas
   * and their source are at J2Plasticity. Number is double, or PointPack for
   * several points at once. */
  struct J2Return
  {
    double shear_modulus       = 0; ///< G, Pa
    double yield_stress        = 0; ///< σ_Y, Pa
    double hardening_modulus   = 0; ///< H, Pa
    double saturation_stress   = 0; ///< σ_∞, Pa
    double saturation_exponent = 0; ///< δ; 0 for no saturation

    /** Where the return map ends, with the deviator e of the trial strain:
     *   dev τ = secant e,  ∂(dev τ)/∂e = secant (1 + radial e ⊗ e). */
    template <typename Number>
    struct FinalState
    {
      Number alpha;  ///< equivalent plastic strain
      Number secant; ///< Pa; 2 G if elastic
      Number radial; ///< 0 if elastic
    };

    /** From e : e and α_n. */
    template <typename Number>
    FinalState<Number>
    evaluate(const Number &e_square, const Number &alpha_n) const;

  private:
    /** σ_y(α), in Pa. */
    template <typename Number>
    Number
    current_yield_stress(const Number &alpha) const;

    /** dσ_y/dα, in Pa. */
    template <typename Number>
    Number
    current_hardening(const Number &alpha) const;

    /** Δα, from √(3/2) |dev τ_trial|. NaN if it is not found. */
    template <typename Number>
    Number
    plastic_increment(const Number &trial, const Number &alpha_n) const;
  };



  template <typename Number>
  inline Number
  J2Return::current_yield_stress(const Number &alpha) const
  {
    Number stress = yield_stress + hardening_modulus * alpha;
    if constexpr (std::is_same_v<Number, double>)
      if (saturation_exponent > 0)
        stress -= (saturation_stress - yield_stress) *
                  std::expm1(-saturation_exponent * alpha);
    return stress;
  }



  template <typename Number>
  inline Number
  J2Return::current_hardening(const Number &alpha) const
  {
    Number hardening = hardening_modulus;
    if constexpr (std::is_same_v<Number, double>)
      if (saturation_exponent > 0)
        hardening += saturation_exponent * (saturation_stress - yield_stress) *
                     std::exp(-saturation_exponent * alpha);
    return hardening;
  }



  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE Number
  J2Return::plastic_increment(const Number &trial, const Number &alpha_n) const
  {
    // f(Δα) falls and is convex, so that Newton's method from 0 approaches the
    // root from below without a safeguard. Without Voce's hardening f is linear
    // and the first step exact.
    Number increment = 0.;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const Number alpha = alpha_n + increment;
        const Number f =
          trial - 3. * shear_modulus * increment - current_yield_stress(alpha);
        const Number step = f / (3. * shear_modulus + current_hardening(alpha));
        increment += step;
        if (saturation_exponent == 0)
          return increment;
        if constexpr (std::is_same_v<Number, double>)
          if (std::abs(f) <= 1e-14 * trial ||
              std::abs(step) <= 1e-15 * increment)
            return increment;
      }
    return std::numeric_limits<double>::quiet_NaN();
  }



  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE J2Return::FinalState<Number>
  J2Return::evaluate(const Number &e_square, const Number &alpha_n) const
  {
    const double       two_G = 2 * shear_modulus;
    FinalState<Number> state{alpha_n, two_G, 0.};
    using std::sqrt;
    const Number trial = std::sqrt(1.5) * two_G * sqrt(e_square);
    // The margin keeps a point that rests on the surface elastic.
    const Number limit = current_yield_stress(alpha_n) * (1 + 1e-12);
    if (!is_greater_anywhere(trial, limit))
      return state;
    const Number alpha     = alpha_n + plastic_increment(trial, alpha_n);
    const Number hardening = current_hardening(alpha);
    // stress and its change over those of the trial state
    const Number ratio = current_yield_stress(alpha) / trial;
    const Number slope = hardening / (3. * shear_modulus + hardening);
    // points of a pack that are elastic beside plastic ones stay as they are
    state.alpha  = where_greater(trial, limit, alpha, alpha_n);
    state.secant = where_greater(trial, limit, two_G * ratio, state.secant);
    state.radial = where_greater(trial,
                                 limit,
                                 (slope / ratio - 1.) / e_square,
                                 state.radial);
    return state;
  }
} // namespace isochor

#endif
