/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_spectral_decomposition_h
#define isochor_spectral_decomposition_h

#include <deal.II/base/symmetric_tensor.h>

#include <isochor/material_model/tensor_tools.h>

#include <array>
#include <cmath>

namespace isochor
{
  using namespace dealii;

  /**
   * t = Σ_A values[A] n_A ⊗ n_A of a symmetric 3D tensor, in no particular
   * order, by the dyads of its orthonormal eigenvectors. In plane strain
   * (@p dim = 2) z is an eigen-direction and comes last; it has no dyads, as
   * those hold the components only that work on motions of dimension dim, in
   * deal.II's order.
   */
  template <int dim>
  struct SpectralDecomposition
  {
    static constexpr unsigned int n_pairs = dim * (dim - 1) / 2;
    using Components =
      std::array<double, SymmetricTensor<2, dim>::n_independent_components>;

    std::array<double, 3>           values;
    std::array<Components, dim>     dyads;       ///< n_A ⊗ n_A
    std::array<Components, n_pairs> mixed_dyads; ///< sym(n_A ⊗ n_B), see pair()

    /** Where that of A and B > A stands. */
    static constexpr unsigned int
    pair(const unsigned int A, const unsigned int B)
    {
      return A + B - 1;
    }

    /** Store the tensor that has the eigenvectors of t and @p new_values, as
     * store_symmetric() would. */
    void
    store(const std::array<double, 3> &new_values, double *components) const
    {
      components[2] = new_values[2];
      for (unsigned int i = 0; i < dyads[0].size(); ++i)
        {
          double sum = 0;
          for (unsigned int A = 0; A < dim; ++A)
            sum += new_values[A] * dyads[A][i];
          components[component_in_3d<dim>(i)] = sum;
        }
    }
  };

  /**
   * The eigenvalues and eigenvectors of @p t. @p dim = 2: closed form.
   * @p dim = 3: cyclic Jacobi rotations until each off-diagonal entry is
   * below machine precision times the geometric mean of its diagonal entries,
   * which finds also the small eigenvalues of a positive definite tensor to a
   * high relative accuracy (Demmel & Veselić 1992). Equal eigenvalues need no
   * special treatment in either. Not-a-number in gives not-a-number out.
   */
  template <int dim>
  SpectralDecomposition<dim>
  spectral_decomposition(const SymmetricComponents<dim> &t);

  template <>
  SpectralDecomposition<3>
  spectral_decomposition<3>(const SymmetricComponents<3> &t);

  // here, so that hot loops have it in registers
  template <>
  inline SpectralDecomposition<2>
  spectral_decomposition<2>(const SymmetricComponents<2> &t)
  {
    const double xx = t.entry[0], yy = t.entry[1], xy = t.entry[3];
    const double mean   = 0.5 * (xx + yy);
    const double half   = 0.5 * (xx - yy);
    const double radius = std::sqrt(half * half + xy * xy);

    // half of cosine and sine of twice the angle of the first eigenvector
    const double c = radius > 0 ? 0.5 * half / radius : 0.5;
    const double s = radius > 0 ? 0.5 * xy / radius : 0.;

    SpectralDecomposition<2> result;
    result.values         = {{mean + radius, mean - radius, t.entry[2]}};
    result.dyads[0]       = {{0.5 + c, 0.5 - c, s}};
    result.dyads[1]       = {{0.5 - c, 0.5 + c, -s}};
    result.mixed_dyads[0] = {{-s, s, c}};
    return result;
  }
} // namespace isochor

#endif
