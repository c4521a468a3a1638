/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_places_in_cells_h
#define isochor_places_in_cells_h

#include <isochor/grid/simplex_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochor
{
  using namespace dealii;

  template <int dim>
  std::array<Point<dim>, dim + 1>
  corners_of(const SimplexGeometry<dim> &geometry, const unsigned int cell)
  {
    std::array<Point<dim>, dim + 1> corners;
    for (unsigned int v = 0; v <= dim; ++v)
      corners[v] = geometry.vertices()[geometry.vertex_indices(cell)[v]];
    return corners;
  }

  /** The @p i th of places spread evenly over cells, in that with the @p
   * corners. If each cell is looked at in n of them, they are those from n
   * times its number on: a part of the cell that is the same in each would miss
   * a slit along the cells. */
  template <int dim>
  Point<dim>
  spread_place(const std::array<Point<dim>, dim + 1> &corners,
               const std::size_t                      i)
  {
    // the sequence of Kronecker with the root of x^(dim+1) = x + 1; cuts of
    // the unit interval, sorted, are barycentric coordinates
    constexpr double root =
      dim == 2 ? 1.32471795724474602596 : 1.22074408460575947536;
    std::array<double, dim + 2> cuts;
    cuts[0] = 0;
    for (unsigned int d = 0; d < dim; ++d)
      cuts[d + 1] = std::fmod(0.5 + (i + 1) * std::pow(root, -1. - d), 1.);
    cuts[dim + 1] = 1;
    std::sort(cuts.begin(), cuts.end());
    Point<dim> x;
    for (unsigned int v = 0; v <= dim; ++v)
      x += (cuts[v + 1] - cuts[v]) * corners[v];
    return x;
  }
} // namespace isochor

#endif
