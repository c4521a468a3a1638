/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_smooth_wall_h
#define isochor_smooth_wall_h

#include <isochor/base/expression.h>
#include <isochor/boundary_condition/boundary_checks.h>
#include <isochor/boundary_condition/contact_search.h>
#include <isochor/boundary_condition/wall_gaps.h>
#include <isochor/boundary_condition/wall_passage.h>
#include <isochor/boundary_condition/wall_surface.h>
#include <isochor/equations/equation_term.h>
#include <isochor/grid/prescribed_motion.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace isochor
{
  /** A smooth wall at a side of the grid, and what it knows of its nodes. */
  template <int dim>
  struct SmoothWall
  {
    /** A node at a wall, and one of its normals; the same on all ranks. */
    struct Node
    {
      unsigned int   vertex;
      Tensor<1, dim> normal;    ///< at the vertex
      unsigned int   layer = 0; ///< of the grid
      WallNode       contact;
      /** At a curved wall: how far the wall has come along its normal since the
       * last reset, from the boundary (m), and the node (m); and the normal and
       * the gap where it is now. */
      double         offset = 0;
      Tensor<1, dim> moved, normal_now;
      double         gap_now = 0;
    };

    /** A node that knows nothing of the wall yet. */
    static Node
    node_at(const unsigned int         vertex,
            const Tensor<1, dim>      &normal,
            const BackgroundGrid<dim> &grid)
    {
      Node node;
      node.vertex = vertex;
      node.normal = normal;
      node.layer  = grid.layer_of_vertex(vertex);
      return node;
    }

    std::string       boundary;
    bool              one_sided;
    std::string       formula; ///< of the displacement (m), without blanks
    Expression<dim>   displacement;
    WallSurface<dim>  surface;
    std::vector<Node> nodes;

    /** As it is in the parameter. */
    std::string
    condition() const
    {
      return std::string(one_sided ? "n >= " : "n = ") + formula;
    }

    void
    add_vertices(std::vector<unsigned int> &vertices) const
    {
      for (const Node &node : nodes)
        vertices.push_back(node.vertex);
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

    /** How far a node is from the wall at the start of the step. A grid that
     * moves takes the wall along. */
    double
    distance_of_vertex(const unsigned int             i,
                       const std::vector<Point<dim>> &reference,
                       const StepContext<dim>        &step) const
    {
      // nothing is held before the first step
      const double time = (step.grid.is_moving() ? 0. : step.old_time);
      return !one_sided && time == 0. ?
               0. :
               -displacement(reference[nodes[i].vertex], time);
    }

    /** The same at the end of the step, of one that is held. Where nothing is
     * known of the body it counts as one at its wall. */
    double
    distance_of_held(const unsigned int             i,
                     const std::vector<Point<dim>> &reference,
                     const StepContext<dim>        &step) const
    {
      if (!one_sided)
        return step.grid_is_kept ? 0. : distance_of_vertex(i, reference, step);
      const WallNode &contact = nodes[i].contact;
      return contact.knows_body() ?
               distance_of_vertex(i, reference, step) - contact.body_gap :
               0.;
    }

    /** Whether what a step along tangents of a curved wall has left of a
     * distance is taken back by the next one, where the grid is put back. */
    bool
    takes_back(const StepContext<dim> &step) const
    {
      return !one_sided && !surface.is_flat() && !step.grid.is_moving() &&
             !step.has_inertia;
    }

    /** Whether it is to be looked at if it acts before the body reaches it. */
    bool
    is_judged() const
    {
      return one_sided || surface.is_flat();
    }

    /** Of a flat wall: whether a grid that moves leaves its normal as it is. */
    bool
    is_along_axis() const
    {
      constexpr double rounding = 1e-8;
      double           largest  = 0;
      for (unsigned int a = 0; a < dim && !nodes.empty(); ++a)
        largest = std::max(largest, std::abs(nodes[0].normal[a]));
      return largest > 1 - rounding;
    }

    /** Let the nodes of a wall know where the @p body is. */
    void
    add_to(BodyAtWalls<dim>              &body,
           const std::vector<Point<dim>> &reference,
           const StepContext<dim>        &step)
    {
      WallContacts<dim>       contacts{"", boundary, {}};
      std::vector<WallNode *> known;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          contacts.nodes.push_back({nodes[i].vertex,
                                    nodes[i].normal,
                                    0.,
                                    distance_of_vertex(i, reference, step)});
          known.push_back(&nodes[i].contact);
        }
      if (one_sided)
        body.add(step,
                 surface.is_flat() &&
                   (!step.grid.is_moving() || is_along_axis()),
                 contacts,
                 known,
                 1);
    }

    /** Append the wall, if it only pushes and is a plane. A grid that moves
     * takes the wall along, to where isn't looked. */
    void
    append_wall(const std::string              &parameter,
                const std::vector<Point<dim>>  &reference,
                const StepContext<dim>         &step,
                std::vector<OneSidedWall<dim>> &walls) const
    {
      constexpr double rounding = 1e-8;
      if (!one_sided || nodes.empty() || !surface.is_flat() ||
          step.grid.is_moving())
        return;
      constexpr double     far   = std::numeric_limits<double>::max();
      const Tensor<1, dim> n     = nodes[0].normal;
      const Point<dim>    &first = reference[nodes[0].vertex];
      OneSidedWall<dim>    result{parameter, boundary, n, {}, far, far, -far};
      for (const Node &node : nodes)
        {
          const Point<dim> &X = reference[node.vertex];
          if (node.normal * n < 1 - rounding ||
              std::abs(n * (X - first)) > rounding * X.distance(first))
            return;
          result.vertices.push_back(node.vertex);
          const double before  = n * X + displacement(X, step.old_time);
          result.at_start      = std::min(result.at_start, before);
          result.most_at_start = std::max(result.most_at_start, before);
          result.at_end =
            std::min(result.at_end, n * X + displacement(X, step.time));
        }
      walls.push_back(result);
    }

    /** Tell if the wall of @p parameter has pushed the body out of the row of
     * cells there, which has been put back since. */
    void
    warn_if_body_is_lost(const std::string             &parameter,
                         const std::vector<Point<dim>> &reference,
                         const StepContext<dim>        &step) const
    {
      double push = 0; // as far as it came before this step
      for (const Node &node : nodes)
        push =
          std::max(push, displacement(reference[node.vertex], step.old_time));
      if (push <= 0)
        return;
      std::vector<OneSidedWall<dim>> walls;
      append_wall(parameter, reference, step, walls);
      if (!is_far_from_walls(step, walls))
        warn_of_body_left_behind(step,
                                 boundary,
                                 parameter + " = " + boundary + ": n = ...",
                                 push);
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
          if (!one_sided)
            continue;
          node.contact = nearest->contact;
          if (!node.contact.touched)
            node.contact.gap +=
              displacement(old_reference[nearest->vertex], 0.) -
              displacement(x, 0.);
        }
    }

    /** How far (m) the wall comes in the step along its normal, at @p x. */
    double
    motion(const Point<dim> &x, const StepContext<dim> &step) const
    {
      if (!one_sided)
        return prescribed_increment(displacement, x, step.old_time, step.time);
      return displacement(x, step.time) - displacement(x, step.old_time);
    }

    /** The displacement (m) in the step along @p normal of @p node, on a rank
     * that has it. */
    static double
    along(const Tensor<1, dim>   &normal,
          const unsigned int      node,
          const StepContext<dim> &step,
          const NodalField       &unknowns)
    {
      double sum = 0;
      for (unsigned int a = 0; a < dim; ++a)
        sum += normal[a] * unknowns.local_element(node * step.n_components + a);
      return sum;
    }
  };
} // namespace isochor

#endif
