/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_logarithmic_strain_h
#define isochor_logarithmic_strain_h

#include <isochor/material_model/point_pack.h>
#include <isochor/material_model/principal_stress.h>
#include <isochor/material_model/tensor_tools.h>

#include <cmath>
#include <type_traits>

namespace isochor
{
  /** (artanh(√y)/√y - 1)/y = 1/3 + y/5 + y²/7 + ... for 0 <= y < 1; where the
   * series is used the next term is rounding. */
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE Number
  artanh_remainder(const Number &y)
  {
    if (!is_greater_anywhere(y, Number(0.01)))
      return 1. / 3 +
             y * (1. / 5 +
                  y * (1. / 7 +
                       y * (1. / 9 +
                            y * (1. / 11 +
                                 y * (1. / 13 + y * (1. / 15 + y / 17.))))));
    if constexpr (std::is_same_v<Number, PointPack>)
      return PointPack(artanh_remainder(y[0]), artanh_remainder(y[1]));
    else
      return (std::atanh(std::sqrt(y)) / std::sqrt(y) - 1) / y;
  }



  /**
   * The isochoric logarithmic strain e = dev ½ ln b of an isochoric left
   * Cauchy-Green tensor b, det b = 1, and the modulus of a stress that is
   * parallel to it.
   *
   * In plane strain neither needs an eigenvector. With the mean m of the
   * in-plane part of b, its deviator d and r² = d:d/2, its eigenvalues are
   * m ± r, tanh x = z = r/m for x = e_1 - e_2, and
   *   e = a 1 + k d in the plane, -2 a across it,
   *   a = -¼ ln b_zz,  k = f/(2 m),  f = artanh(z)/z = x coth x.
   * @tparam Number double, or PointPack for several points at once.
   */
  template <int dim, typename Number>
  class LogarithmicStrain;



  template <typename Number>
  class LogarithmicStrain<2, Number>
  {
  public:
    /** Of @p b. */
    LogarithmicStrain(const SymmetricComponents<2, Number> &b)
    {
      const Number mean = 0.5 * (b.entry[0] + b.entry[1]);
      const Number half = 0.5 * (b.entry[0] - b.entry[1]);
      const Number over = 1. / mean;
      const Number y =
        (half * half + b.entry[3] * b.entry[3]) * over * over; // z²
      const Number rest = artanh_remainder(y);
      // ½ ln b_zz = artanh((b_zz - 1) / (b_zz + 1))
      const Number w = (b.entry[2] - 1.) / (b.entry[2] + 1.);
      const Number a = -0.5 * w * (1. + w * w * artanh_remainder(w * w));
      f              = 1. + y * rest;
      const Number k = 0.5 * f * over;
      // (1 - f) d ⊗ d / (2 r²) = - 2 rest/f² (k d) ⊗ (k d)
      bend         = 2. * rest / (f * f);
      normal       = k * half;
      strain.entry = {{a + normal, a - normal, -2. * a, k * b.entry[3]}};
    }

    /** e. */
    const SymmetricComponents<2, Number> &
    deviator() const
    {
      return strain;
    }

    /** b again, where e is @p factor times what it is. */
    SymmetricComponents<2, Number>
    left_cauchy_green(const Number &factor) const
    {
      using std::cosh, std::exp, std::sinh, std::sqrt;
      const Number q     = normal * normal + strain.entry[3] * strain.entry[3];
      const Number x     = 2 * factor * sqrt(q);
      const Number scale = exp(-factor * strain.entry[2]);
      const Number slope =
        scale * 2 * factor * (x > 0 ? sinh(x) / x : Number(1.));
      return {{{scale * cosh(x) + slope * normal,
                scale * cosh(x) - slope * normal,
                exp(2 * factor * strain.entry[2]),
                slope * strain.entry[3]}}};
    }

    /** The Lie derivative of s = @p secant e (Pa) with
     *   ∂s/∂e = secant (1 + @p radial e ⊗ e):
     * PrincipalStress::assemble_tangent() written with d. */
    ModulusComponents<2, Number>
    modulus(const Number &secant, const Number &radial) const
    {
      const std::array<Number, 3> e = {
        {strain.entry[0], strain.entry[1], strain.entry[3]}};
      const std::array<Number, 3> d = {{normal, -1. * normal, strain.entry[3]}};
      const Number                unit = secant * (1. / 6. - 0.5 * f),
                   identity            = secant * (f + strain.entry[2]);
      ModulusComponents<2, Number> c;
      unrolled<3>([&](const auto i) {
        unrolled<3>([&](const auto j) {
          constexpr double equal = (i != j ? 0. : i < 2 ? 1. : 0.5);
          Number           sum   = radial * e[i] * e[j] - bend * d[i] * d[j];
          if (j < 2)
            sum -= d[i];
          if (i < 2)
            sum -= d[j];
          sum          = secant * sum + equal * identity;
          c[i * 3 + j] = i < 2 && j < 2 ? sum + unit : sum;
        });
      });
      return c;
    }

  private:
    SymmetricComponents<2, Number> strain;
    Number                         f, bend, normal;
  };



  /** In space: by eigenvectors. */
  template <>
  class LogarithmicStrain<3, double>
  {
  public:
    LogarithmicStrain(const SymmetricComponents<3> &b)
      : spectrum(spectral_decomposition(b))
    {
      for (unsigned int A = 0; A < 3; ++A)
        principal[A] = 0.5 * std::log(spectrum.values[A]);
      const double mean = (principal[0] + principal[1] + principal[2]) / 3;
      for (double &e_A : principal)
        e_A -= mean; // rounding only
      spectrum.store(principal, strain.entry.data());
    }

    const SymmetricComponents<3> &
    deviator() const
    {
      return strain;
    }

    SymmetricComponents<3>
    left_cauchy_green(const double factor) const
    {
      SymmetricComponents<3>  b;
      PrincipalStress::Vector values;
      for (unsigned int A = 0; A < 3; ++A)
        values[A] = std::exp(2 * factor * principal[A]);
      spectrum.store(values, b.entry.data());
      return b;
    }

    ModulusComponents<3>
    modulus(const double secant, const double radial) const
    {
      const auto     &e = principal;
      PrincipalStress stress;
      stress.strain = e;
      for (unsigned int A = 0; A < 3; ++A)
        {
          stress.s[A] = secant * e[A];
          for (unsigned int B = 0; B < 3; ++B)
            stress.ds_dstrain[A][B] =
              secant * ((A == B ? 2. / 3. : -1. / 3.) + radial * e[A] * e[B]);
        }
      return stress.modulus(spectrum,
                            [secant](const unsigned int, const unsigned int) {
                              return secant;
                            });
    }

  private:
    SpectralDecomposition<3> spectrum;
    PrincipalStress::Vector  principal;
    SymmetricComponents<3>   strain;
  };
} // namespace isochor

#endif
