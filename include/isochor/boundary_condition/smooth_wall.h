/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_smooth_wall_h
#define isochor_smooth_wall_h

#include <isochor/base/expression.h>
#include <isochor/boundary_condition/wall_surface.h>
#include <isochor/equations/equation_term.h>
#include <isochor/grid/prescribed_motion.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace isochor
{
  /** A smooth wall at a side of the grid that holds the body, and what it knows
   * of its nodes. */
  template <int dim>
  struct SmoothWall
  {
    /** A node at a wall, and one of its normals; the same on all ranks. */
    struct Node
    {
      unsigned int   vertex;
      Tensor<1, dim> normal;    ///< at the vertex
      unsigned int   layer = 0; ///< of the grid
      /** At a curved wall: how far the wall has come along its normal since the
       * last reset, from the boundary (m), and the node (m); and the normal and
       * the gap where it is now. */
      double         offset = 0;
      Tensor<1, dim> moved, normal_now;
      double         gap_now = 0;
    };

    std::string       boundary;
    std::string       formula; ///< of the displacement (m), without blanks
    Expression<dim>   displacement;
    WallSurface<dim>  surface;
    std::vector<Node> nodes;

    /** Those of the surface, which know nothing of the wall yet. */
    void
    make_nodes(const BackgroundGrid<dim> &grid)
    {
      nodes.clear();
      for (const auto &at : surface.nodes())
        {
          Node node;
          node.vertex = at.vertex;
          node.normal = at.normal;
          node.layer  = grid.layer_of_vertex(at.vertex);
          nodes.push_back(node);
        }
    }

    /** At a curved wall: normals and gaps where the nodes are now, with the
     * vertices of the grid at t = 0 at @p reference. */
    void
    locate_nodes(const std::vector<Point<dim>> &reference)
    {
      if (surface.is_flat())
        return;
      for (Node &node : nodes)
        {
          const auto place =
            surface.locate(reference[node.vertex] + node.moved,
                           node.normal_now.norm_square() > 0 ? node.normal_now :
                                                               node.normal);
          node.normal_now = place.normal;
          node.gap_now    = place.distance - node.offset;
        }
    }

    /** Whether what a step along tangents of a curved wall has left of a
     * distance is taken back by the next one, where the grid is put back. */
    bool
    takes_back(const StepContext<dim> &step) const
    {
      return !surface.is_flat() && !step.grid.is_moving() && !step.has_inertia;
    }

    /** How far the wall has come at @p time into the grid of t = 0 (m). */
    double
    largest_push(const std::vector<Point<dim>> &reference,
                 const double                   time) const
    {
      double push = 0;
      for (const Node &node : nodes)
        push = std::max(push, displacement(reference[node.vertex], time));
      return push;
    }

    /** After a change of the grid, whose vertices were at @p old_reference at
     * t = 0 and now are at @p reference: each node knows of its wall what the
     * nearest of @p old did. */
    void
    take_over(const SmoothWall              &old,
              const std::vector<Point<dim>> &old_reference,
              const std::vector<Point<dim>> &reference)
    {
      for (Node &node : nodes)
        {
          const Point<dim> &x       = reference[node.vertex];
          const auto        nearest = std::min_element(
            old.nodes.begin(),
            old.nodes.end(),
            [&](const Node &a, const Node &b) {
              if ((a.layer == node.layer) != (b.layer == node.layer))
                return a.layer == node.layer;
              return x.distance_square(old_reference[a.vertex]) <
                     x.distance_square(old_reference[b.vertex]);
            });
          if (nearest == old.nodes.end() || nearest->layer != node.layer)
            continue;
          node.gap_now = nearest->gap_now;
          node.offset  = -node.gap_now;
        }
    }

    /** How far (m) the wall comes in the step along its normal, at @p x. */
    double
    motion(const Point<dim> &x, const StepContext<dim> &step) const
    {
      return prescribed_increment(displacement, x, step.old_time, step.time);
    }
  };
} // namespace isochor

#endif
