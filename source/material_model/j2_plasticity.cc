/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/material_model/isochoric_elasticity.h>
#include <isochor/material_model/material_model.h>
#include <isochor/material_model/pack_response.h>
#include <isochor/material_model/tensor_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * Hyperelastic J2 plasticity with the multiplicative split F = F^e F^p
   * (Simo 1988; Simo & Hughes 1998, Boxes 9.1 and 9.2). Elastic law
   * dev τ = G dev b̄^e as in NeoHookean; yield function in Kirchhoff stress
   *   f = |dev τ| - √(2/3) σ_y(α),
   *   σ_y(α) = σ_Y + H α + (σ_∞ - σ_Y) (1 - exp(-δ α)),
   * flow dev[L_v b̄^e] = -2/3 γ tr(b̄^e) n, n = dev τ / |dev τ|, and
   * α̇ = √(2/3) γ, integrated by the radial return. Flow is isochoric.
   *
   * History: the isochoric elastic left Cauchy-Green tensor b̄^e and the
   * equivalent plastic strain α.
   */
  template <int dim>
  class J2Plasticity : public MaterialModel<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);

    void
    parse_parameters(ParameterHandler &prm) override;

    StressStatus
    evaluate(const Kinematics<dim> &kinematics,
             const double          *history_n,
             double                *history,
             StressResponse<dim>   &response) const override;

    /** But for Voce's hardening, whose return map iterates. */
    bool
    evaluates_packs() const override
    {
      return saturation_exponent == 0;
    }

    StressStatus
    evaluate_pack(const PackKinematics<dim>                         &kinematics,
                  const std::array<const double *, PointPack::size> &history_n,
                  PackResponse<dim> &response) const override;

    std::vector<std::string>
    history_names() const override;

    void
    initialize_history(double *history) const override
    {
      store_symmetric<dim>(unit_symmetric_tensor<3>(), history);
      history[n_symmetric_components<dim>] = 0;
    }

    double
    deviatoric_energy(const Tensor<2, dim> & /*F*/,
                      const double *history) const override
    {
      return elasticity.shear_modulus / 2 *
             (trace(load_symmetric<dim>(history)) - 3);
    }

    /** The exact linearisation holds a term n ⊗ dev(n²): see
     * plastic_modulus(). */
    bool
    has_symmetric_tangent() const override
    {
      return symmetrize_tangent;
    }

    double
    shear_modulus() const override
    {
      return elasticity.shear_modulus;
    }

    double
    inverse_bulk_modulus() const override
    {
      return elasticity.inverse_bulk_modulus;
    }

    double
    density() const override
    {
      return elasticity.density;
    }

    std::string
    doubts() const override
    {
      return doubtful_strength("J2/Yield stress", yield_stress, elasticity);
    }

  private:
    IsotropicElasticity elasticity;
    double              yield_stress        = 0;
    double              hardening_modulus   = 0;
    double              saturation_stress   = 0;
    double              saturation_exponent = 0;
    bool                symmetrize_tangent  = false;

    // Number is double, or PointPack for several points at once.

    /** What the return map starts from. */
    template <typename Number>
    struct TrialState
    {
      Number                           mu_bar;     ///< G tr(b̄^e_trial) / 3
      Number                           norm;       ///< |dev τ_trial|
      SymmetricComponents<dim, Number> dev_stress; ///< dev τ_trial
      Number                           alpha;      ///< α_n
    };

    /** And where it ends. */
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
  void
  J2Plasticity<dim>::declare_parameters(ParameterHandler &prm)
  {
    IsotropicElasticity::declare_parameters(prm);
    prm.enter_subsection("J2");
    {
      prm.declare_entry("Yield stress",
                        "1e4",
                        Patterns::Double(),
                        "Initial yield stress sigma_Y > 0 in uniaxial tension "
                        "(Kirchhoff stress), in Pa. From a tenth of the shear "
                        "modulus on the law differs from those in logarithmic "
                        "strains by 2 % and more (doc/materials.md).");
      prm.declare_entry("Hardening modulus",
                        "0",
                        Patterns::Double(),
                        "Linear isotropic hardening modulus H >= 0, in Pa.");
      prm.declare_entry("Saturation stress",
                        "0",
                        Patterns::Double(),
                        "Voce hardening: the stress sigma_inf >= sigma_Y that "
                        "the yield stress tends to, in Pa. Unused while "
                        "<Saturation exponent> is 0.");
      prm.declare_entry("Saturation exponent",
                        "0",
                        Patterns::Double(),
                        "Voce hardening: the rate delta >= 0 of saturation "
                        "with equivalent plastic strain. 0 switches it off.");
      prm.declare_entry("Symmetrize tangent",
                        "auto",
                        Patterns::Selection("auto|true|false"),
                        "Replace the tangent by its symmetric part, so that a "
                        "symmetric solver can be used, whose factorisation "
                        "costs a quarter less. Stresses are not affected; "
                        "Newton's method then converges linearly, with a rate "
                        "of the order of sigma_Y/G. auto: where that is at "
                        "most 0.02, as with most metals, also with the stress "
                        "after a plastic strain of one.");
    }
    prm.leave_subsection();
  }



  template <int dim>
  void
  J2Plasticity<dim>::parse_parameters(ParameterHandler &prm)
  {
    elasticity.parse_parameters(prm);
    prm.enter_subsection("J2");
    {
      yield_stress                  = prm.get_double("Yield stress");
      hardening_modulus             = prm.get_double("Hardening modulus");
      saturation_stress             = prm.get_double("Saturation stress");
      saturation_exponent           = prm.get_double("Saturation exponent");
      constexpr double  little      = 0.02;
      const double      last_stress = std::max(yield_stress, saturation_stress);
      const std::string symmetrize  = prm.get("Symmetrize tangent");
      symmetrize_tangent =
        symmetrize == "true" ||
        (symmetrize == "auto" &&
         last_stress + hardening_modulus <= little * elasticity.shear_modulus);
    }
    prm.leave_subsection();

    AssertThrow(yield_stress > 0,
                ExcMessage("<J2/Yield stress> must be positive, not " +
                           std::to_string(yield_stress) + "."));
    AssertThrow(hardening_modulus >= 0,
                ExcMessage("<J2/Hardening modulus> must not be negative, but "
                           "is " +
                           std::to_string(hardening_modulus) + "."));
    AssertThrow(saturation_exponent >= 0,
                ExcMessage("<J2/Saturation exponent> must not be negative, "
                           "but is " +
                           std::to_string(saturation_exponent) + "."));
    AssertThrow(saturation_exponent == 0 || saturation_stress >= yield_stress,
                ExcMessage("<J2/Saturation stress> must be at least the yield "
                           "stress " +
                           std::to_string(yield_stress) +
                           " where <J2/Saturation exponent> is positive, but "
                           "is " +
                           std::to_string(saturation_stress) + "."));
  }



  template <int dim>
  std::vector<std::string>
  J2Plasticity<dim>::history_names() const
  {
    std::vector<std::string> names;
    for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
      names.push_back("isochoric_elastic_left_cauchy_green_" +
                      symmetric_component_name(i));
    names.push_back("equivalent_plastic_strain");
    return names;
  }



  template <int dim>
  template <typename Number>
  inline Number
  J2Plasticity<dim>::current_yield_stress(const Number &alpha) const
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
  J2Plasticity<dim>::current_hardening(const Number &alpha) const
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
  J2Plasticity<dim>::solve_consistency_condition(
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
  J2Plasticity<dim>::plastic_modulus(const TrialState<Number> &trial,
                                     const Number &delta_gamma) const
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



  /**
   * The spherical part I of b̄^e = q + I 1 for a given deviator q, such that
   * det b̄^e = 1: the largest root of I³ - |q|²/2 I + det q - 1 = 0. It is not
   * above @p upper_bound, the value before a radial reduction of q, from where
   * Newton's method falls onto it monotonically.
   */
  template <int dim>
  static double
  unimodular_mean(const SymmetricComponents<dim> &q, const double upper_bound)
  {
    const double half_q_q = 0.5 * q.norm_square();
    const double constant = q.determinant() - 1;
    double       mean     = upper_bound;
    for (unsigned int iteration = 0; iteration < 50; ++iteration)
      {
        const double step = ((mean * mean - half_q_q) * mean + constant) /
                            (3 * mean * mean - half_q_q);
        mean -= step;
        // each error is about the square of the one before
        if (std::abs(step) <= 1e-9 * mean)
          break;
      }
    return mean;
  }



  template <int dim>
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE
    typename J2Plasticity<dim>::template FinalState<Number>
    J2Plasticity<dim>::return_map(const SymmetricComponents<dim, Number> &b_bar,
                                  const Number &alpha_n,
                                  const bool    with_tangent) const
  {
    const double       G               = elasticity.shear_modulus;
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



  template <int dim>
  StressStatus
  J2Plasticity<dim>::evaluate(const Kinematics<dim> &kinematics,
                              const double          *history_n,
                              double                *history,
                              StressResponse<dim>   &response) const
  {
    constexpr unsigned int alpha_index = n_symmetric_components<dim>;

    const SymmetricComponents<dim> b_bar =
      kinematics.isochoric_scale *
      push_forward(kinematics.F_increment, history_n);
    const FinalState<double> state =
      return_map(b_bar, history_n[alpha_index], kinematics.with_tangent);

    set_elastic_volume_change(kinematics.J, response);
    state.dev_stress.copy_to(response.deviatoric_stress);
    if (kinematics.with_tangent)
      copy_modulus<dim>(state.modulus, response.tangent);
    if (kinematics.with_history)
      {
        if (state.alpha == history_n[alpha_index])
          b_bar.store(history);
        else
          {
            // Simo keeps tr b̄^e over the return, and det b̄^e drifts from 1. The
            // stress of this step doesn't depend on it; that of the next one
            // does.
            const SymmetricComponents<dim> q =
              (1 / elasticity.shear_modulus) * state.dev_stress;
            (q + unimodular_mean(q, b_bar.trace() / 3)).store(history);
          }
        history[alpha_index] = state.alpha;
      }
    return std::isfinite(state.of_all + kinematics.J) ?
             StressStatus::success :
             StressStatus::return_map_failed;
  }



  template <int dim>
  StressStatus
  J2Plasticity<dim>::evaluate_pack(
    const PackKinematics<dim>                         &kinematics,
    const std::array<const double *, PointPack::size> &history_n,
    PackResponse<dim>                                 &response) const
  {
    SymmetricComponents<dim, PointPack> b_n;
    unrolled<b_n.n>([&](const auto i) {
      b_n.entry[i] = PointPack(history_n[0][i], history_n[1][i]);
    });
    const PointPack alpha_n(history_n[0][b_n.n], history_n[1][b_n.n]);
    const SymmetricComponents<dim, PointPack> b_bar =
      kinematics.isochoric_scale *
      push_forward_by<dim>(kinematics.F_increment, b_n.entry.data());
    const FinalState<PointPack> state =
      return_map(b_bar, alpha_n, kinematics.with_tangent);
    response.deviatoric_stress = state.dev_stress;
    if (kinematics.with_tangent)
      response.tangent = state.modulus;
    return std::isfinite(sum(state.of_all + kinematics.J)) ?
             StressStatus::success :
             StressStatus::return_map_failed;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, J2Plasticity, "J2")
} // namespace isochor
