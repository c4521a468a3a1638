/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <isochor/material_model/mohr_coulomb_return.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace isochor
{
  using namespace dealii;

  void
  MohrCoulombReturn::set_strength(const double cohesion,
                                  const double phi,
                                  const double psi)
  {
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

    constexpr double degree = numbers::PI / 180;
    sin_phi                 = std::sin(phi * degree);
    sin_psi                 = std::sin(psi * degree);
    c_cos_phi               = cohesion * std::cos(phi * degree);
  }



  MohrCoulombReturn::Vector
  MohrCoulombReturn::deviatoric_normal(const unsigned int largest,
                                       const unsigned int smallest,
                                       const double       sin_angle)
  {
    Vector normal;
    normal.fill(-2. / 3. * sin_angle);
    normal[largest] += 1 + sin_angle;
    normal[smallest] -= 1 - sin_angle;
    return normal;
  }



  double
  MohrCoulombReturn::yield_function(const Vector      &s,
                                    const double       mean,
                                    const unsigned int largest,
                                    const unsigned int smallest) const
  {
    return (s[largest] - s[smallest]) +
           (s[largest] + s[smallest] + 2 * mean) * sin_phi - 2 * c_cos_phi;
  }



  MohrCoulombReturn::Response
  MohrCoulombReturn::elastic_response(const Trial &trial) const
  {
    const double two_G = 2 * shear_modulus;
    Response     result;
    result.s       = trial.s;
    result.theta   = trial.theta;
    result.plastic = false;
    result.dtheta_dstrain.fill(1);
    for (unsigned int A = 0; A < 3; ++A)
      for (unsigned int B = 0; B < 3; ++B)
        result.ds_dstrain[A][B] = two_G * ((A == B ? 1. : 0.) - 1. / 3.);
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
  template <unsigned int n>
  MohrCoulombReturn::Response
  MohrCoulombReturn::return_to(const ActivePlanes<n> &planes,
                               const Trial           &trial) const
  {
    const double two_G = 2 * shear_modulus;
    const double K     = trial.mean_is_given ? 0. : bulk_modulus;

    std::array<Vector, n> a, b;
    std::array<double, n> f;
    for (unsigned int k = 0; k < n; ++k)
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
    const double B           = (n == 2 ? moduli(a[0], b[n - 1]) : 0.);
    const double determinant = (A - B) * (A + B);

    Response result = elastic_response(trial);
    result.plastic  = true;
    for (unsigned int k = 0; k < n; ++k)
      {
        // Row k of the inverse matrix, on the left of f and of ∂f/∂ε.
        std::array<double, n> inverse;
        for (unsigned int l = 0; l < n; ++l)
          inverse[l] = (l == k ? A : -B) / determinant;
        double lambda = 0, dlambda_dmean = 0;
        Vector dlambda_dstrain{};
        for (unsigned int l = 0; l < n; ++l)
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

    if (n == 2)
      result.edge = (planes.largest[0] != planes.largest[n - 1] ? 0 : 1);
    return result;
  }



  MohrCoulombReturn::Response
  MohrCoulombReturn::return_to_apex() const
  {
    Response result{};
    result.theta   = c_cos_phi / (sin_phi * bulk_modulus);
    result.plastic = result.at_apex = true;
    return result;
  }



  /** Two trial stresses that differ by nothing end on their edge; on a plane
   * they would only if f = 0, where the elastic value holds. */
  double
  MohrCoulombReturn::secant(const Trial       &trial,
                            const Response    &returned,
                            const unsigned int A,
                            const unsigned int B) const
  {
    const double two_G = 2 * shear_modulus;
    if (!returned.plastic)
      return two_G;
    if (returned.at_apex)
      return returned.excess > 0 ? stiffness_at_apex * two_G : 0;
    if (returned.edge == A && B == A + 1)
      return 0;
    const double trial_difference = trial.s[A] - trial.s[B];
    if (!(trial_difference > 0))
      return two_G;
    const double ratio = (returned.s[A] - returned.s[B]) / trial_difference;
    return two_G * std::min(1., std::max(0., ratio));
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
  MohrCoulombReturn::Response
  MohrCoulombReturn::evaluate(const Trial &trial) const
  {
    const double scale = (trial.s[0] - trial.s[2]) +
                         2 * std::abs(trial.mean) * sin_phi + 2 * c_cos_phi;
    // The margin keeps a point that rests on the surface elastic. Written so
    // that not-a-number passes through as elastic and is reported there.
    if (!(yield_function(trial.s, trial.mean, 0, 2) > 1e-12 * scale))
      return elastic_response(trial);

    const Response on_plane     = return_to(plane, trial);
    const bool     violates_1_2 = on_plane.s[0] < on_plane.s[1];
    const bool     violates_2_3 = on_plane.s[1] < on_plane.s[2];
    if (!violates_1_2 && !violates_2_3)
      return on_plane;

    const bool apex_is_out_of_reach = sin_phi == 0 || trial.mean_is_given;
    if (violates_1_2)
      {
        const Response on_edge = return_to(edge_1_is_2, trial);
        if (on_edge.s[0] >= on_edge.s[2] || apex_is_out_of_reach)
          return on_edge;
      }
    if (violates_2_3)
      {
        const Response on_edge = return_to(edge_2_is_3, trial);
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
   * The derivative of dev τ by the strain is given as stiffness_at_apex times
   * the elastic one.
   */
  MohrCoulombReturn::Response
  MohrCoulombReturn::evaluate_at(Trial trial, const double pressure) const
  {
    const double apex   = c_cos_phi / sin_phi;
    trial.mean          = std::min(pressure, apex);
    trial.mean_is_given = true;
    Response result     = evaluate(trial);
    if (!(pressure > apex))
      return result;

    const double S = 100 / shear_modulus;
    result.excess  = pressure - apex;
    result.theta -= S * result.excess;
    result.dtheta_dmean = -S;
    result.plastic      = true;
    result.s.fill(-result.excess);
    result.ds_dmean.fill(-1);
    for (unsigned int A = 0; A < 3; ++A)
      for (unsigned int B = 0; B < 3; ++B)
        result.ds_dstrain[A][B] =
          stiffness_at_apex * 2 * shear_modulus * ((A == B ? 1. : 0.) - 1. / 3);
    result.at_apex = true;
    return result;
  }
} // namespace isochor
