/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/material_model/spectral_decomposition.h>

#include <cmath>
#include <limits>

namespace isochor
{
  template <>
  SpectralDecomposition
  spectral_decomposition<2>(const SymmetricTensor<2, 3> &t)
  {
    const double mean   = 0.5 * (t[0][0] + t[1][1]);
    const double half   = 0.5 * (t[0][0] - t[1][1]);
    const double radius = std::sqrt(half * half + t[0][1] * t[0][1]);

    // The eigenvector of mean + radius is (radius + half, t_xy), or
    // (t_xy, radius - half): take the one that doesn't cancel.
    double x = 1, y = 0;
    if (radius > 0)
      {
        x                   = half >= 0 ? radius + half : t[0][1];
        y                   = half >= 0 ? t[0][1] : radius - half;
        const double length = std::sqrt(x * x + y * y);
        x /= length;
        y /= length;
      }

    SpectralDecomposition result;
    result.values        = {{mean + radius, mean - radius, t[2][2]}};
    result.vectors[0][0] = x;
    result.vectors[0][1] = y;
    result.vectors[1][0] = -y;
    result.vectors[1][1] = x;
    result.vectors[2][2] = 1;
    return result;
  }



  template <>
  SpectralDecomposition
  spectral_decomposition<3>(const SymmetricTensor<2, 3> &t)
  {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();

    double                a[3][3];
    SpectralDecomposition result;
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int j = 0; j < 3; ++j)
          a[i][j] = t[i][j];
        result.vectors[i][i] = 1;
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

              const Tensor<1, 3> v_p = result.vectors[p];
              result.vectors[p]      = cosine * v_p - sine * result.vectors[q];
              result.vectors[q]      = sine * v_p + cosine * result.vectors[q];
            }
      }
    result.values = {{a[0][0], a[1][1], a[2][2]}};
    return result;
  }
} // namespace isochor
