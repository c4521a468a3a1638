/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_prescribed_component_h
#define isochor_prescribed_component_h

#include <isochor/base/expression.h>
#include <isochor/boundary_condition/contact_search.h>

#include <limits>
#include <string>
#include <vector>

namespace isochor
{
  /** One component of the displacement that is prescribed on a boundary of the
   * grid, or bounded by a wall, and what it knows of its nodes; the same on all
   * ranks. */
  template <int dim>
  struct PrescribedComponent
  {
    std::string  boundary;
    unsigned int component;
    /** 0: held; 1: u >= displacement; -1: u <= displacement. */
    int                       side;
    Expression<dim>           displacement;
    std::vector<unsigned int> vertices;
    std::vector<WallNode>     wall; ///< by vertex, if one-sided

    /** The walls at t = 0, with the vertices of the grid at @p reference. A
     * node in one is pushed out by the first step. */
    void
    place_walls(const std::vector<Point<dim>> &reference)
    {
      wall.assign(vertices.size(), WallNode());
      for (unsigned int i = 0; i < vertices.size(); ++i)
        {
          WallNode &node = wall[i];
          node.gap       = -displacement(reference[vertices[i]], 0.);
          node.touched   = (node.gap == 0);
          node.released = node.was_released = (side * node.gap > 0);
        }
    }

    /** After a change of the grid: each node knows of its wall what the nearest
     * of @p old did; its gap is as much larger as its wall was further away at
     * t = 0. */
    void
    take_over_walls(const PrescribedComponent     &old,
                    const std::vector<Point<dim>> &old_reference,
                    const std::vector<Point<dim>> &reference)
    {
      for (unsigned int i = 0; i < wall.size(); ++i)
        {
          const Point<dim> &x    = reference[vertices[i]];
          double            best = std::numeric_limits<double>::max();
          unsigned int      from = 0;
          for (unsigned int j = 0; j < old.wall.size() && best > 0; ++j)
            {
              const double distance =
                x.distance_square(old_reference[old.vertices[j]]);
              if (distance < best)
                {
                  best = distance;
                  from = j;
                }
            }
          if (best == std::numeric_limits<double>::max())
            continue;
          WallNode &node = wall[i];
          node           = old.wall[from];
          if (!node.touched)
            node.gap += displacement(old_reference[old.vertices[from]], 0.) -
                        displacement(x, 0.);
        }
    }
  };
} // namespace isochor

#endif
