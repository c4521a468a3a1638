/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/rounding.h>
#include <isochor/body_quadrature/walls_at_place.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** The part of a cell by which a place may have left the grid's boundary
     * inwards, with a wall that moves, and still is at it. */
    constexpr double near_wall = 0.3;
  } // namespace



  template <int dim>
  WallsAtPlace<dim>::WallsAtPlace(const CellOccupancy<dim> &occupancy,
                                  const unsigned int        cell,
                                  const Point<dim>         &x,
                                  const Tensor<1, dim>     &beyond)
    : geometry(occupancy.grid.geometry())
    , x(x)
    , on_walls(x + beyond)
  {
    constexpr double along_normal = 0.5;
    for (const unsigned int v : geometry.vertex_indices(cell))
      for (const unsigned int other : occupancy.cells_at(v))
        for (unsigned int f = 0; f <= dim; ++f)
          if (geometry.neighbours(other)[f] == SimplexGeometry<dim>::no_cell)
            {
              const Tensor<1, dim> g      = geometry.gradients(other)[f];
              const auto           lambda = geometry.barycentric(other, x);
              if (std::abs(lambda[f]) > near_wall ||
                  -(g * beyond) > along_normal * g.norm() * beyond.norm())
                continue;
              const auto on_face =
                geometry.barycentric(other,
                                     x - lambda[f] / g.norm_square() * g);
              if (*std::min_element(on_face.begin(), on_face.end()) <
                  -rounding::places)
                continue;
              normals.push_back(g / g.norm());
              on_walls -=
                geometry.barycentric(other, on_walls)[f] / g.norm_square() * g;
            }
  }



  template <int dim>
  bool
  WallsAtPlace<dim>::are_those_of(const unsigned int cell) const
  {
    if (normals.empty())
      return true;
    const auto   lambda = geometry.barycentric(cell, on_walls);
    const double size   = cell_size(geometry, cell);
    for (unsigned int v = 0; v <= dim; ++v)
      if (std::abs(lambda[v]) > rounding::places)
        for (const Tensor<1, dim> &n : normals)
          if (std::abs(n *
                       (geometry.vertices()[geometry.vertex_indices(cell)[v]] -
                        on_walls)) > rounding::places * size)
            return false;
    return true;
  }



  template class WallsAtPlace<2>;
  template class WallsAtPlace<3>;
} // namespace isochor
