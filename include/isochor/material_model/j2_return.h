/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_j2_return_h
#define isochor_j2_return_h

#include <isochor/material_model/isochoric_elasticity.h>
#include <isochor/material_model/point_pack.h>
#include <isochor/material_model/tensor_tools.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace isochor
{
  /** The radial return of J2 plasticity and its linearisation: the formulas
   * and their source are at J2Plasticity. */
  template <int dim>
  class J2Return
  {
  public:
    double shear_modulus       = 0; ///< G, Pa
    double yield_stress        = 0; ///< σ_Y, Pa
    double hardening_modulus   = 0; ///< H, Pa
    double saturation_stress   = 0; ///< σ_∞, Pa
    double saturation_exponent = 0; ///< δ; 0 for no saturation
    bool   symmetrize_tangent  = false;

    // Number is double, or PointPack for several points at once.

    /** Where the return map ends. */
    template <typename Number>
    struct FinalState
    {
      SymmetricComponents<dim, Number> dev_stress;
      ModulusComponents<dim, Number>   modulus; ///< if asked for
      Number                           alpha;
      /** The sum of what isn't finite if the deformation or the history
       * isn't. */
      Number of_all;
    };

    /** From b̄^e_trial and α_n. */
    template <typename Number>
    FinalState<Number>
    return_map(const SymmetricComponents<dim, Number> &b_bar,
               const Number                           &alpha_n,
               const bool                              with_tangent) const;

  private:
    /** What the return map starts from. */
    template <typename Number>
    struct TrialState
    {
      Number                           mu_bar;     ///< G tr(b̄^e_trial) / 3
      Number                           norm;       ///< |dev τ_trial|
      SymmetricComponents<dim, Number> dev_stress; ///< dev τ_trial
      Number                           alpha;      ///< α_n
    };

    /** σ_y(α), in Pa. */
    template <typename Number>
    Number
    current_yield_stress(const Number &alpha) const;

    /** dσ_y/dα, in Pa. */
    template <typename Number>
    Number
    current_hardening(const Number &alpha) const;

    /** Solve f = 0 for Δγ = γ Δt. NaN if it is not found. */
    template <typename Number>
    Number
    solve_consistency_condition(const TrialState<Number> &trial) const;

    template <typename Number>
    ModulusComponents<dim, Number>
    plastic_modulus(const TrialState<Number> &trial,
                    const Number             &delta_gamma) const;
  };



  template <int dim>
  template <typename Number>
  inline Number
  J2Return<dim>::current_yield_stress(const Number &alpha) const
  {
    Number stress = yield_stress + hardening_modulus * alpha;
    if constexpr (std::is_same_v<Number, double>)
      if (saturation_exponent > 0)
        stress -= (saturation_stress - yield_stress) *
                  std::expm1(-saturation_exponent * alpha);
    return stress;
  }



  template <int dim>
  template <typename Number>
  inline Number
  J2Return<dim>::current_hardening(const Number &alpha) const
  {
    Number hardening = hardening_modulus;
    if constexpr (std::is_same_v<Number, double>)
      if (saturation_exponent > 0)
        hardening += saturation_exponent * (saturation_stress - yield_stress) *
                     std::exp(-saturation_exponent * alpha);
    return hardening;
  }



  template <int dim>
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE Number
  J2Return<dim>::solve_consistency_condition(
    const TrialState<Number> &trial) const
  {
    // f(Δγ) falls and is convex, so that Newton's method from Δγ = 0
    // approaches the root from below without a safeguard. Without Voce's
    // hardening f is linear and the first step exact.
    const double root_two_thirds = std::sqrt(2. / 3.);
    Number       delta_gamma     = 0.;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const Number alpha = trial.alpha + root_two_thirds * delta_gamma;
        const Number f     = trial.norm - 2. * trial.mu_bar * delta_gamma -
                         root_two_thirds * current_yield_stress(alpha);
        const Number step =
          f / (2. * trial.mu_bar + 2. / 3. * current_hardening(alpha));
        delta_gamma += step;
        if (saturation_exponent == 0)
          return delta_gamma;
        if constexpr (std::is_same_v<Number, double>)
          if (std::abs(f) <= 1e-14 * trial.norm ||
              std::abs(step) <= 1e-15 * delta_gamma)
            return delta_gamma;
      }
    return std::numeric_limits<double>::quiet_NaN();
  }



  /**
   * The exact linearisation of the radial return. With n = dev τ_trial /
   * |dev τ_trial| and the trial modulus C_trial of isochoric_modulus(),
   *   (1 - β1) C_trial - 2 μ̄ β3 n ⊗ n - 2 μ̄ β4 n ⊗ dev(n²).
   * Simo & Hughes (1998, Box 9.2) symmetrise the last term. Left as it comes
   * out of δ|dev τ_trial| = (2 μ̄ n + 2 |dev τ_trial| dev(n²)) : d it is not
   * symmetric, its size relative to 2 μ̄ is that of elastic strain.
   */
  template <int dim>
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE ModulusComponents<dim, Number>
  J2Return<dim>::plastic_modulus(const TrialState<Number> &trial,
                                 const Number             &delta_gamma) const
  {
    constexpr unsigned int n_components =
      SymmetricTensor<2, dim>::n_independent_components;
    const Number mu_bar = trial.mu_bar;
    const Number alpha  = trial.alpha + std::sqrt(2. / 3.) * delta_gamma;

    // 1/β0 of Simo & Hughes; points of a pack that are elastic have no β
    const Number slope =
      where_greater(delta_gamma,
                    Number(0.),
                    3. * mu_bar / (3. * mu_bar + current_hardening(alpha)),
                    Number(0.));
    const Number ratio        = trial.norm / mu_bar;
    const Number inverse_norm = 1. / trial.norm;
    const Number beta_1       = 2. * mu_bar * delta_gamma * inverse_norm;
    const Number beta_2       = (1. - slope) * 2. / 3. * ratio * delta_gamma;
    const Number beta_3       = slope - beta_1 + beta_2;
    const Number beta_4       = (slope - beta_1) * ratio;

    const SymmetricComponents<dim, Number> n = inverse_norm * trial.dev_stress;
    const SymmetricComponents<dim, Number> m =
      2. * mu_bar * (beta_3 * n + beta_4 * n.square().deviator());

    ModulusComponents<dim, Number> modulus =
      isochoric_modulus((1. - beta_1) * mu_bar,
                        (1. - beta_1) * trial.dev_stress);
    unrolled<n_components>([&](const auto i) {
      unrolled<n_components>([&](const auto j) {
        const Number n_m = n.in_plane(i) * m.in_plane(j),
                     m_n = m.in_plane(i) * n.in_plane(j);
        modulus[i * n_components + j] -=
          symmetrize_tangent ? 0.5 * (n_m + m_n) : n_m;
      });
    });
    return modulus;
  }



  template <int dim>
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE
    typename J2Return<dim>::template FinalState<Number>
    J2Return<dim>::return_map(const SymmetricComponents<dim, Number> &b_bar,
                              const Number                           &alpha_n,
                              const bool with_tangent) const
  {
    const double       G               = shear_modulus;
    const double       root_two_thirds = std::sqrt(2. / 3.);
    TrialState<Number> trial;
    trial.mu_bar     = G * (1. / 3.) * b_bar.trace();
    trial.dev_stress = G * b_bar.deviator();
    using std::sqrt;
    trial.norm  = sqrt(trial.dev_stress.norm_square());
    trial.alpha = alpha_n;

    FinalState<Number> state;
    // The margin keeps a point that rests on the surface elastic.
    const Number limit =
      root_two_thirds * current_yield_stress(alpha_n) * (1 + 1e-12);
    if (!is_greater_anywhere(trial.norm, limit))
      {
        state.dev_stress = trial.dev_stress;
        state.alpha      = alpha_n;
        state.of_all     = trial.norm + alpha_n;
        if (with_tangent)
          state.modulus = isochoric_modulus(trial.mu_bar, trial.dev_stress);
        return state;
      }

    // points of a pack that are elastic beside plastic ones have Δγ = 0
    const Number delta_gamma = where_greater(trial.norm,
                                             limit,
                                             solve_consistency_condition(trial),
                                             Number(0.));
    state.alpha              = alpha_n + root_two_thirds * delta_gamma;
    state.of_all             = trial.norm + state.alpha;
    const Number scale =
      where_greater(trial.norm,
                    limit,
                    root_two_thirds * current_yield_stress(state.alpha) /
                      trial.norm,
                    Number(1.));
    state.dev_stress = scale * trial.dev_stress;
    if (with_tangent)
      {
        trial.norm    = where_greater(trial.norm, limit, trial.norm, limit);
        state.modulus = plastic_modulus(trial, delta_gamma);
      }
    return state;
  }
} // namespace isochor

#endif
