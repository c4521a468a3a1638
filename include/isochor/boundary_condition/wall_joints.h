/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_wall_joints_h
#define isochor_wall_joints_h

#include <isochor/boundary_condition/smooth_wall.h>

#include <string>
#include <vector>

namespace isochor
{
  /** Walls of one parameter that meet: a wall may be named in pieces. */
  template <int dim>
  class WallJoints
  {
  public:
    /**
     * @p reference: the vertices at t = 0, where formulas are evaluated;
     * @p parameter names the walls.
     * The references have to outlive this.
     */
    WallJoints(const std::vector<SmoothWall<dim>> &walls,
               const std::vector<Point<dim>>      &reference,
               const std::string                  &parameter)
      : walls(walls)
      , reference(reference)
      , parameter(parameter)
    {}

    /** Number @p w of the walls, where the vertices of @p grid are now; it goes
     * on in others that do the same at the vertices in common. */
    WallSurface<dim>
    surface(const BackgroundGrid<dim> &grid, const unsigned int w) const;

  private:
    /** Whether two walls move alike at @p vertex, as far as values of their
     * formulas at many times tell. */
    bool
    do_the_same(const unsigned int first,
                const unsigned int second,
                const unsigned int vertex) const;

    const std::vector<SmoothWall<dim>> &walls;
    const std::vector<Point<dim>>      &reference;
    std::string                         parameter;
  };
} // namespace isochor

#endif
