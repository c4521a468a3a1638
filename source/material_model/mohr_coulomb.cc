/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/material_model/material_model.h>
#include <isochor/material_model/mohr_coulomb_return.h>
#include <isochor/material_model/spectral_decomposition.h>
#include <isochor/material_model/tensor_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  namespace
  {
    /** Apply @p function to the eigenvalues of the symmetric tensor stored in
     * @p components. */
    template <int dim, typename Function>
    void
    map_eigenvalues(const Function &function, double *components)
    {
      const SpectralDecomposition spectrum =
        spectral_decomposition<dim>(load_symmetric<dim>(components));
      SymmetricTensor<2, 3> result;
      for (unsigned int A = 0; A < 3; ++A)
        result +=
          function(spectrum.values[A]) *
          symmetrize(outer_product(spectrum.vectors[A], spectrum.vectors[A]));
      store_symmetric<dim>(result, components);
    }
  } // namespace



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
      const auto spectrum =
        spectral_decomposition<dim>(load_symmetric<dim>(history));
      double sum = 0, square = 0; // of ε^e = 1/2 ln b^e
      for (const double value : spectrum.values)
        {
          const double strain = 0.5 * std::log(value);
          sum += strain;
          square += strain * strain;
        }
      return elasticity.shear_modulus * (square - sum * sum / 3);
    }

    void
    rescale_volume(const double factor, double *history) const override
    {
      const double stretch = std::cbrt(factor);
      for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
        history[i] *= stretch * stretch;
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

  private:
    IsotropicElasticity elasticity;
    MohrCoulombReturn   surface;

    /** Tensors from principal values: see the class's documentation. */
    void
    assemble_response(const SpectralDecomposition       &trial,
                      const MohrCoulombReturn::Vector   &strain,
                      const std::array<unsigned int, 3> &order,
                      const MohrCoulombReturn::Response &principal,
                      const bool                         with_tangent,
                      StressResponse<dim>               &response) const;
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
    const double cohesion = prm.get_double("Cohesion");
    const double phi      = prm.get_double("Friction angle");
    const double psi      = prm.get_double("Dilation angle");
    prm.leave_subsection();

    AssertThrow(cohesion >= 0,
                ExcMessage("<Mohr-Coulomb/Cohesion> must not be negative, but "
                           "is " +
                           std::to_string(cohesion) + "."));
    AssertThrow(phi >= 0 && phi < 90,
                ExcMessage("<Mohr-Coulomb/Friction angle> must be at least 0 "
                           "and less than 90 degrees, not " +
                           std::to_string(phi) + "."));
    AssertThrow(psi >= 0 && psi <= phi,
                ExcMessage("<Mohr-Coulomb/Dilation angle> must be at least 0 "
                           "and at most the friction angle of " +
                           std::to_string(phi) + " degrees, not " +
                           std::to_string(psi) + "."));
    AssertThrow(cohesion > 0 || phi > 0,
                ExcMessage("<Mohr-Coulomb/Cohesion> must be positive where "
                           "<Mohr-Coulomb/Friction angle> is 0: the material "
                           "would have no strength."));

    surface.shear_modulus = elasticity.shear_modulus;
    surface.sin_phi       = std::sin(phi * numbers::PI / 180);
    surface.sin_psi       = std::sin(psi * numbers::PI / 180);
    surface.c_cos_phi     = cohesion * std::cos(phi * numbers::PI / 180);
    surface.bulk_modulus  = (phi > 0 && elasticity.inverse_bulk_modulus > 0 ?
                               1 / elasticity.inverse_bulk_modulus :
                               0);
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



  /** The components of sym(v ⊗ w) in the order of the stored ones. */
  static std::array<double, 6>
  dyad(const Tensor<1, 3> &v, const Tensor<1, 3> &w)
  {
    return {{v[0] * w[0],
             v[1] * w[1],
             v[2] * w[2],
             0.5 * (v[0] * w[1] + v[1] * w[0]),
             0.5 * (v[0] * w[2] + v[2] * w[0]),
             0.5 * (v[1] * w[2] + v[2] * w[1])}};
  }



  /**
   * τ = Σ_A τ_A(ε) n_A ⊗ n_A with the eigenvectors n_A of the trial b^e. Its
   * Lie derivative is (Simo 1992; Bonet & Wood 2008, section 6.6)
   *   Σ_AB (∂τ_A/∂ε_B - 2 τ_A δ_AB) m_A ⊗ m_B + Σ_{A<B} 4 g_AB N_AB ⊗ N_AB,
   * m_A = n_A ⊗ n_A, N_AB = sym(n_A ⊗ n_B), and
   *   g_AB = (τ_A b_B - τ_B b_A) / (b_A - b_B)
   *        = (τ_A - τ_B)/x · (x coth x)/2 - (τ_A + τ_B)/2,  x = ε_A - ε_B,
   * the second form being regular at x = 0. Applied to dev τ.
   */
  template <int dim>
  void
  MohrCoulomb<dim>::assemble_response(
    const SpectralDecomposition       &trial,
    const MohrCoulombReturn::Vector   &strain,
    const std::array<unsigned int, 3> &order,
    const MohrCoulombReturn::Response &principal,
    const bool                         with_tangent,
    StressResponse<dim>               &response) const
  {
    constexpr unsigned int n =
      SymmetricTensor<2, dim>::n_independent_components;

    response.volumetric_strain           = principal.theta;
    response.volumetric_pressure_tangent = principal.dtheta_dmean;

    // Components one by one: tensors that are written by numbers and read as
    // vectors right afterwards made this function three times slower.
    std::array<std::array<double, 6>, 3> m;
    std::array<double, 6>                stress{};
    for (unsigned int a = 0; a < 3; ++a)
      {
        m[a] = dyad(trial.vectors[order[a]], trial.vectors[order[a]]);
        for (unsigned int i = 0; i < 6; ++i)
          stress[i] += principal.s[a] * m[a][i];
      }
    for (unsigned int i = 0; i < 6; ++i)
      response.deviatoric_stress.access_raw_entry(i) = stress[i];
    for (unsigned int i = 0; i < n; ++i)
      {
        double volumetric = 0, pressure = 0;
        for (unsigned int a = 0; a < 3; ++a)
          {
            const double m_ai = m[a][component_in_3d<dim>(i)];
            volumetric += principal.dtheta_dstrain[a] * m_ai;
            pressure += principal.ds_dmean[a] * m_ai;
          }
        response.volumetric_tangent.access_raw_entry(i)          = volumetric;
        response.deviatoric_pressure_tangent.access_raw_entry(i) = pressure;
      }
    if (!with_tangent)
      return;

    std::array<double, n * n> tangent{};
    for (unsigned int a = 0; a < 3; ++a)
      {
        // The z-direction of plane strain shears and stretches nothing.
        if (order[a] >= dim)
          continue;
        // Row a of the first sum, in one piece.
        std::array<double, n> row{};
        for (unsigned int b = 0; b < 3; ++b)
          if (order[b] < dim)
            for (unsigned int j = 0; j < n; ++j)
              row[j] += (principal.ds_dstrain[a][b] -
                         (a == b ? 2 * principal.s[a] : 0.)) *
                        m[b][component_in_3d<dim>(j)];
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            tangent[i * n + j] += m[a][component_in_3d<dim>(i)] * row[j];

        for (unsigned int b = a + 1; b < 3; ++b)
          {
            if (order[b] >= dim)
              continue;
            const double x = strain[order[a]] - strain[order[b]];
            const double x_coth_x =
              (std::abs(x) < 1e-4 ? 1 + x * x / 3 : x / std::tanh(x));
            const double g = 0.5 * (principal.secant[a][b] * x_coth_x -
                                    principal.s[a] - principal.s[b]);
            const std::array<double, 6> N =
              dyad(trial.vectors[order[a]], trial.vectors[order[b]]);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                tangent[i * n + j] += 4 * g * N[component_in_3d<dim>(i)] *
                                      N[component_in_3d<dim>(j)];
          }
      }
    for (unsigned int i = 0; i < n * n; ++i)
      response.tangent.access_raw_entry(i) = tangent[i];
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

    const SymmetricTensor<2, 3> b_trial =
      push_forward(kinematics.F_increment, load_symmetric<dim>(history_n));
    const SpectralDecomposition spectrum = spectral_decomposition<dim>(b_trial);

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

    std::array<unsigned int, 3> order = {{0, 1, 2}};
    const auto sort_pair = [&](const unsigned int i, const unsigned int j) {
      if (strain[order[i]] < strain[order[j]])
        std::swap(order[i], order[j]);
    };
    sort_pair(0, 1);
    sort_pair(1, 2);
    sort_pair(0, 1);

    for (unsigned int a = 0; a < 3; ++a)
      trial.s[a] = two_G * (strain[order[a]] - mean_strain);

    const MohrCoulombReturn::Response principal =
      at_pressure ? surface.evaluate_at(trial, *kinematics.pressure) :
                    surface.evaluate(trial);
    assemble_response(
      spectrum, strain, order, principal, kinematics.with_tangent, response);

    history[alpha_index] = history_n[alpha_index];
    if (!principal.plastic)
      store_symmetric<dim>(b_trial, history);
    else
      {
        SymmetricTensor<2, 3> b_elastic;
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

            const Tensor<1, 3> &n = spectrum.vectors[order[a]];
            b_elastic +=
              std::exp(2 * elastic_strain) * symmetrize(outer_product(n, n));
          }
        store_symmetric<dim>(b_elastic, history);
        history[alpha_index] += std::sqrt(2. / 3. * norm_square);
      }
    return is_finite(response) && std::isfinite(history[alpha_index]) ?
             StressStatus::success :
             StressStatus::return_map_failed;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, MohrCoulomb, "Mohr-Coulomb")
} // namespace isochor
