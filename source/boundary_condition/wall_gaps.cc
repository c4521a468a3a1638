/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/wall_gaps.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace isochor
{
  namespace
  {
    template <int dim>
    class GapSearch
    {
    public:
      GapSearch(const StepContext<dim>               &step,
                const NodalField *const               unknowns,
                const std::vector<WallContacts<dim>> &walls,
                const bool                            spheres)
        : step(step)
        , geometry(step.grid.geometry())
        , unknowns(unknowns)
        , spheres(spheres)
      {
        for (unsigned int w = 0; w < walls.size(); ++w)
          for (const auto &node : walls[w].nodes)
            {
              nodes.push_back(node);
              wall_of.push_back(w);
            }
        chain();
        find_places();
        found.cell_size.assign(nodes.size(), WallGaps::unknown);
        for (unsigned int k = 0; k < step.points.cell.size(); ++k)
          for (unsigned int q = step.points.cell_start[k];
               q < step.points.cell_start[k + 1];
               ++q)
            look_at_point(k, q);
        Utilities::MPI::min(found.cell_size,
                            step.grid.communicator(),
                            found.cell_size);
      }

      WallGaps
      find()
      {
        // each makes up for a good part of what gaps are too small by
        constexpr unsigned int most_rounds = 12;
        // of a cell: what no longer counts, and what rounding leaves of nothing
        constexpr double enough = 1e-3, rounding = 1e-6;
        // cells: a surface is hardly steeper within those at a node, and one
        // that acts on the node by a millionth would let it go without end
        constexpr double most = 2;
        found.gap.assign(nodes.size(), WallGaps::unknown);
        std::vector<double> least;
        bool                grows = true;
        for (unsigned int round = 0; round < most_rounds && grows; ++round)
          {
            const std::vector<double> more = growth(round == 0);
            grows                          = (round == 0);
            for (unsigned int i = 0; i < nodes.size(); ++i)
              if (more[i] != WallGaps::unknown)
                {
                  const double before = (round == 0 ? 0. : found.gap[i]);
                  found.gap[i]        = before + more[i];
                  if (round > 0)
                    found.gap[i] =
                      std::min(found.gap[i],
                               least[i] + most * found.cell_size[i]);
                  grows = grows ||
                          found.gap[i] - before > enough * found.cell_size[i];
                }
            if (round == 0)
              least = found.gap;
          }
        for (unsigned int i = 0; i < nodes.size(); ++i)
          if (std::abs(found.gap[i]) < rounding * found.cell_size[i])
            found.gap[i] = 0;
        return found;
      }

    private:
      using Node                         = typename WallContacts<dim>::Node;
      static constexpr unsigned int none = numbers::invalid_unsigned_int;
      /** A corner hardly beyond a node, by chance, doesn't act on the next one.
       */
      static constexpr double no_support = 0.01, least_weight = 1e-6;

      /** A corner near a wall: the nodes of the wall that act on it are those
       * of @p part from @p first on up to the first of the next corner. */
      struct Corner
      {
        std::size_t first;
        double      gap;
      };
      struct Part
      {
        unsigned int node;
        double       weight;
      };

      /** By vertex the nodes of walls there: there may be several, with other
       * normals. */
      void
      chain()
      {
        next.assign(nodes.size(), none);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            next[i]                = first_at(nodes[i].vertex);
            first[nodes[i].vertex] = i;
          }
      }

      /** The first node of a wall at a vertex. */
      unsigned int
      first_at(const unsigned int vertex) const
      {
        const auto at = first.find(vertex);
        return at == first.end() ? none : at->second;
      }

      /** Where the nodes are: on a grid that is kept those know that have a
       * cell with points there, at the end of the step those that are active.
       * Others have no gap. */
      void
      find_places()
      {
        for (const Node &node : nodes)
          place.push_back(geometry.vertices()[node.vertex]);
        if (!step.grid_is_kept && unknowns == nullptr)
          return;
        std::vector<double> x(dim * nodes.size(), -WallGaps::unknown);
        const auto          is_active = [&](const unsigned int i) {
          return step.nodes.node(nodes[i].vertex) < step.nodes.n_local();
        };
        const auto set = [&](const unsigned int i, Point<dim> at) {
          at += increment(nodes[i].vertex);
          for (unsigned int a = 0; a < dim; ++a)
            x[dim * i + a] = at[a];
        };
        if (!step.grid_is_kept)
          for (unsigned int i = 0; i < nodes.size(); ++i)
            if (is_active(i))
              set(i, place[i]);
        // points in a cell may see the functions of others only
        if (step.grid_is_kept)
          for (unsigned int k = 0; k < step.points.cell.size(); ++k)
            for (unsigned int v = 0; v <= dim; ++v)
              for (unsigned int i =
                     first_at(geometry.vertex_indices(step.points.cell[k])[v]);
                   i != none;
                   i = next[i])
                if (unknowns == nullptr || is_active(i))
                  set(i, step.points.corner(geometry, k, v));
        Utilities::MPI::max(x, step.grid.communicator(), x);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int a = 0; a < dim; ++a)
            place[i][a] = x[dim * i + a];
      }

      /** By how much the gaps may grow; all of them, @p from_nothing: by the
       * least distance. */
      std::vector<double>
      growth(const bool from_nothing) const
      {
        std::vector<double> more(nodes.size(), WallGaps::unknown);
        for (unsigned int c = 0; c < corners.size(); ++c)
          {
            const std::size_t begin = corners[c].first,
                              end =
                                (c + 1 < corners.size() ? corners[c + 1].first :
                                                          parts.size());
            double slack = corners[c].gap;
            if (!from_nothing)
              for (std::size_t t = begin; t < end; ++t)
                slack -= parts[t].weight * found.gap[parts[t].node];
            for (std::size_t t = begin; t < end; ++t)
              more[parts[t].node] =
                std::min(more[parts[t].node],
                         from_nothing ? slack :
                                        std::max(slack, 0.) /
                                          (parts[t].weight * (end - begin)));
          }
        Utilities::MPI::min(more, step.grid.communicator(), more);
        return more;
      }

      Tensor<1, dim>
      increment(const unsigned int vertex) const
      {
        return unknowns == nullptr ?
                 Tensor<1, dim>() :
                 NodalUnknowns<dim>(step, *unknowns).increment(vertex);
      }

      void
      look_at_point(const unsigned int k, const unsigned int q)
      {
        const PointArrays<dim> &points = step.points;
        const bool              has_domain =
          k < points.n_occupied_cells && !points.domain.empty();
        const bool is_exact = !points.displacement.empty();
        if (!points.domain.empty() && !is_exact && !step.grid_is_kept)
          {
            if (has_domain)
              for (const Tensor<1, dim> &r : points.domain[q])
                look_at_corner(k, q, points.F[q] * r);
            return;
          }
        const auto stencil = points.stencil(geometry, k, q);
        bool       is_near = false;
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          is_near = is_near || first_at(stencil.vertex[I]) != none;
        if (!is_near)
          return;
        const Point<dim> x = points.location(geometry, k, q);
        if (has_domain)
          for (const Tensor<1, dim> &r : points.domain[q])
            look_at_place(k, stencil, x, points.F[q] * r, 0. * points.F[q]);
        else if (spheres)
          {
            // massless points have no volume but that which they integrate
            const double V = (k < points.n_occupied_cells ? points.volume[q] :
                                                            points.weight[q]);
            const double radius = 0.75 * std::pow(V, 1. / dim);
            look_at_place(
              k, stencil, x, Tensor<1, dim>(), radius * points.F[q]);
          }
      }

      /** Let the nodes of the @p stencil of a point at @p x know of the place
       * x + @p r, with the sphere of unit radius that @p extent makes an
       * ellipsoid around it. */
      void
      look_at_place(const unsigned int                        k,
                    const typename PointArrays<dim>::Stencil &stencil,
                    const Point<dim>                         &x,
                    const Tensor<1, dim>                     &r,
                    const Tensor<2, dim>                     &extent)
      {
        const bool is_exact = !step.points.displacement.empty();
        Point<dim> at       = x + r;
        near.clear();
        support.clear();
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          {
            const unsigned int vertex = stencil.vertex[I];
            const double       N = stencil.shape[I] + stencil.gradient[I] * r;
            at += N * increment(vertex);
            if (N > no_support || !is_exact)
              add_support(vertex, N);
          }
        const double size = cell_size(geometry, step.points.cell[k]);
        while (!near.empty())
          add_corner(at, extent, size);
      }

      /** As look_at_place() for the corner at @p r from point q, which moves by
       * the functions of the cell that the point lies in, by those of the cell
       * that the corner lies in. */
      void
      look_at_corner(const unsigned int    k,
                     const unsigned int    q,
                     const Tensor<1, dim> &r)
      {
        constexpr double       rounding = 1e-10;
        constexpr unsigned int furthest = 64; // cells from the point
        Point<dim>             x    = step.points.location(geometry, k, q) + r;
        unsigned int           cell = step.points.cell[k];
        auto                   lambda = geometry.barycentric(cell, x);
        for (unsigned int n = 0; n < furthest; ++n)
          {
            const auto least = std::min_element(lambda.begin(), lambda.end());
            const unsigned int beyond =
              geometry.neighbours(cell)[least - lambda.begin()];
            if (*least >= -rounding || beyond == SimplexGeometry<dim>::no_cell)
              break;
            cell   = beyond;
            lambda = geometry.barycentric(cell, x);
          }
        typename ShapeFunctions<dim>::Values at;
        step.grid.shape_functions().evaluate(cell, lambda, at);
        near.clear();
        support.clear();
        for (unsigned int I = 0; I < at.n_nodes; ++I)
          if (at.shape[I] > no_support)
            add_support(at.vertex[I], at.shape[I]);
        if (near.empty())
          return;
        if (unknowns != nullptr)
          {
            const auto stencil = step.points.stencil(geometry, k, q);
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              x += (stencil.shape[I] + stencil.gradient[I] * r) *
                   increment(stencil.vertex[I]);
          }
        const double size = cell_size(geometry, cell);
        while (!near.empty())
          add_corner(x, Tensor<2, dim>(), size);
      }

      /** The node at @p vertex acts by @p N on the place that is looked at. */
      void
      add_support(const unsigned int vertex, const double N)
      {
        support.push_back(vertex);
        for (unsigned int i = first_at(vertex); i != none; i = next[i])
          if (place[i][0] != -WallGaps::unknown)
            near.push_back({i, std::max(N, least_weight)});
      }

      /** Whether a place with the nodes of support is in a cell behind the wall
       * at @p node: where a wall ends, the body may be beside it. */
      bool
      is_behind(const Node &node, const double size) const
      {
        // of a cell; curved walls bend away by less
        constexpr double considerable = 0.25;
        const auto      &x            = geometry.vertices();
        return std::any_of(support.begin(),
                           support.end(),
                           [&](const unsigned int v) {
                             return node.normal * (x[v] - x[node.vertex]) <
                                    -considerable * size;
                           });
      }

      /** Take the nodes of one wall out of those that are near. */
      void
      add_corner(const Point<dim>     &at,
                 const Tensor<2, dim> &extent,
                 const double          size)
      {
        constexpr double     same    = 1e-8;
        const unsigned int   of_wall = wall_of[near.back().node];
        const Tensor<1, dim> n       = nodes[near.back().node].normal;
        const auto           others =
          std::partition(near.begin(), near.end(), [&](const Part &part) {
            return wall_of[part.node] != of_wall ||
                   nodes[part.node].normal * n < 1 - same;
          });
        if (is_behind(nodes[near.back().node], size))
          {
            near.erase(others, near.end());
            return;
          }
        double sum = 0;
        for (auto part = others; part != near.end(); ++part)
          sum += part->weight;
        Corner corner{parts.size(), -(transpose(extent) * n).norm()};
        for (auto part = others; part != near.end(); ++part)
          {
            const Node  &node   = nodes[part->node];
            const double weight = part->weight / sum;
            corner.gap +=
              weight * (n * (at - place[part->node]) + node.distance);
            parts.push_back({part->node, weight});
            found.cell_size[part->node] =
              std::min(found.cell_size[part->node], size);
          }
        corners.push_back(corner);
        near.erase(others, near.end());
      }

      const StepContext<dim>                        &step;
      const SimplexGeometry<dim>                    &geometry;
      const NodalField *const                        unknowns;
      const bool                                     spheres;
      std::vector<Node>                              nodes;
      std::vector<unsigned int>                      wall_of, next, support;
      std::unordered_map<unsigned int, unsigned int> first;
      std::vector<Point<dim>>                        place;
      std::vector<Corner>                            corners;
      std::vector<Part>                              parts, near;
      WallGaps                                       found;
    };
  } // namespace



  template <int dim>
  WallGaps
  find_wall_gaps(const StepContext<dim>               &step,
                 const NodalField *const               unknowns,
                 const std::vector<WallContacts<dim>> &walls,
                 const bool                            spheres)
  {
    return GapSearch<dim>(step, unknowns, walls, spheres).find();
  }



  template <int dim>
  void
  BodyAtWalls<dim>::add(const StepContext<dim>        &step,
                        const bool                     may_be,
                        const WallContacts<dim>       &wall,
                        const std::vector<WallNode *> &nodes_of_wall,
                        const int                      side)
  {
    for (WallNode *const node : nodes_of_wall)
      {
        node->body_gap    = gap_unknown;
        node->starts_free = false;
      }
    if (!may_be || step.grid_is_kept || step.has_inertia)
      return;
    walls.push_back(wall);
    nodes.insert(nodes.end(), nodes_of_wall.begin(), nodes_of_wall.end());
    sides.resize(nodes.size(), side);
  }



  /** Tell if the body is beyond a wall. At t = 0 it may have been put there. */
  template <int dim>
  static void
  warn_of_passage(const StepContext<dim>               &step,
                  const std::vector<WallContacts<dim>> &walls,
                  const WallGaps                       &found)
  {
    constexpr double considerable = 0.1; // of a cell
    double           depth = 0, part = 0;
    std::string      boundary;
    unsigned int     i = 0;
    for (const auto &wall : walls)
      for (unsigned int k = 0; k < wall.nodes.size(); ++k, ++i)
        if (-found.gap[i] > part * found.cell_size[i])
          {
            depth    = -found.gap[i];
            part     = depth / found.cell_size[i];
            boundary = wall.boundary;
          }
    if (part <= considerable || step.old_time <= 0)
      return;
    step.warnings.add(
      "a body that went through a wall",
      "At t = " + rounded(step.old_time) + " the body is " + rounded(depth) +
        " m, " + rounded(part) + " cells, beyond the one-sided wall <" +
        boundary +
        ">: in the step before it slid or rolled on to nodes that it was far "
        "away from, or fell through cells that it hardly filled. This step "
        "takes it back, but the force at that time was too small (by 17 % where a "
        "seal was pressed by 15 % in a single step). Take smaller steps "
        "(<Time/Step size>).");
  }



  template <int dim>
  void
  BodyAtWalls<dim>::find(const StepContext<dim> &step)
  {
    if (walls.empty())
      return;
    constexpr double near  = 0.05; // of a cell
    const WallGaps   found = find_wall_gaps(step, nullptr, walls, false);
    unsigned int     first = 0;
    for (const auto &wall : walls)
      {
        const unsigned int end   = first + wall.nodes.size();
        double             least = WallGaps::unknown;
        for (unsigned int i = first; i < end; ++i)
          least = std::min(least, found.gap[i]);
        for (unsigned int i = first; i < end; ++i)
          if (found.gap[i] != WallGaps::unknown)
            {
              nodes[i]->body_gap = sides[i] * found.gap[i];
              nodes[i]->starts_free =
                !nodes[i]->held_body &&
                found.gap[i] > std::max(least, 0.) + near * found.cell_size[i];
            }
        first = end;
      }
    warn_of_passage(step, walls, found);
  }



  template class BodyAtWalls<2>;
  template class BodyAtWalls<3>;
  template WallGaps
  find_wall_gaps(const StepContext<2> &,
                 const NodalField *const,
                 const std::vector<WallContacts<2>> &,
                 const bool);
  template WallGaps
  find_wall_gaps(const StepContext<3> &,
                 const NodalField *const,
                 const std::vector<WallContacts<3>> &,
                 const bool);
} // namespace isochor
