/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/finite_rotation.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    using Vector3 = FiniteRotation::Vector3;

    Vector3
    axis(const unsigned int i)
    {
      Vector3 e;
      e[i] = 1;
      return e;
    }
  } // namespace



  FiniteRotation::FiniteRotation(const Vector3 &theta)
    : theta(theta)
  {
    const double s = theta.norm_square();
    // the series, where the numbers are of the size of the result; upwards from
    // cos and sin where they are not
    double factorial = 1;
    for (unsigned int k = 0; k < c.size(); factorial *= ++k)
      {
        double term = 1 / factorial;
        c[k]        = 0;
        for (unsigned int j = 0; j < 16; ++j)
          {
            c[k] += term;
            term *= -s / ((2 * j + k + 1) * (2 * j + k + 2));
          }
      }
    if (s > 4)
      {
        c[0]             = std::cos(std::sqrt(s));
        c[1]             = std::sin(std::sqrt(s)) / std::sqrt(s);
        double inverse_k = 1; // 1 / k!
        for (unsigned int k = 0; k + 2 < c.size(); inverse_k /= ++k)
          c[k + 2] = (inverse_k - c[k]) / s;
      }
  }



  Vector3
  FiniteRotation::combine(const double   a,
                          const double   b,
                          const double   f,
                          const Vector3 &x) const
  {
    return a * x + b * cross_product_3d(theta, x) + f * (theta * x) * theta;
  }



  Vector3
  FiniteRotation::rotate(const Vector3 &x) const
  {
    return combine(c[0], c[1], c[2], x);
  }



  Vector3
  FiniteRotation::derivative(const unsigned int i, const Vector3 &x) const
  {
    return 2 * theta[i] * combine(d(0), d(1), d(2), x) +
           c[1] * cross_product_3d(axis(i), x) +
           c[2] * (x[i] * theta + (theta * x) * axis(i));
  }



  Vector3
  FiniteRotation::second_derivative(const unsigned int i,
                                    const unsigned int j,
                                    const Vector3     &x) const
  {
    const auto mixed = [&](const unsigned int k) {
      return d(1) * cross_product_3d(axis(k), x) +
             d(2) * (x[k] * theta + (theta * x) * axis(k));
    };
    return (i == j ? 2. : 0.) * combine(d(0), d(1), d(2), x) +
           4 * theta[i] * theta[j] * combine(dd(0), dd(1), dd(2), x) +
           2 * theta[i] * mixed(j) + 2 * theta[j] * mixed(i) +
           c[2] * (x[i] * axis(j) + x[j] * axis(i));
  }



  Vector3
  FiniteRotation::pull_back(const Vector3 &moment) const
  {
    return combine(c[1], -c[2], c[3], moment);
  }



  Vector3
  FiniteRotation::pull_back_derivative(const unsigned int j,
                                       const Vector3     &moment) const
  {
    return 2 * theta[j] * combine(d(1), -d(2), d(3), moment) -
           c[2] * cross_product_3d(axis(j), moment) +
           c[3] * ((theta * moment) * axis(j) + moment[j] * theta);
  }



  Tensor<2, 3>
  FiniteRotation::matrix() const
  {
    Tensor<2, 3> R;
    for (unsigned int j = 0; j < 3; ++j)
      {
        const Vector3 column = rotate(axis(j));
        for (unsigned int i = 0; i < 3; ++i)
          R[i][j] = column[i];
      }
    return R;
  }



  Vector3
  FiniteRotation::vector_of(const Tensor<2, 3> &R)
  {
    // by the unit quaternion (w, q), from the largest of its four squares
    // (Spurrier, J. Spacecraft 15 (1978) 255)
    const double          trace = R[0][0] + R[1][1] + R[2][2];
    std::array<double, 4> square{{1 + trace,
                                  1 + 2 * R[0][0] - trace,
                                  1 + 2 * R[1][1] - trace,
                                  1 + 2 * R[2][2] - trace}};
    const unsigned int    m =
      std::max_element(square.begin(), square.end()) - square.begin();
    const double largest = std::sqrt(square[m]) / 2;
    double       w       = largest;
    Vector3      q;
    if (m == 0)
      for (unsigned int i = 0; i < 3; ++i)
        q[i] = (R[(i + 2) % 3][(i + 1) % 3] - R[(i + 1) % 3][(i + 2) % 3]) /
               (4 * largest);
    else
      {
        const unsigned int i = m - 1, j = (i + 1) % 3, k = (i + 2) % 3;
        w    = (R[k][j] - R[j][k]) / (4 * largest);
        q[i] = largest;
        q[j] = (R[j][i] + R[i][j]) / (4 * largest);
        q[k] = (R[k][i] + R[i][k]) / (4 * largest);
      }
    if (w < 0)
      {
        w = -w;
        q *= -1.;
      }
    const double sine = q.norm();
    return sine > 0 ? 2 * std::atan2(sine, w) / sine * q : q;
  }
} // namespace isochor
