/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/material_model/isochoric_elasticity.h>
#include <isochor/material_model/material_model.h>
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

    /** What the return map starts from. */
    struct TrialState
    {
      double                   mu_bar;     ///< G tr(b̄^e_trial) / 3
      double                   norm;       ///< |dev τ_trial|
      SymmetricComponents<dim> dev_stress; ///< dev τ_trial
      double                   alpha;      ///< α_n
    };

    /** σ_y(α), in Pa. */
    double
    current_yield_stress(const double alpha) const;

    /** dσ_y/dα, in Pa. */
    double
    current_hardening(const double alpha) const;

    /** Solve f = 0 for Δγ = γ Δt. NaN if it is not found. */
    double
    solve_consistency_condition(const TrialState &trial) const;

    ModulusComponents<dim>
    plastic_modulus(const TrialState &trial, const double delta_gamma) const;
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
  inline double
  J2Plasticity<dim>::current_yield_stress(const double alpha) const
  {
    double stress = yield_stress + hardening_modulus * alpha;
    if (saturation_exponent > 0)
      stress -= (saturation_stress - yield_stress) *
                std::expm1(-saturation_exponent * alpha);
    return stress;
  }



  template <int dim>
  inline double
  J2Plasticity<dim>::current_hardening(const double alpha) const
  {
    double hardening = hardening_modulus;
    if (saturation_exponent > 0)
      hardening += saturation_exponent * (saturation_stress - yield_stress) *
                   std::exp(-saturation_exponent * alpha);
    return hardening;
  }



  template <int dim>
  inline double
  J2Plasticity<dim>::solve_consistency_condition(const TrialState &trial) const
  {
    // f(Δγ) falls and is convex, so that Newton's method from Δγ = 0
    // approaches the root from below without a safeguard. Without Voce's
    // hardening f is linear and the first step exact.
    const bool   linear          = (saturation_exponent == 0);
    const double root_two_thirds = std::sqrt(2. / 3.);
    const double tolerance       = 1e-14 * trial.norm;
    double       delta_gamma     = 0;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const double alpha = trial.alpha + root_two_thirds * delta_gamma;
        const double f     = trial.norm - 2 * trial.mu_bar * delta_gamma -
                         root_two_thirds * current_yield_stress(alpha);
        const double step =
          f / (2 * trial.mu_bar + 2. / 3. * current_hardening(alpha));
        delta_gamma += step;
        if (linear || std::abs(f) <= tolerance ||
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
  inline ModulusComponents<dim>
  J2Plasticity<dim>::plastic_modulus(const TrialState &trial,
                                     const double      delta_gamma) const
  {
    constexpr unsigned int n_components =
      SymmetricTensor<2, dim>::n_independent_components;
    const double mu_bar = trial.mu_bar;
    const double alpha  = trial.alpha + std::sqrt(2. / 3.) * delta_gamma;

    // 1/β0 of Simo & Hughes
    const double slope = 3 * mu_bar / (3 * mu_bar + current_hardening(alpha));
    const double ratio = trial.norm / mu_bar;
    const double inverse_norm = 1 / trial.norm;
    const double beta_1       = 2 * mu_bar * delta_gamma * inverse_norm;
    const double beta_2       = (1 - slope) * 2. / 3. * ratio * delta_gamma;
    const double beta_3       = slope - beta_1 + beta_2;
    const double beta_4       = (slope - beta_1) * ratio;

    const SymmetricComponents<dim> n = inverse_norm * trial.dev_stress;
    const SymmetricComponents<dim> m =
      2 * mu_bar * (beta_3 * n + beta_4 * n.square().deviator());

    ModulusComponents<dim> modulus =
      isochoric_modulus((1 - beta_1) * mu_bar, (1 - beta_1) * trial.dev_stress);
    unrolled<n_components>([&](const auto i) {
      unrolled<n_components>([&](const auto j) {
        const double n_m = n.in_plane(i) * m.in_plane(j),
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
  StressStatus
  J2Plasticity<dim>::evaluate(const Kinematics<dim> &kinematics,
                              const double          *history_n,
                              double                *history,
                              StressResponse<dim>   &response) const
  {
    constexpr unsigned int alpha_index = n_symmetric_components<dim>;
    const double           G           = elasticity.shear_modulus;

    const SymmetricComponents<dim> b_bar =
      kinematics.isochoric_scale *
      push_forward(kinematics.F_increment, history_n);

    TrialState trial;
    trial.mu_bar     = G * (1. / 3.) * b_bar.trace();
    trial.dev_stress = G * b_bar.deviator();
    trial.norm       = std::sqrt(trial.dev_stress.norm_square());
    trial.alpha      = history_n[alpha_index];

    set_elastic_volume_change(kinematics.J, response);
    const double radius =
      std::sqrt(2. / 3.) * current_yield_stress(trial.alpha);
    double delta_gamma = 0;
    // The margin keeps a point that rests on the surface elastic.
    if (trial.norm <= radius * (1 + 1e-12))
      {
        trial.dev_stress.copy_to(response.deviatoric_stress);
        if (kinematics.with_tangent)
          copy_modulus<dim>(isochoric_modulus(trial.mu_bar, trial.dev_stress),
                            response.tangent);
        if (kinematics.with_history)
          {
            b_bar.store(history);
            history[alpha_index] = trial.alpha;
          }
      }
    else
      {
        delta_gamma        = solve_consistency_condition(trial);
        const double alpha = trial.alpha + std::sqrt(2. / 3.) * delta_gamma;
        const SymmetricComponents<dim> dev_stress =
          (std::sqrt(2. / 3.) * current_yield_stress(alpha) / trial.norm) *
          trial.dev_stress;
        dev_stress.copy_to(response.deviatoric_stress);
        if (kinematics.with_tangent)
          copy_modulus<dim>(plastic_modulus(trial, delta_gamma),
                            response.tangent);

        if (kinematics.with_history)
          {
            // Simo keeps tr b̄^e over the return, and det b̄^e drifts from 1. The
            // stress of this step doesn't depend on it; that of the next one
            // does.
            const SymmetricComponents<dim> q = (1 / G) * dev_stress;
            (q + unimodular_mean(q, b_bar.trace() / 3)).store(history);
            history[alpha_index] = alpha;
          }
      }
    // what isn't finite in F or in the history shows in one of these
    return std::isfinite(trial.norm + trial.alpha + delta_gamma +
                         kinematics.J) ?
             StressStatus::success :
             StressStatus::return_map_failed;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, J2Plasticity, "J2")
} // namespace isochor
