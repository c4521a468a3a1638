/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_prescribed_component_h
#define isochor_prescribed_component_h

#include <isochor/base/expression.h>
#include <isochor/boundary_condition/contact_search.h>
#include <isochor/boundary_condition/wall_gaps.h>
#include <isochor/boundary_condition/wall_passage.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
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
    /** Of one that is held: the sign of the component of the normal into the
     * grid, if it stands across the component; else 0. */
    int inward = 0;
    /** Whether the displacement depends on x, y or z. */
    bool depends_on_place = false;

    /** The walls at t = 0, with the vertices of the grid at @p reference. A
     * node in one is pushed out by the first step. */
    void
    place_walls(const std::vector<Point<dim>> &reference,
                const BackgroundGrid<dim>     &grid)
    {
      wall.assign(vertices.size(), WallNode());
      for (unsigned int i = 0; i < vertices.size(); ++i)
        {
          WallNode &node = wall[i];
          node.gap       = -displacement(reference[vertices[i]], 0.);
          node.layer     = grid.layer_of_vertex(vertices[i]);
          node.touched   = (node.gap == 0);
          node.released = node.was_released = (side * node.gap > 0);
        }
    }

    /** Whether the boundary stands across the component that it holds, with
     * the vertices of the grid at t = 0 at @p reference. */
    bool
    is_level(const std::vector<Point<dim>> &reference) const
    {
      constexpr double rounding = 1e-8;
      double           low      = std::numeric_limits<double>::max(),
             high               = std::numeric_limits<double>::lowest();
      for (const unsigned int v : vertices)
        {
          low  = std::min(low, reference[v][component]);
          high = std::max(high, reference[v][component]);
        }
      double extent = 0;
      for (const unsigned int v : vertices)
        extent =
          std::max(extent, reference[v].distance(reference[vertices[0]]));
      return high - low <= rounding * extent;
    }

    /** Set inward, given the @p faces that the condition holds. */
    void
    find_inward(const std::vector<Point<dim>>   &reference,
                const SimplexGeometry<dim>      &geometry,
                const std::vector<BoundaryFace> &faces)
    {
      inward = 0;
      if (vertices.empty() || !is_level(reference))
        return;
      for (const BoundaryFace &face : faces)
        {
          const unsigned int v =
            geometry.vertex_indices(face.cell)[face.opposite_vertex];
          const int sign =
            (reference[v][component] > reference[vertices[0]][component] ? 1 :
                                                                           -1);
          inward = (inward == 0 || inward == sign ? sign : 2);
        }
      if (inward == 2)
        inward = 0;
    }

    /** Towards the body, for walls and where inward is known. */
    Tensor<1, dim>
    normal() const
    {
      Tensor<1, dim> n;
      n[component] = (side != 0 ? side : inward);
      return n;
    }

    /** How far the vertices are from their wall at the start of @p step, along
     * its normal. */
    double
    distance_of_vertex(const unsigned int             i,
                       const std::vector<Point<dim>> &reference,
                       const StepContext<dim>        &step) const
    {
      const Point<dim> &X = reference[vertices[i]];
      const Point<dim> &x = step.grid.geometry().vertices()[vertices[i]];
      // nothing is held before the first step
      const double u =
        (side == 0 && step.old_time == 0. ? 0. :
                                            displacement(X, step.old_time));
      return normal()[component] * (x[component] - X[component] - u);
    }

    /** The least and the most that has moved the vertices before @p step, along
     * the component beyond what moves the grid (m), and 0. */
    std::array<double, 2>
    push(const std::vector<Point<dim>> &reference,
         const StepContext<dim>        &step) const
    {
      std::array<double, 2> range{};
      for (const unsigned int v : vertices)
        {
          const double way = displacement(reference[v], step.old_time) -
                             (step.grid.geometry().vertices()[v][component] -
                              reference[v][component]);
          range[0] = std::min(range[0], way);
          range[1] = std::max(range[1], way);
        }
      return range;
    }

    /** How far a vertex that is held is from its wall at the end of the step.
     * Where nothing is known of the body it counts as one at its wall. */
    double
    distance_of_held(const unsigned int             i,
                     const std::vector<Point<dim>> &reference,
                     const StepContext<dim>        &step) const
    {
      if (side == 0)
        return step.grid_is_kept ? 0. : distance_of_vertex(i, reference, step);
      return wall[i].knows_body() ? distance_of_vertex(i, reference, step) -
                                      side * wall[i].body_gap :
                                    0.;
    }

    /** Let the nodes of a wall know where the @p body is. */
    void
    add_to(BodyAtWalls<dim>              &body,
           const std::vector<Point<dim>> &reference,
           const StepContext<dim>        &step)
    {
      WallContacts<dim>       contacts{"", boundary, {}};
      std::vector<WallNode *> nodes;
      for (unsigned int i = 0; i < wall.size(); ++i)
        {
          contacts.nodes.push_back({vertices[i],
                                    normal(),
                                    0.,
                                    distance_of_vertex(i, reference, step)});
          nodes.push_back(&wall[i]);
        }
      if (side != 0)
        body.add(step, is_level(reference), contacts, nodes, side);
    }

    /** Append the wall, if it is one, flat and faces into the grid. */
    void
    append_wall(const std::string              &parameter,
                const std::vector<Point<dim>>  &reference,
                const StepContext<dim>         &step,
                std::vector<OneSidedWall<dim>> &walls) const
    {
      // (inward is 0 where the boundary isn't across the component)
      if (side == 0 || inward != side || boundary == "everywhere")
        return;
      constexpr double  far = std::numeric_limits<double>::max();
      OneSidedWall<dim> result{
        parameter, boundary, normal(), vertices, far, far, -far};
      for (const unsigned int v : vertices)
        {
          const Point<dim> &X = reference[v];
          const double      before =
            side * (X[component] + displacement(X, step.old_time));
          result.at_start      = std::min(result.at_start, before);
          result.most_at_start = std::max(result.most_at_start, before);
          result.at_end =
            std::min(result.at_end,
                     side * (X[component] + displacement(X, step.time)));
        }
      walls.push_back(result);
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
              if (distance < best && wall[i].layer == old.wall[j].layer)
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

  /** A vertex that several of the @p conditions hold the same component of is
   * that of the last one. */
  template <int dim>
  void
  leave_vertices_to_later(std::vector<PrescribedComponent<dim>> &conditions)
  {
    std::array<std::set<unsigned int>, dim> taken;
    for (auto condition = conditions.rbegin(); condition != conditions.rend();
         ++condition)
      {
        auto &vertices = condition->vertices;
        auto &by_later = taken[condition->component];
        vertices.erase(std::remove_if(vertices.begin(),
                                      vertices.end(),
                                      [&](const unsigned int v) {
                                        return by_later.count(v) != 0;
                                      }),
                       vertices.end());
        by_later.insert(vertices.begin(), vertices.end());
      }
  }
} // namespace isochor

#endif
