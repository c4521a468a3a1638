/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_finite_rotation_h
#define isochor_finite_rotation_h

#include <deal.II/base/tensor.h>

#include <array>

namespace isochor
{
  using namespace dealii;

  /**
   * The rotation R = exp([θ]×) by a rotation vector θ of any length, and its
   * derivatives with respect to θ. With s = |θ|² and
   *   c_k(s) = Σ_j (-s)^j / (2j + k)!,   c_k' = (k c_{k+2} - c_{k+1}) / 2,
   * (c_0 = cos|θ|, c_1 = sin|θ|/|θ|, c_2 = (1 - cos|θ|)/s; Stumpff's functions)
   * all of them are sums of c_k(s) with polynomials of θ, without a singularity
   * at θ = 0: R x = c_0 x + c_1 θ×x + c_2 (θ·x) θ (Rodrigues).
   */
  class FiniteRotation
  {
  public:
    using Vector3 = Tensor<1, 3>;

    explicit FiniteRotation(const Vector3 &theta);

    /** R x. */
    Vector3
    rotate(const Vector3 &x) const;
    /** ∂(R x)/∂θ_i. */
    Vector3
    derivative(const unsigned int i, const Vector3 &x) const;
    /** ∂²(R x)/∂θ_i∂θ_j. */
    Vector3
    second_derivative(const unsigned int i,
                      const unsigned int j,
                      const Vector3     &x) const;

    /** Tᵀ M, the force on θ of a moment M: T δθ is the spin of δR. */
    Vector3
    pull_back(const Vector3 &moment) const;
    /** ∂(Tᵀ M)/∂θ_j. */
    Vector3
    pull_back_derivative(const unsigned int j, const Vector3 &moment) const;

    Tensor<2, 3>
    matrix() const;

    /** The rotation vector of a rotation matrix, |θ| <= π. */
    static Vector3
    vector_of(const Tensor<2, 3> &R);

  private:
    /** a x + b θ×x + c (θ·x) θ. */
    Vector3
    combine(const double   a,
            const double   b,
            const double   c,
            const Vector3 &x) const;
    double
    d(const unsigned int k) const
    {
      return (k * c[k + 2] - c[k + 1]) / 2;
    }
    double
    dd(const unsigned int k) const
    {
      return (k * d(k + 2) - d(k + 1)) / 2;
    }

    Vector3               theta;
    std::array<double, 7> c;
  };
} // namespace isochor

#endif
