/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/base/rounding.h>
#include <isochor/boundary_condition/wall_joints.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Whether formulas of displacements agree at @p x at @p t, but for the
     * rounding of them and of the place; or have no value there. */
    template <int dim>
    bool
    agree(const Expression<dim> &first,
          const Expression<dim> &second,
          const Point<dim>      &x,
          const double           t)
    {
      try
        {
          const double a = first(x, t), b = second(x, t);
          return std::abs(a - b) <=
                 rounding::accumulated * std::max(std::abs(a), std::abs(b)) +
                   rounding::arithmetic * x.norm();
        }
      catch (const ExceptionBase &)
        {
          return true;
        }
    }
  } // namespace



  template <int dim>
  bool
  WallJoints<dim>::do_the_same(const unsigned int first,
                               const unsigned int second,
                               const unsigned int vertex) const
  {
    AssertIndexRange(first, walls.size());
    AssertIndexRange(second, walls.size());
    const SmoothWall<dim> &a = walls[first], &b = walls[second];
    if (a.formula == b.formula)
      return true;
    const Point<dim> &x = reference[vertex];
    if (!agree(a.displacement, b.displacement, x, 0.))
      return false;
    // twenty times a decade, from a microsecond to a week
    for (double t = 1e-6; t < 1e6; t *= std::pow(10., 0.05))
      if (!agree(a.displacement, b.displacement, x, t))
        return false;
    return true;
  }



  template <int dim>
  WallSurface<dim>
  WallJoints<dim>::surface(const BackgroundGrid<dim> &grid,
                           const unsigned int         w) const
  {
    AssertIndexRange(w, walls.size());
    std::vector<types::boundary_id> ids;
    for (const SmoothWall<dim> &wall : walls)
      ids.push_back(grid.boundary_id(wall.boundary, parameter));
    WallSurface<dim> surface;
    surface.initialize(grid, ids, w, [this](auto i, auto j, auto vertex) {
      return do_the_same(i, j, vertex);
    });
    return surface;
  }



  template class WallJoints<2>;
  template class WallJoints<3>;
} // namespace isochor
