/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/material_model.h>
#include <isochor/spectral_decomposition.h>
#include <isochor/tensor_tools.h>

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
      return sin_phi > 0;
    }

    /** Symmetric for φ = 0 only. With friction dev τ depends on volume change
     * (u) or on p (u-p). With φ = ψ the tangent of τ and the matrix of u-p
     * would be symmetric, but not beyond the apex, and not the tangent of dev
     * τ. */
    bool
    has_symmetric_tangent() const override
    {
      return sin_phi == 0;
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
    using Vector = std::array<double, 3>;
    using Matrix = std::array<Vector, 3>;

    IsotropicElasticity elasticity;
    double bulk_modulus = 0; ///< of u with φ > 0, where K is finite
    double sin_phi      = 0;
    double sin_psi      = 0;
    double c_cos_phi    = 0; ///< Pa

    /** A trial state in principal space, in descending order. */
    struct Trial
    {
      Vector s;     ///< deviatoric stresses
      double theta; ///< volumetric strain
      /** The mean stress: K θ, which the return changes, or, if it is given,
       * that of the returned state. Not needed, and 0, without friction. */
      double mean;
      bool   mean_is_given;
    };

    /**
     * The return map in principal space, in descending order of the trial
     * stress. @p secant holds, for each pair A, B, the ratio
     * (s_A - s_B) / (ε_A - ε_B) of returned stress and trial strain, in the
     * limit where the strains are equal.
     */
    struct PrincipalResponse
    {
      Vector s;          ///< deviatoric stresses
      double theta;      ///< θ^e = tr ε^e
      Matrix ds_dstrain; ///< ∂s_A/∂ε_B of the trial strains
      Vector dtheta_dstrain;
      Matrix secant;
      bool   plastic;
      Vector ds_dmean{}; ///< at a given mean stress, else 0, like the next
      double dtheta_dmean = 0;
      double excess       = 0; ///< of the given mean stress over the apex
    };

    /** The yield planes through one corner of the surface, or one of them:
     * plane k is f with τ_1 and τ_3 replaced by τ_largest[k], τ_smallest[k]. */
    struct ActivePlanes
    {
      unsigned int                n;
      std::array<unsigned int, 2> largest, smallest;
    };

    static constexpr ActivePlanes plane       = {1, {{0, 0}}, {{2, 0}}};
    static constexpr ActivePlanes edge_1_is_2 = {2, {{0, 1}}, {{2, 2}}};
    static constexpr ActivePlanes edge_2_is_3 = {2, {{0, 0}}, {{2, 1}}};

    /** The deviatoric part of ∂f/∂τ (with φ) or ∂g/∂τ (with ψ). */
    static Vector
    deviatoric_normal(const unsigned int largest,
                      const unsigned int smallest,
                      const double       sin_angle);

    double
    yield_function(const Vector      &s,
                   const double       mean,
                   const unsigned int largest,
                   const unsigned int smallest) const;

    PrincipalResponse
    elastic_response(const Trial &trial) const;

    PrincipalResponse
    return_to(const ActivePlanes &planes, const Trial &trial) const;

    PrincipalResponse
    return_to_apex() const;

    /** Choose the region and return. */
    PrincipalResponse
    principal_response(const Trial &trial) const;

    /** The same at a given mean stress, also beyond the apex. */
    PrincipalResponse
    response_at_pressure(Trial trial, const double pressure) const;

    /** Tensors from principal values: see the class's documentation. */
    void
    assemble_response(const SpectralDecomposition       &trial,
                      const Vector                      &strain,
                      const std::array<unsigned int, 3> &order,
                      const PrincipalResponse           &principal,
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

    sin_phi      = std::sin(phi * numbers::PI / 180);
    sin_psi      = std::sin(psi * numbers::PI / 180);
    c_cos_phi    = cohesion * std::cos(phi * numbers::PI / 180);
    bulk_modulus = (phi > 0 && elasticity.inverse_bulk_modulus > 0 ?
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



  template <int dim>
  typename MohrCoulomb<dim>::Vector
  MohrCoulomb<dim>::deviatoric_normal(const unsigned int largest,
                                      const unsigned int smallest,
                                      const double       sin_angle)
  {
    Vector normal;
    normal.fill(-2. / 3. * sin_angle);
    normal[largest] += 1 + sin_angle;
    normal[smallest] -= 1 - sin_angle;
    return normal;
  }



  template <int dim>
  double
  MohrCoulomb<dim>::yield_function(const Vector      &s,
                                   const double       mean,
                                   const unsigned int largest,
                                   const unsigned int smallest) const
  {
    return (s[largest] - s[smallest]) +
           (s[largest] + s[smallest] + 2 * mean) * sin_phi - 2 * c_cos_phi;
  }



  template <int dim>
  typename MohrCoulomb<dim>::PrincipalResponse
  MohrCoulomb<dim>::elastic_response(const Trial &trial) const
  {
    const double      two_G = 2 * elasticity.shear_modulus;
    PrincipalResponse result;
    result.s       = trial.s;
    result.theta   = trial.theta;
    result.plastic = false;
    result.dtheta_dstrain.fill(1);
    for (unsigned int A = 0; A < 3; ++A)
      for (unsigned int B = 0; B < 3; ++B)
        {
          result.ds_dstrain[A][B] = two_G * ((A == B ? 1. : 0.) - 1. / 3.);
          result.secant[A][B]     = two_G;
        }
    return result;
  }



  /**
   * With the normals a_k = ∂f_k/∂τ, b_k = ∂g_k/∂τ of the active planes and the
   * elastic moduli D = K 1⊗1 + 2 G dev,
   *   Σ_l (a_k · D b_l) λ_l = f_k(trial),   τ = τ_trial - Σ_k λ_k D b_k.
   * D b_k is 2 G dev b_k plus the mean stress 2 K sin ψ, so that
   * θ^e = θ_trial - 2 sin ψ Σ_k λ_k holds no K; and a_k · D b_l holds it only
   * as K sin φ sin ψ. Where the mean stress is given it doesn't change with λ:
   * f_k is evaluated at it, and K is absent. The matrix of an edge is
   * [[A, B], [B, A]] with A - B = 2 G (1 ± sin φ) (1 ± sin ψ) > 0 and, at a
   * given mean stress, A + B = 2/3 G (3 ∓ sin φ) (3 ∓ sin ψ) > 0.
   */
  template <int dim>
  typename MohrCoulomb<dim>::PrincipalResponse
  MohrCoulomb<dim>::return_to(const ActivePlanes &planes,
                              const Trial        &trial) const
  {
    const double two_G = 2 * elasticity.shear_modulus;
    const double K     = trial.mean_is_given ? 0. : bulk_modulus;

    std::array<Vector, 2> a, b;
    std::array<double, 2> f;
    for (unsigned int k = 0; k < planes.n; ++k)
      {
        const unsigned int i = planes.largest[k], j = planes.smallest[k];
        a[k] = deviatoric_normal(i, j, sin_phi);
        b[k] = deviatoric_normal(i, j, sin_psi);
        f[k] = yield_function(trial.s, trial.mean, i, j);
      }

    const auto moduli = [&](const Vector &a_k, const Vector &b_l) {
      return two_G * (a_k[0] * b_l[0] + a_k[1] * b_l[1] + a_k[2] * b_l[2]) +
             4 * K * sin_phi * sin_psi;
    };
    const double A           = moduli(a[0], b[0]);
    const double B           = (planes.n == 2 ? moduli(a[0], b[1]) : 0.);
    const double determinant = (A - B) * (A + B);

    PrincipalResponse result = elastic_response(trial);
    result.plastic           = true;
    for (unsigned int k = 0; k < planes.n; ++k)
      {
        // Row k of the inverse matrix, on the left of f and of ∂f/∂ε.
        std::array<double, 2> inverse = {{A / determinant, 0.}};
        if (planes.n == 2)
          {
            inverse[k]     = A / determinant;
            inverse[1 - k] = -B / determinant;
          }
        double lambda = 0, dlambda_dmean = 0;
        Vector dlambda_dstrain{};
        for (unsigned int l = 0; l < planes.n; ++l)
          {
            lambda += inverse[l] * f[l];
            for (unsigned int D = 0; D < 3; ++D)
              dlambda_dstrain[D] +=
                inverse[l] * (two_G * a[l][D] + 2 * K * sin_phi);
            if (trial.mean_is_given)
              dlambda_dmean += inverse[l] * 2 * sin_phi;
          }

        result.theta -= 2 * sin_psi * lambda;
        result.dtheta_dmean -= 2 * sin_psi * dlambda_dmean;
        for (unsigned int C = 0; C < 3; ++C)
          {
            result.s[C] -= two_G * lambda * b[k][C];
            result.ds_dmean[C] -= two_G * dlambda_dmean * b[k][C];
            result.dtheta_dstrain[C] -= 2 * sin_psi * dlambda_dstrain[C];
            for (unsigned int D = 0; D < 3; ++D)
              result.ds_dstrain[C][D] -= two_G * b[k][C] * dlambda_dstrain[D];
          }
      }

    // The secants. Two trial stresses that differ by nothing end on their
    // edge; on a plane they would only if f = 0, where the elastic value holds.
    for (unsigned int C = 0; C < 3; ++C)
      for (unsigned int D = C + 1; D < 3; ++D)
        {
          const double trial_difference = trial.s[C] - trial.s[D];
          const double ratio =
            (trial_difference > 0 ?
               (result.s[C] - result.s[D]) / trial_difference :
               1.);
          result.secant[C][D] = result.secant[D][C] =
            two_G * std::min(1., std::max(0., ratio));
        }
    if (planes.n == 2)
      {
        const unsigned int C = (planes.largest[0] != planes.largest[1] ? 0 : 1);
        result.secant[C][C + 1] = result.secant[C + 1][C] = 0;
      }
    return result;
  }



  template <int dim>
  typename MohrCoulomb<dim>::PrincipalResponse
  MohrCoulomb<dim>::return_to_apex() const
  {
    PrincipalResponse result{};
    result.theta   = c_cos_phi / (sin_phi * bulk_modulus);
    result.plastic = true;
    return result;
  }



  /**
   * The regions of Clausen et al. in terms of the order of the returned
   * stresses. The return to the plane of f is the answer if it keeps
   * τ_1 >= τ_2 >= τ_3. If it violates τ_1 >= τ_2, the plane with τ_2 in the
   * place of τ_1 is violated too, and the two multipliers of that edge are
   * positive; likewise for τ_2 >= τ_3. An edge is the answer unless the return
   * to it ends beyond the apex, τ_1 < τ_3. Without friction the return ends at
   * τ_1 - τ_3 = 2 c, and at a given mean stress on the edge of that section of
   * the surface, and the apex is never asked for.
   */
  template <int dim>
  typename MohrCoulomb<dim>::PrincipalResponse
  MohrCoulomb<dim>::principal_response(const Trial &trial) const
  {
    const double scale = (trial.s[0] - trial.s[2]) +
                         2 * std::abs(trial.mean) * sin_phi + 2 * c_cos_phi;
    // The margin keeps a point that rests on the surface elastic. Written so
    // that not-a-number passes through as elastic and is reported there.
    if (!(yield_function(trial.s, trial.mean, 0, 2) > 1e-12 * scale))
      return elastic_response(trial);

    const PrincipalResponse on_plane     = return_to(plane, trial);
    const bool              violates_1_2 = on_plane.s[0] < on_plane.s[1];
    const bool              violates_2_3 = on_plane.s[1] < on_plane.s[2];
    if (!violates_1_2 && !violates_2_3)
      return on_plane;

    const bool apex_is_out_of_reach = sin_phi == 0 || trial.mean_is_given;
    if (violates_1_2)
      {
        const PrincipalResponse on_edge = return_to(edge_1_is_2, trial);
        if (on_edge.s[0] >= on_edge.s[2] || apex_is_out_of_reach)
          return on_edge;
      }
    if (violates_2_3)
      {
        const PrincipalResponse on_edge = return_to(edge_2_is_3, trial);
        if (on_edge.s[0] >= on_edge.s[2] || apex_is_out_of_reach)
          return on_edge;
      }
    return return_to_apex();
  }



  /**
   * The section of the surface by the deviatoric plane at @p pressure shrinks
   * to a point at the apex, τ = c cot φ. Beyond it dev τ is zero and the
   * excess of p over c cot φ is taken off, so that τ stays on the apex. θ^e
   * goes on from its value at the apex, continuous in p and in the deformation,
   * and falls by S = 100/G per excess. Any S >= 0 gives the same stress where
   * θ^e = p/K: a root of this falling function lies below the apex or it
   * doesn't, and then the stress is the apex's. S keeps the excess small, also
   * for 1/K = 0: at most G/100 of the volumetric strain beyond the apex.
   */
  template <int dim>
  typename MohrCoulomb<dim>::PrincipalResponse
  MohrCoulomb<dim>::response_at_pressure(Trial        trial,
                                         const double pressure) const
  {
    const double apex        = c_cos_phi / sin_phi;
    trial.mean               = std::min(pressure, apex);
    trial.mean_is_given      = true;
    PrincipalResponse result = principal_response(trial);
    if (!(pressure > apex))
      return result;

    const double S = 100 / elasticity.shear_modulus;
    result.excess  = pressure - apex;
    result.theta -= S * result.excess;
    result.dtheta_dmean = -S;
    result.plastic      = true;
    result.s.fill(-result.excess);
    result.ds_dmean.fill(-1);
    result.ds_dstrain = Matrix{};
    result.secant     = Matrix{};
    return result;
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
  MohrCoulomb<dim>::assemble_response(const SpectralDecomposition       &trial,
                                      const Vector                      &strain,
                                      const std::array<unsigned int, 3> &order,
                                      const PrincipalResponse &principal,
                                      const bool               with_tangent,
                                      StressResponse<dim>     &response) const
  {
    constexpr unsigned int n =
      SymmetricTensor<2, dim>::n_independent_components;
    const auto dyad = [&](const unsigned int A, const unsigned int B) {
      SymmetricTensor<2, 3> t;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          t[i][j] = 0.5 * (trial.vectors[A][i] * trial.vectors[B][j] +
                           trial.vectors[B][i] * trial.vectors[A][j]);
      return t;
    };

    response.deviatoric_stress  = SymmetricTensor<2, 3>();
    response.volumetric_tangent = SymmetricTensor<2, dim>();
    response.volumetric_strain  = principal.theta;

    response.deviatoric_pressure_tangent = SymmetricTensor<2, dim>();
    response.volumetric_pressure_tangent = principal.dtheta_dmean;

    std::array<SymmetricTensor<2, dim>, 3> m;
    for (unsigned int a = 0; a < 3; ++a)
      {
        const SymmetricTensor<2, 3> m_a = dyad(order[a], order[a]);
        response.deviatoric_stress += principal.s[a] * m_a;
        m[a] = in_plane<dim>(m_a);
        response.volumetric_tangent += principal.dtheta_dstrain[a] * m[a];
        if (depends_on_pressure())
          response.deviatoric_pressure_tangent += principal.ds_dmean[a] * m[a];
      }

    if (!with_tangent)
      return;
    response.tangent = SymmetricTensor<4, dim>();
    for (unsigned int a = 0; a < 3; ++a)
      {
        // Row a of the first sum, in one piece.
        SymmetricTensor<2, dim> row;
        for (unsigned int b = 0; b < 3; ++b)
          row +=
            (principal.ds_dstrain[a][b] - (a == b ? 2 * principal.s[a] : 0.)) *
            m[b];
        for (unsigned int b = a + 1; b < 3; ++b)
          {
            // A pair with the z-direction of plane strain shears nothing.
            if (order[a] >= dim || order[b] >= dim)
              continue;
            const double x = strain[order[a]] - strain[order[b]];
            const double x_coth_x =
              (std::abs(x) < 1e-4 ? 1 + x * x / 3 : x / std::tanh(x));
            const double g = 0.5 * (principal.secant[a][b] * x_coth_x -
                                    principal.s[a] - principal.s[b]);
            const SymmetricTensor<2, dim> N =
              in_plane<dim>(dyad(order[a], order[b]));
            response.tangent += outer_product(4 * g * N, N);
          }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            response.tangent.access_raw_entry(i * n + j) +=
              m[a].access_raw_entry(i) * row.access_raw_entry(j);
      }
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
    if (depends_on_pressure() && !at_pressure && bulk_modulus == 0)
      return StressStatus::return_map_failed;

    const SymmetricTensor<2, 3> b_trial =
      push_forward(kinematics.F_increment, load_symmetric<dim>(history_n));
    const SpectralDecomposition spectrum = spectral_decomposition<dim>(b_trial);

    Vector strain;
    for (unsigned int A = 0; A < 3; ++A)
      strain[A] = 0.5 * std::log(spectrum.values[A]);
    const double mean_strain = (strain[0] + strain[1] + strain[2]) / 3;
    // Without friction flow is isochoric: then J itself, which can't drift.
    Trial trial;
    trial.theta = (sin_phi == 0 ? std::log(kinematics.J) : 3 * mean_strain);
    trial.mean  = bulk_modulus * trial.theta;
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

    const PrincipalResponse principal =
      at_pressure ? response_at_pressure(trial, *kinematics.pressure) :
                    principal_response(trial);
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
