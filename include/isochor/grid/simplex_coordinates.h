/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_simplex_coordinates_h
#define isochor_simplex_coordinates_h

#include <deal.II/base/tensor.h>

#include <array>

namespace isochor
{
  using namespace dealii;

  /** The barycentric coordinates of @p x in the simplex with @p corners, all
   * points, or all vectors from one point; all are -1 if it is flat. */
  template <int dim, typename Place>
  std::array<double, dim + 1>
  simplex_coordinates(const std::array<Place, dim + 1> &corners, const Place &x)
  {
    std::array<double, dim + 1> lambda;
    lambda.fill(-1);
    Tensor<2, dim> edges;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        edges[d][c] = corners[c + 1][d] - corners[0][d];
    if (!(determinant(edges) != 0))
      return lambda;
    const Tensor<1, dim> others = invert(edges) * (x - corners[0]);
    lambda[0]                   = 1;
    for (unsigned int c = 0; c < dim; ++c)
      {
        lambda[c + 1] = others[c];
        lambda[0] -= others[c];
      }
    return lambda;
  }
} // namespace isochor

#endif
