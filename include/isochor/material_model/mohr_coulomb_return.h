/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mohr_coulomb_return_h
#define isochor_mohr_coulomb_return_h

#include <deal.II/base/numbers.h>

#include <array>
#include <cmath>
#include <utility>

namespace isochor
{
  /**
   * The return map to the yield surface of Mohr and Coulomb in principal
   * Kirchhoff stresses τ_1 >= τ_2 >= τ_3,
   *   f = (τ_1 - τ_3) + (τ_1 + τ_3) sin φ - 2 c cos φ,
   *   g = (τ_1 - τ_3) + (τ_1 + τ_3) sin ψ,
   * by stress regions (Clausen, Damkilde & Andersen 2006, 2007; doc/
   * materials.md), with its derivatives.
   */
  class MohrCoulombReturn
  {
  public:
    using Vector = std::array<double, 3>;
    using Matrix = std::array<Vector, 3>;

    /** The numbers of three values, the largest first. */
    static std::array<unsigned int, 3>
    descending(const Vector &values)
    {
      std::array<unsigned int, 3> order = {{0, 1, 2}};
      const auto sort_pair = [&](const unsigned int i, const unsigned int j) {
        if (values[order[i]] < values[order[j]])
          std::swap(order[i], order[j]);
      };
      sort_pair(0, 1);
      sort_pair(1, 2);
      sort_pair(0, 1);
      return order;
    }

    double shear_modulus = 0; ///< Pa
    double bulk_modulus  = 0; ///< of u with φ > 0, where K is finite (Pa)
    double sin_phi       = 0;
    double sin_psi       = 0;
    double c_cos_phi     = 0; ///< Pa

    /** Set the last three by c (Pa), φ and ψ (degrees). Throws if they aren't
     * those of a material. */
    void
    set_strength(const double cohesion, const double phi, const double psi);

    /** c (Pa). */
    double
    cohesion() const
    {
      return c_cos_phi / std::sqrt(1 - sin_phi * sin_phi);
    }

    /** φ (degrees). */
    double
    friction_angle() const
    {
      return std::asin(sin_phi) * 180 / dealii::numbers::PI;
    }

    /** At a given mean stress beyond the apex, the share of the elastic shear
     * stiffness that the derivatives report in place of the exact one, which is
     * zero: where all points around a node are there nothing would hold it, and
     * the matrix is singular. So small that Newton's method doesn't see it. */
    static constexpr double stiffness_at_apex = 1e-6;

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

    /** The return map in principal space, in descending order of the trial
     * stress. */
    struct Response
    {
      Vector s;          ///< deviatoric stresses
      double theta;      ///< θ^e = tr ε^e
      Matrix ds_dstrain; ///< ∂s_A/∂ε_B of the trial strains
      Vector dtheta_dstrain;
      bool   plastic;
      Vector ds_dmean{}; ///< at a given mean stress, else 0, like the next
      double dtheta_dmean = 0;
      double excess       = 0; ///< of the given mean stress over the apex

      /** Where all stresses are equal, and the first of two that are. */
      bool         at_apex = false;
      unsigned int edge    = 3; ///< 3: no two
    };

    /** The ratio (s_A - s_B) / (ε_A - ε_B), A < B, of returned stress and trial
     * strain, in the limit where the strains are equal. */
    double
    secant(const Trial       &trial,
           const Response    &returned,
           const unsigned int A,
           const unsigned int B) const;

    /** Choose the region and return. */
    Response
    evaluate(const Trial &trial) const;

    /** The same at a given mean stress, also beyond the apex. */
    Response
    evaluate_at(Trial trial, const double pressure) const;

  private:
    /** The yield planes through one corner of the surface, or one of them:
     * plane k is f with τ_1 and τ_3 replaced by τ_largest[k], τ_smallest[k]. */
    template <unsigned int n>
    struct ActivePlanes
    {
      std::array<unsigned int, n> largest, smallest;
    };

    static constexpr ActivePlanes<1> plane       = {{{0}}, {{2}}};
    static constexpr ActivePlanes<2> edge_1_is_2 = {{{0, 1}}, {{2, 2}}};
    static constexpr ActivePlanes<2> edge_2_is_3 = {{{0, 0}}, {{2, 1}}};

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

    Response
    elastic_response(const Trial &trial) const;

    template <unsigned int n>
    Response
    return_to(const ActivePlanes<n> &planes, const Trial &trial) const;

    Response
    return_to_apex() const;
  };
} // namespace isochor

#endif
