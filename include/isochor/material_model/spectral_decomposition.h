/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_spectral_decomposition_h
#define isochor_spectral_decomposition_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace isochor
{
  using namespace dealii;

  /** t = Σ_A values[A] vectors[A] ⊗ vectors[A], in no particular order. */
  struct SpectralDecomposition
  {
    std::array<double, 3>       values;
    std::array<Tensor<1, 3>, 3> vectors;
  };

  /**
   * Eigenvalues and orthonormal eigenvectors of a symmetric 3D tensor.
   * @p dim = 2 (plane strain): z is an eigen-direction and comes last; closed
   * form. @p dim = 3: cyclic Jacobi rotations until each off-diagonal entry is
   * below machine precision times the geometric mean of its diagonal entries,
   * which finds also the small eigenvalues of a positive definite tensor to a
   * high relative accuracy (Demmel & Veselić 1992). Equal eigenvalues need no
   * special treatment in either. Not-a-number in gives not-a-number out.
   */
  template <int dim>
  SpectralDecomposition
  spectral_decomposition(const SymmetricTensor<2, 3> &t);
} // namespace isochor

#endif
