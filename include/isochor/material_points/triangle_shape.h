/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_triangle_shape_h
#define isochor_triangle_shape_h

#include <isochor/material_points/point_domain.h>

#include <algorithm>
#include <array>

namespace isochor
{
  using namespace dealii;

  /** Positive if the corners go around it counter-clockwise. */
  double
  area(const Point<2> &a, const Point<2> &b, const Point<2> &c);

  /** 4√3 A / Σ l², 1 if the triangle is equilateral (Bank, PLTMG, 1998). */
  double
  quality(const Point<2> &a, const Point<2> &b, const Point<2> &c);

  inline double
  quality(const PointDomain<2>::Corners &corners)
  {
    return quality(corners[0], corners[1], corners[2]);
  }

  PointDomain<2>::Corners
  map_corners(const Tensor<2, 2> &map, const PointDomain<2>::Corners &corners);

  /** Where the perpendicular from the corner @p apex meets the opposite edge, 0
   * to 1 if within it. */
  double
  foot(const PointDomain<2>::Corners &corners, const unsigned int apex);

  /** The lengths of the edges opposite to the corners. */
  std::array<double, 3>
  edge_lengths(const PointDomain<2>::Corners &corners);

  inline double
  shortest_edge(const PointDomain<2>::Corners &corners)
  {
    const std::array<double, 3> lengths = edge_lengths(corners);
    return *std::min_element(lengths.begin(), lengths.end());
  }
} // namespace isochor

#endif
