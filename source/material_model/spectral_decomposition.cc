/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/material_model/spectral_decomposition.h>

#include <array>
#include <cmath>
#include <limits>

namespace isochor
{
  /** The components of sym(v ⊗ w) in deal.II's order. */
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



  template <>
  SpectralDecomposition<3>
  spectral_decomposition<3>(const SymmetricComponents<3> &t)
  {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();

    double                      a[3][3];
    std::array<Tensor<1, 3>, 3> vectors;
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int j = 0; j < 3; ++j)
          a[i][j] = t.entry[t.place(i, j)];
        vectors[i][i] = 1;
      }

    // Convergence is quadratic: 4 or 5 sweeps do; the bound is for NaN.
    bool rotated = true;
    for (unsigned int sweep = 0; sweep < 30 && rotated; ++sweep)
      {
        rotated = false;
        for (unsigned int p = 0; p < 2; ++p)
          for (unsigned int q = p + 1; q < 3; ++q)
            {
              if (std::abs(a[p][q]) <=
                  epsilon * std::sqrt(std::abs(a[p][p] * a[q][q])))
                continue;
              rotated = true;

              const double ratio   = (a[q][q] - a[p][p]) / (2 * a[p][q]);
              const double tangent = std::copysign(
                1 / (std::abs(ratio) + std::sqrt(ratio * ratio + 1)), ratio);
              const double cosine = 1 / std::sqrt(1 + tangent * tangent);
              const double sine   = tangent * cosine;

              const unsigned int r = 3 - p - q;
              a[p][p] -= tangent * a[p][q];
              a[q][q] += tangent * a[p][q];
              a[p][q] = a[q][p] = 0;
              const double a_rp = a[r][p], a_rq = a[r][q];
              a[r][p] = a[p][r] = cosine * a_rp - sine * a_rq;
              a[r][q] = a[q][r] = sine * a_rp + cosine * a_rq;

              const Tensor<1, 3> v_p = vectors[p];
              vectors[p]             = cosine * v_p - sine * vectors[q];
              vectors[q]             = sine * v_p + cosine * vectors[q];
            }
      }

    SpectralDecomposition<3> result;
    result.values = {{a[0][0], a[1][1], a[2][2]}};
    for (unsigned int A = 0; A < 3; ++A)
      {
        result.dyads[A] = dyad(vectors[A], vectors[A]);
        for (unsigned int B = A + 1; B < 3; ++B)
          result.mixed_dyads[result.pair(A, B)] = dyad(vectors[A], vectors[B]);
      }
    return result;
  }
} // namespace isochor
