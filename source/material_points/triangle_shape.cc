/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_points/triangle_shape.h>

#include <cmath>

namespace isochor
{
  double
  area(const Point<2> &a, const Point<2> &b, const Point<2> &c)
  {
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }

  double
  quality(const Point<2> &a, const Point<2> &b, const Point<2> &c)
  {
    return 4 * std::sqrt(3.) * std::abs(area(a, b, c)) /
           ((b - a).norm_square() + (c - b).norm_square() +
            (a - c).norm_square());
  }


  PointDomain<2>::Corners
  map_corners(const Tensor<2, 2> &map, const PointDomain<2>::Corners &corners)
  {
    PointDomain<2>::Corners mapped;
    for (unsigned int c = 0; c < 3; ++c)
      mapped[c] = Point<2>(map * corners[c]);
    return mapped;
  }

  std::array<double, 3>
  edge_lengths(const PointDomain<2>::Corners &corners)
  {
    return {{corners[1].distance(corners[2]),
             corners[2].distance(corners[0]),
             corners[0].distance(corners[1])}};
  }

  double
  foot(const PointDomain<2>::Corners &corners, const unsigned int apex)
  {
    const Point<2>    &a    = corners[(apex + 1) % 3];
    const Tensor<1, 2> face = corners[(apex + 2) % 3] - a;
    return (corners[apex] - a) * face / face.norm_square();
  }
} // namespace isochor
