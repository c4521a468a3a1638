/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/face_projection.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  template <int dim>
  FaceProjection<dim>::FaceProjection(const Point<dim>                  &x,
                                      const std::array<Point<dim>, dim> &y)
  {
    Tensor<2, n_tangents> metric;
    for (unsigned int a = 0; a < n_tangents; ++a)
      tangent[a] = y[a + 1] - y[0];
    if constexpr (dim == 2)
      normal = cross_product_2d(tangent[0]);
    else
      normal = cross_product_3d(tangent[0], tangent[1]);
    normal /= normal.norm();
    for (unsigned int a = 0; a < n_tangents; ++a)
      for (unsigned int b = 0; b < n_tangents; ++b)
        metric[a][b] = tangent[a] * tangent[b];
    inverse_metric = invert(metric);
    for (unsigned int a = 0; a < n_tangents; ++a)
      for (unsigned int b = 0; b < n_tangents; ++b)
        dual[a] += inverse_metric[a][b] * tangent[b];
    distance = (x - y[0]) * normal;
    for (unsigned int a = 0; a < n_tangents; ++a)
      xi[a] = dual[a] * (x - y[0]);
    nearest         = corner_weights();
    distance_square = distance * distance;
    if (*std::min_element(nearest.begin(), nearest.end()) >= 0)
      return;
    // on one of the edges, which in 2D are the face itself
    distance_square = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < (dim == 2 ? 1 : dim); ++i)
      {
        const unsigned int   j    = (i + 1) % dim;
        const Tensor<1, dim> edge = y[j] - y[i];
        const double         s =
          std::clamp((x - y[i]) * edge / edge.norm_square(), 0., 1.);
        const double square = x.distance_square(y[i] + s * edge);
        if (square >= distance_square)
          continue;
        distance_square = square;
        nearest.fill(0);
        nearest[i] = 1 - s;
        nearest[j] = s;
      }
  }



  template <int dim>
  std::array<double, dim>
  FaceProjection<dim>::corner_weights() const
  {
    std::array<double, dim> weights;
    weights[0] = 1;
    for (unsigned int a = 0; a < n_tangents; ++a)
      {
        weights[a + 1] = xi[a];
        weights[0] -= xi[a];
      }
    return weights;
  }



  template <int dim>
  Tensor<1, dim>
  FaceProjection<dim>::normal_change(
    const std::array<Tensor<1, dim>, n_tangents> &of_tangent) const
  {
    Tensor<1, dim> change;
    for (unsigned int a = 0; a < n_tangents; ++a)
      change -= (normal * of_tangent[a]) * dual[a];
    return change;
  }



  template <int dim>
  Tensor<1, FaceProjection<dim>::n_tangents>
  FaceProjection<dim>::xi_change(
    const Tensor<1, dim>                         &relative,
    const std::array<Tensor<1, dim>, n_tangents> &of_tangent) const
  {
    Tensor<1, n_tangents> change;
    for (unsigned int a = 0; a < n_tangents; ++a)
      {
        change[a] = dual[a] * relative;
        for (unsigned int b = 0; b < n_tangents; ++b)
          change[a] +=
            distance * inverse_metric[a][b] * (normal * of_tangent[b]);
      }
    return change;
  }



  template struct FaceProjection<2>;
  template struct FaceProjection<3>;
} // namespace isochor
