/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_principal_stress_h
#define isochor_principal_stress_h

#include <isochor/material_model/material_model.h>
#include <isochor/material_model/spectral_decomposition.h>
#include <isochor/material_model/tensor_tools.h>

#include <array>
#include <cmath>
#include <tuple>

namespace isochor
{
  /** Apply @p function to the eigenvalues of the symmetric tensor stored in
   * @p components. */
  template <int dim, typename Function>
  inline void
  map_eigenvalues(const Function &function, double *components)
  {
    const auto spectrum =
      spectral_decomposition(SymmetricComponents<dim>::load(components));
    std::array<double, 3> values;
    for (unsigned int A = 0; A < 3; ++A)
      values[A] = function(spectrum.values[A]);
    spectrum.store(values, components);
  }



  /** dev ε : dev ε of the logarithmic strain ε = ½ ln b of the symmetric tensor
   * b stored in @p components. */
  template <int dim>
  inline double
  square_of_shear(const double *components)
  {
    double sum = 0, square = 0;
    for (const double b :
         spectral_decomposition(SymmetricComponents<dim>::load(components))
           .values)
      {
        sum += 0.5 * std::log(b);
        square += std::pow(0.5 * std::log(b), 2);
      }
    return square - sum * sum / 3;
  }



  /** x coth x; the series is exact to rounding where it is used. */
  inline double
  x_coth_x(const double x)
  {
    const double y = x * x;
    return y < 2.5e-3 ?
             1 + y * (1. / 3 - y * (1. / 45 - y * (2. / 945 - y / 4725))) :
             x / std::tanh(x);
  }



  /**
   * The answer of an isotropic law in principal logarithmic strains, in the
   * order of the eigenvectors n_A of the trial tensor b (left Cauchy-Green),
   * ε_A = ½ ln b_A, and the tensors that come of it.
   */
  struct PrincipalStress
  {
    using Vector = std::array<double, 3>;

    Vector                strain; ///< ε_A, or what differs from it by a mean
    Vector                s;      ///< deviatoric Kirchhoff stresses (Pa)
    std::array<Vector, 3> ds_dstrain; ///< ∂s_A/∂ε_B (Pa)

    /** dev τ = Σ_A s_A n_A ⊗ n_A. */
    template <int dim>
    void
    assemble_stress(const SpectralDecomposition<dim> &spectrum,
                    SymmetricTensor<2, 3>            &stress) const;

    /**
     * The Lie derivative of dev τ (Simo 1992; Bonet & Wood 2008, section 6.6):
     *   Σ_AB (∂s_A/∂ε_B - 2 s_A δ_AB) m_A ⊗ m_B + Σ_{A<B} 4 g_AB N_AB ⊗ N_AB,
     * m_A = n_A ⊗ n_A, N_AB = sym(n_A ⊗ n_B), and
     *   g_AB = (s_A b_B - s_B b_A) / (b_A - b_B)
     *        = (s_A - s_B)/x · (x coth x)/2 - (s_A + s_B)/2,  x = ε_A - ε_B,
     * the second form being regular at x = 0. @p secant(A, B) is (s_A - s_B)/x
     * (Pa), in its limit where x is 0. In plane strain the direction of z,
     * which comes last, is neither sheared nor stretched.
     */
    template <int dim, typename Secant>
    ModulusComponents<dim>
    modulus(const SpectralDecomposition<dim> &spectrum,
            const Secant                     &secant) const;
  };



  // Components one by one: tensors that are written by numbers and read as
  // vectors right afterwards made these functions three times slower.

  template <int dim>
  inline void
  PrincipalStress::assemble_stress(const SpectralDecomposition<dim> &spectrum,
                                   SymmetricTensor<2, 3> &stress) const
  {
    typename SpectralDecomposition<dim>::Components sum{};
    for (unsigned int A = 0; A < dim; ++A)
      for (unsigned int i = 0; i < sum.size(); ++i)
        sum[i] += s[A] * spectrum.dyads[A][i];
    for (unsigned int i = 0; i < 6; ++i)
      stress.access_raw_entry(i) = 0;
    if (dim == 2)
      stress.access_raw_entry(2) = s[2];
    for (unsigned int i = 0; i < sum.size(); ++i)
      stress.access_raw_entry(component_in_3d<dim>(i)) = sum[i];
  }



  template <int dim, typename Secant>
  inline ModulusComponents<dim>
  PrincipalStress::modulus(const SpectralDecomposition<dim> &spectrum,
                           const Secant                     &secant) const
  {
    using Components = typename SpectralDecomposition<dim>::Components;
    constexpr unsigned int             n = std::tuple_size<Components>::value;
    const std::array<Components, dim> &m = spectrum.dyads;
    ModulusComponents<dim>             sum{};
    for (unsigned int A = 0; A < dim; ++A)
      {
        // row A of the first sum, in one piece
        Components row{};
        for (unsigned int B = 0; B < dim; ++B)
          {
            const double factor = ds_dstrain[A][B] - (A == B ? 2 * s[A] : 0.);
            for (unsigned int j = 0; j < n; ++j)
              row[j] += factor * m[B][j];
          }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            sum[i * n + j] += m[A][i] * row[j];

        for (unsigned int B = A + 1; B < dim; ++B)
          {
            const double four_g =
              2 *
              (secant(A, B) * x_coth_x(strain[A] - strain[B]) - s[A] - s[B]);
            const Components &N = spectrum.mixed_dyads[spectrum.pair(A, B)];
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                sum[i * n + j] += four_g * N[i] * N[j];
          }
      }
    return sum;
  }
} // namespace isochor

#endif
