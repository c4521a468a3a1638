/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/plain_message.h>
#include <isochor/material_model/isochoric_elasticity.h>
#include <isochor/material_model/j2_return.h>
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
      return plasticity.saturation_exponent == 0;
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
     * J2Return::plastic_modulus(). */
    bool
    has_symmetric_tangent() const override
    {
      return plasticity.symmetrize_tangent;
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
      return doubtful_strength("J2/Yield stress",
                               plasticity.yield_stress,
                               elasticity);
    }

    std::string
    describe_strength() const override
    {
      const double last = plasticity.saturation_stress;
      return "yield stress = " + rounded(plasticity.yield_stress) +
             (plasticity.saturation_exponent > 0 ? " to " + rounded(last) :
                                                   "") +
             " Pa";
    }

  private:
    IsotropicElasticity elasticity;
    J2Return<dim>       plasticity;
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
    plasticity.shear_modulus = elasticity.shear_modulus;
    prm.enter_subsection("J2");
    {
      plasticity.yield_stress        = prm.get_double("Yield stress");
      plasticity.hardening_modulus   = prm.get_double("Hardening modulus");
      plasticity.saturation_stress   = prm.get_double("Saturation stress");
      plasticity.saturation_exponent = prm.get_double("Saturation exponent");
      constexpr double little        = 0.02;
      const double     last_stress =
        std::max(plasticity.yield_stress, plasticity.saturation_stress);
      const std::string symmetrize = prm.get("Symmetrize tangent");
      plasticity.symmetrize_tangent =
        symmetrize == "true" ||
        (symmetrize == "auto" && last_stress + plasticity.hardening_modulus <=
                                   little * elasticity.shear_modulus);
    }
    prm.leave_subsection();

    AssertThrow(plasticity.yield_stress > 0,
                ExcMessage("<J2/Yield stress> must be positive, not " +
                           std::to_string(plasticity.yield_stress) + "."));
    AssertThrow(plasticity.hardening_modulus >= 0,
                ExcMessage("<J2/Hardening modulus> must not be negative, but "
                           "is " +
                           std::to_string(plasticity.hardening_modulus) + "."));
    AssertThrow(plasticity.saturation_exponent >= 0,
                ExcMessage("<J2/Saturation exponent> must not be negative, "
                           "but is " +
                           std::to_string(plasticity.saturation_exponent) +
                           "."));
    AssertThrow(plasticity.saturation_exponent == 0 ||
                  plasticity.saturation_stress >= plasticity.yield_stress,
                ExcMessage("<J2/Saturation stress> must be at least the yield "
                           "stress " +
                           std::to_string(plasticity.yield_stress) +
                           " where <J2/Saturation exponent> is positive, but "
                           "is " +
                           std::to_string(plasticity.saturation_stress) + "."));
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

    const SymmetricComponents<dim> b_bar =
      kinematics.isochoric_scale *
      push_forward(kinematics.F_increment, history_n);
    const auto state = plasticity.return_map(b_bar,
                                             history_n[alpha_index],
                                             kinematics.with_tangent);

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
    const auto state =
      plasticity.return_map(b_bar, alpha_n, kinematics.with_tangent);
    response.deviatoric_stress = state.dev_stress;
    if (kinematics.with_tangent)
      response.tangent = state.modulus;
    return std::isfinite(sum(state.of_all + kinematics.J)) ?
             StressStatus::success :
             StressStatus::return_map_failed;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, J2Plasticity, "J2")
} // namespace isochor
