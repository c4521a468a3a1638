/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/plain_message.h>
#include <isochor/material_model/isochoric_elasticity.h>
#include <isochor/material_model/j2_return.h>
#include <isochor/material_model/logarithmic_strain.h>
#include <isochor/material_model/material_model.h>
#include <isochor/material_model/pack_response.h>
#include <isochor/material_model/tensor_tools.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * J2 plasticity with the multiplicative split F = F^e F^p in principal
   * elastic logarithmic strains (Simo 1992; Perić, Owen & Honnor 1992): the
   * return map is that of small strains, and exact for proportional strains
   * of any size. With b̄^e = ΔF b̄^e_n ΔF^T made isochoric, ε_A = ½ ln b̄^e_A,
   *   dev τ_A = 2 G dev ε_A,
   *   f = √(3/2) |dev τ| - σ_y(α),
   *   σ_y(α) = σ_Y + H α + (σ_∞ - σ_Y) (1 - exp(-δ α)),
   *   √(3/2) |dev τ_trial| - 3 G Δα = σ_y(α_n + Δα).
   * Flow is isochoric, p and θ^e are those of NeoHookean.
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

    bool
    dissipates() const override
    {
      return true;
    }

    /** In the plane, but for Voce's hardening, whose return map iterates. */
    bool
    evaluates_packs() const override
    {
      return dim == 2 && plasticity.saturation_exponent == 0;
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
      return elasticity.shear_modulus * square_of_shear<dim>(history);
    }

    /** ln b̄^e instead of b̄^e: it stays isochoric, and dev τ, linear in it,
     * within the yield surface of the mean α (σ_y is concave). */
    void
    to_mean_values(double *history) const override
    {
      map_eigenvalues<dim>([](const double b) { return std::log(b); }, history);
    }

    void
    from_mean_values(double *history) const override
    {
      map_eigenvalues<dim>([](const double e) { return std::exp(e); }, history);
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
    J2Return            plasticity;
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
                        "(Kirchhoff stress), in Pa.");
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
    const LogarithmicStrain<dim, double> strain(b_bar);
    const SymmetricComponents<dim>      &e = strain.deviator();
    const auto                           state =
      plasticity.evaluate(e.norm_square(), history_n[alpha_index]);

    set_elastic_volume_change(kinematics.J, response);
    (state.secant * e).copy_to(response.deviatoric_stress);
    if (kinematics.with_tangent)
      copy_modulus<dim>(strain.modulus(state.secant, state.radial),
                        response.tangent);
    if (kinematics.with_history)
      {
        history[alpha_index] = state.alpha;
        strain.left_cauchy_green(state.secant / (2 * elasticity.shear_modulus))
          .store(history);
      }
    return std::isfinite(e.norm_square() + state.alpha + kinematics.J) ?
             StressStatus::success :
             StressStatus::return_map_failed;
  }



  template <int dim>
  StressStatus
  J2Plasticity<dim>::evaluate_pack(
    [[maybe_unused]] const PackKinematics<dim> &kinematics,
    [[maybe_unused]] const std::array<const double *, PointPack::size>
                                       &history_n,
    [[maybe_unused]] PackResponse<dim> &response) const
  {
    if constexpr (dim == 2)
      {
        SymmetricComponents<dim, PointPack> b_n;
        unrolled<b_n.n>([&](const auto i) {
          b_n.entry[i] = PointPack(history_n[0][i], history_n[1][i]);
        });
        const PointPack alpha_n(history_n[0][b_n.n], history_n[1][b_n.n]);
        const LogarithmicStrain<dim, PointPack> strain(
          kinematics.isochoric_scale *
          push_forward_by<dim>(kinematics.F_increment, b_n.entry.data()));
        const auto     &e          = strain.deviator();
        const PointPack e_square   = e.norm_square();
        const auto      state      = plasticity.evaluate(e_square, alpha_n);
        response.deviatoric_stress = state.secant * e;
        if (kinematics.with_tangent)
          response.tangent = strain.modulus(state.secant, state.radial);
        if (std::isfinite(sum(e_square + state.alpha + kinematics.J)))
          return StressStatus::success;
      }
    return StressStatus::return_map_failed;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, J2Plasticity, "J2")
} // namespace isochor
