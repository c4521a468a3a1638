/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/plain_message.h>
#include <isochor/material_model/material_model.h>
#include <isochor/material_model/mohr_coulomb_return.h>
#include <isochor/material_model/principal_stress.h>
#include <isochor/material_model/tensor_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * Perfectly plastic Mohr-Coulomb law at finite strain: quadratic Hencky
   * energy in the principal elastic logarithmic strains ε_A, trial state
   * b^e = ΔF b^e_n ΔF^T (Iaconeta et al. 2019, eqs. 33-36), yield function and
   * plastic potential in principal Kirchhoff stress τ_1 >= τ_2 >= τ_3
   *   f = (τ_1 - τ_3) + (τ_1 + τ_3) sin φ - 2 c cos φ,
   *   g = (τ_1 - τ_3) + (τ_1 + τ_3) sin ψ,
   * returned by stress regions (Clausen, Damkilde & Andersen 2006, 2007) and
   * with the consistent tangent. There is no tension cut-off besides the apex.
   * In u the mean stress is returned with the deviator; in u-p, where it is the
   * pressure unknown, the return is made at that mean stress
   * (doc/materials.md).
   *
   * History: the elastic left Cauchy-Green tensor b^e and the equivalent
   * plastic strain Σ √(2/3) |Δε^p| of the logarithmic plastic increments.
   */
  template <int dim>
  class MohrCoulomb : public MaterialModel<dim>
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

    bool
    dissipates() const override
    {
      return true;
    }

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

    /** ln b^e instead of b^e: τ is linear in it, and the elastic domain is
     * convex, so that the mean of admissible states is admissible. */
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

    /** θ^e = ½ ln det b^e. */
    void
    scale_elastic_volume(const double factor, double *history) const override
    {
      for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
        history[i] *= std::pow(factor, 2. / 3);
    }

    VolumetricMeasure
    volumetric_measure() const override
    {
      return VolumetricMeasure::logarithmic;
    }

    bool
    depends_on_pressure() const override
    {
      return surface.sin_phi > 0;
    }

    bool
    is_associated() const override
    {
      return surface.sin_psi == surface.sin_phi;
    }

    /** Symmetric for φ = 0 only. With friction dev τ depends on volume change
     * (u) or on p (u-p). With φ = ψ the tangent of τ and the matrix of u-p
     * would be symmetric, but not beyond the apex, and not the tangent of dev
     * τ. */
    bool
    has_symmetric_tangent() const override
    {
      return surface.sin_phi == 0;
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
    doubts() const override;

    std::string
    describe_strength() const override
    {
      return "cohesion = " + rounded(surface.cohesion()) +
             " Pa, friction angle = " + rounded(surface.friction_angle()) +
             " degrees";
    }

  private:
    IsotropicElasticity elasticity;
    MohrCoulombReturn   surface;

    /** Tensors from principal values. */
    void
    assemble_response(const SpectralDecomposition<dim>  &spectrum,
                      const MohrCoulombReturn::Vector   &strain,
                      const std::array<unsigned int, 3> &rank,
                      const MohrCoulombReturn::Trial    &trial,
                      const MohrCoulombReturn::Response &principal,
                      const bool                         with_tangent,
                      StressResponse<dim>               &response) const;

    /** b^e after plastic flow, and what is added to its measure. */
    void
    update_history(const SpectralDecomposition<dim>  &spectrum,
                   const std::array<unsigned int, 3> &order,
                   const MohrCoulombReturn::Trial    &trial,
                   const MohrCoulombReturn::Response &principal,
                   double                            *history) const;
  };



  template <int dim>
  void
  MohrCoulomb<dim>::declare_parameters(ParameterHandler &prm)
  {
    IsotropicElasticity::declare_parameters(prm);
    prm.enter_subsection("Mohr-Coulomb");
    {
      prm.declare_entry("Cohesion",
                        "1e4",
                        Patterns::Double(),
                        "Cohesion c >= 0, in Pa; the undrained shear strength "
                        "where the friction angle is 0.");
      prm.declare_entry("Friction angle",
                        "0",
                        Patterns::Double(),
                        "Angle of internal friction, 0 <= phi < 90, in "
                        "degrees. 0 is Tresca's criterion.");
      prm.declare_entry("Dilation angle",
                        "0",
                        Patterns::Double(),
                        "Dilation angle, 0 <= psi <= phi, in degrees. Flow is "
                        "associative where it equals the friction angle.");
    }
    prm.leave_subsection();
  }



  template <int dim>
  void
  MohrCoulomb<dim>::parse_parameters(ParameterHandler &prm)
  {
    elasticity.parse_parameters(prm);
    prm.enter_subsection("Mohr-Coulomb");
    surface.set_strength(prm.get_double("Cohesion"),
                         prm.get_double("Friction angle"),
                         prm.get_double("Dilation angle"));
    prm.leave_subsection();
    surface.shear_modulus = elasticity.shear_modulus;
    const double iK       = elasticity.inverse_bulk_modulus;
    surface.bulk_modulus  = surface.sin_phi > 0 && iK > 0 ? 1 / iK : 0.;
  }



  template <int dim>
  std::string
  MohrCoulomb<dim>::doubts() const
  {
    // no soil has so little friction, but it is the angle of one in radians
    constexpr double most_radians = 1.;
    const double     phi = surface.friction_angle(), c = surface.cohesion();
    if (phi > 0 && phi <= most_radians)
      return "<Mohr-Coulomb/Friction angle> is " + rounded(phi) +
             " degrees. Angles are in degrees: if this one is in radians, write " +
             rounded(phi * 180 / numbers::PI) + ".";
    if (phi > 0 && c <= elasticity.shear_modulus)
      return ""; // a small one is as it should be
    return doubtful_strength("Mohr-Coulomb/Cohesion", c, elasticity);
  }



  template <int dim>
  std::vector<std::string>
  MohrCoulomb<dim>::history_names() const
  {
    std::vector<std::string> names;
    for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
      names.push_back("elastic_left_cauchy_green_" +
                      symmetric_component_name(i));
    names.push_back("equivalent_plastic_strain");
    return names;
  }



  /** See PrincipalStress. @p rank: where the stress of eigenvector A stands in
   * descending order. */
  template <int dim>
  void
  MohrCoulomb<dim>::assemble_response(
    const SpectralDecomposition<dim>  &spectrum,
    const MohrCoulombReturn::Vector   &strain,
    const std::array<unsigned int, 3> &rank,
    const MohrCoulombReturn::Trial    &trial,
    const MohrCoulombReturn::Response &principal,
    const bool                         with_tangent,
    StressResponse<dim>               &response) const
  {
    response.volumetric_strain           = principal.theta;
    response.volumetric_pressure_tangent = principal.dtheta_dmean;

    using Components = typename SpectralDecomposition<dim>::Components;
    Components volumetric{}, pressure{};
    for (unsigned int A = 0; A < dim; ++A)
      for (unsigned int i = 0; i < volumetric.size(); ++i)
        {
          const double m_i = spectrum.dyads[A][i];
          volumetric[i] += principal.dtheta_dstrain[rank[A]] * m_i;
          if (surface.sin_phi > 0)
            pressure[i] += principal.ds_dmean[rank[A]] * m_i;
        }
    for (unsigned int i = 0; i < volumetric.size(); ++i)
      {
        response.volumetric_tangent.access_raw_entry(i) = volumetric[i];
        response.deviatoric_pressure_tangent.access_raw_entry(i) = pressure[i];
      }

    PrincipalStress stress;
    stress.strain = strain;
    for (unsigned int A = 0; A < 3; ++A)
      {
        stress.s[A] = principal.s[rank[A]];
        for (unsigned int B = 0; B < 3; ++B)
          stress.ds_dstrain[A][B] = principal.ds_dstrain[rank[A]][rank[B]];
      }
    stress.assemble_stress(spectrum, response.deviatoric_stress);
    if (with_tangent)
      copy_modulus<dim>(stress.modulus(spectrum,
                                       [&](const unsigned int A,
                                           const unsigned int B) {
                                         const auto pair =
                                           std::minmax(rank[A], rank[B]);
                                         return surface.secant(trial,
                                                               principal,
                                                               pair.first,
                                                               pair.second);
                                       }),
                        response.tangent);
  }



  template <int dim>
  void
  MohrCoulomb<dim>::update_history(const SpectralDecomposition<dim>  &spectrum,
                                   const std::array<unsigned int, 3> &order,
                                   const MohrCoulombReturn::Trial    &trial,
                                   const MohrCoulombReturn::Response &principal,
                                   double *history) const
  {
    const double          two_G = 2 * elasticity.shear_modulus;
    std::array<double, 3> b_elastic;
    double                norm_square = 0;
    // The excess is no stress and strains nothing.
    const double theta =
      principal.theta - principal.excess * elasticity.inverse_bulk_modulus;
    for (unsigned int a = 0; a < 3; ++a)
      {
        const double s              = principal.s[a] + principal.excess;
        const double elastic_strain = s / two_G + theta / 3;
        const double plastic_increment =
          (trial.s[a] - s) / two_G + (trial.theta - theta) / 3;
        norm_square += plastic_increment * plastic_increment;
        b_elastic[order[a]] = std::exp(2 * elastic_strain);
      }
    spectrum.store(b_elastic, history);
    history[n_symmetric_components<dim>] += std::sqrt(2. / 3. * norm_square);
  }



  template <int dim>
  StressStatus
  MohrCoulomb<dim>::evaluate(const Kinematics<dim> &kinematics,
                             const double          *history_n,
                             double                *history,
                             StressResponse<dim>   &response) const
  {
    constexpr unsigned int alpha_index = n_symmetric_components<dim>;
    const double           two_G       = 2 * elasticity.shear_modulus;
    const bool at_pressure = depends_on_pressure() && kinematics.pressure;
    // Without p the mean stress is K θ^e.
    if (depends_on_pressure() && !at_pressure && surface.bulk_modulus == 0)
      return StressStatus::return_map_failed;

    const SymmetricComponents<dim> b_trial =
      push_forward(kinematics.F_increment, history_n);
    const auto spectrum = spectral_decomposition(b_trial);

    MohrCoulombReturn::Vector strain;
    for (unsigned int A = 0; A < 3; ++A)
      strain[A] = 0.5 * std::log(spectrum.values[A]);
    const double mean_strain = (strain[0] + strain[1] + strain[2]) / 3;
    // Without friction flow is isochoric: then J itself, which can't drift.
    MohrCoulombReturn::Trial trial;
    trial.theta =
      (surface.sin_phi == 0 ? std::log(kinematics.J) : 3 * mean_strain);
    trial.mean          = surface.bulk_modulus * trial.theta;
    trial.mean_is_given = false;

    const std::array<unsigned int, 3> order =
      MohrCoulombReturn::descending(strain);
    for (unsigned int a = 0; a < 3; ++a)
      trial.s[a] = two_G * (strain[order[a]] - mean_strain);

    const MohrCoulombReturn::Response principal =
      at_pressure ? surface.evaluate_at(trial, *kinematics.pressure) :
                    surface.evaluate(trial);
    std::array<unsigned int, 3> rank;
    for (unsigned int a = 0; a < 3; ++a)
      rank[order[a]] = a;
    assemble_response(spectrum,
                      strain,
                      rank,
                      trial,
                      principal,
                      kinematics.with_tangent,
                      response);

    if (kinematics.with_history)
      {
        history[alpha_index] = history_n[alpha_index];
        if (principal.plastic)
          update_history(spectrum, order, trial, principal, history);
        else
          b_trial.store(history);
      }
    // what isn't finite in F, in p or in the history shows in one of these
    return std::isfinite(principal.s[0] + principal.theta + mean_strain +
                         history_n[alpha_index]) ?
             StressStatus::success :
             StressStatus::return_map_failed;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, MohrCoulomb, "Mohr-Coulomb")
} // namespace isochor
