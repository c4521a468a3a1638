/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/boundary_checks.h>
#include <isochor/boundary_condition/contact_search.h>
#include <isochor/boundary_condition/wall_passage.h>
#include <isochor/equations/nodal_unknowns.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  namespace
  {
    /** Cells that a wall may stand inside of the grid: the body is in the cells
     * of the boundary before it is at the wall. */
    constexpr double most_inside = 0.5;

    /** How far a wall at @p place stands from the furthest of its vertices
     * inside of the grid (m). */
    template <int dim>
    double
    distance_inside(const StepContext<dim>  &step,
                    const OneSidedWall<dim> &wall,
                    const double             place)
    {
      double furthest = std::numeric_limits<double>::lowest();
      for (const unsigned int v : wall.vertices)
        furthest =
          std::max(furthest, wall.normal * step.grid.geometry().vertices()[v]);
      return place - furthest;
    }



    /** What went through a wall. */
    struct Passage
    {
      double cells = 0, ///< by which it is behind the wall
        depth      = 0, ///< m
        unfelt     = 0; ///< 1: the wall did not act on it
    };



    template <int dim>
    class PassageSearch
    {
    public:
      PassageSearch(const StepContext<dim>  &step,
                    const NodalField        &unknowns,
                    const OneSidedWall<dim> &wall,
                    const double             largest_way,
                    const double             most_of_corners)
        : step(step)
        , geometry(step.grid.geometry())
        , nodal(step, unknowns)
        , wall(wall)
        , largest_way(largest_way)
        , most_of_corners(most_of_corners)
        , inside(std::max(distance_inside(step, wall, wall.at_end), 0.))
        , vertices(wall.vertices)
      {
        std::sort(vertices.begin(), vertices.end());
      }

      /** Cells by which this rank's material stays behind a wall that acts on
       * it, as nothing takes it back on a grid that is kept. */
      double
      stays_behind() const
      {
        return most_behind;
      }

      /** Of this rank's material, what has gone furthest through. */
      Passage
      find()
      {
        for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
          for (unsigned int q = step.points.cell_start[k];
               q < step.points.cell_start[k + 1];
               ++q)
            look_at_point(k, q);
        return furthest;
      }

    private:
      using Stencil = typename PointArrays<dim>::Stencil;
      /** Cells: what rounding errors and springs may leave of a passage. */
      static constexpr double nothing = 1e-3;

      void
      look_at_point(const unsigned int k, const unsigned int q)
      {
        const PointArrays<dim> &points = step.points;
        const Point<dim>        x      = points.location(geometry, k, q);
        const bool              has_corners =
          !points.domain.empty() && !points.displacement.empty();
        double lowest = 0;
        if (has_corners)
          for (const Tensor<1, dim> &r : points.domain[q])
            lowest = std::min(lowest, wall.normal * (points.F[q] * r));
        // hardly any point is near a wall
        if (wall.normal * x + lowest - largest_way > wall.at_end)
          return;
        const Stencil stencil = points.stencil(geometry, k, q);
        const double  size    = height_of_cell(points.cell[k]);
        // a point outside of the grid can't be located
        const double most_of_points =
          step.grid_is_kept ? most_of_corners : nothing;
        look_at_place(
          stencil, x, Tensor<1, dim>(), size, most_of_points * size + inside);
        if (has_corners)
          for (const Tensor<1, dim> &r : points.domain[q])
            look_at_place(
              stencil, x, points.F[q] * r, size, most_of_corners * size);
      }

      /** Of a cell, along the wall's normal (m). */
      double
      height_of_cell(const unsigned int cell) const
      {
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const unsigned int v : geometry.vertex_indices(cell))
          {
            const double place = wall.normal * geometry.vertices()[v];
            low                = std::min(low, place);
            high               = std::max(high, place);
          }
        return high - low;
      }

      /** The place @p x + @p r, with x the point of the @p stencil. If the wall
       * acts on it, it may be behind by @p most (m). */
      void
      look_at_place(const Stencil        &stencil,
                    const Point<dim>     &x,
                    const Tensor<1, dim> &r,
                    const double          size,
                    const double          most)
      {
        // of a node's displacement, what doesn't hold anything up
        constexpr double hardly = 0.01;
        double           part   = 0;
        Point<dim>       end    = x + r;
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          end += (stencil.shape[I] + stencil.gradient[I] * r) *
                 nodal.increment(stencil.vertex[I]);
        const double depth = wall.at_end - wall.normal * end;
        if (depth <= nothing * size ||
            depth <= std::min(furthest.cells, most_behind) * size)
          return;
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          if (std::binary_search(vertices.begin(),
                                 vertices.end(),
                                 stencil.vertex[I]))
            part += stencil.shape[I] + stencil.gradient[I] * r;
        const bool unfelt = part < hardly;
        if (step.grid_is_kept && !unfelt && depth > most_behind * size &&
            is_through(x + r, end, std::numeric_limits<double>::infinity()))
          most_behind = depth / size;
        if (depth > furthest.cells * size && (unfelt || depth > most) &&
            is_through(x + r, end, nothing * size))
          furthest = {depth / size, depth, unfelt ? 1. : 0.};
      }

      /** Whether the way from @p start to @p end begins in front of the wall or
       * of a face of its boundary, or behind both by @p slack (m) at most, and
       * meets it where that face is. */
      bool
      is_through(const Point<dim> &start,
                 const Point<dim> &end,
                 const double      slack)
      {
        const double before = wall.normal * start - wall.at_end,
                     behind = wall.normal * end - wall.at_end;
        // a wall inside of the grid, or one that moves, may have been past it
        Point<dim> crossing = start + std::max(before, 0.) /
                                        (std::max(before, 0.) - behind) *
                                        (end - start);
        for (const Period<dim> &period : wall.periods)
          crossing -= std::floor((period.shift * Tensor<1, dim>(crossing) -
                                  period.start) /
                                 period.shift.norm_square()) *
                      period.shift;
        for (const BoundaryFace &face : faces())
          {
            std::array<Point<dim>, dim> x;
            unsigned int                n = 0;
            for (unsigned int v = 0; v <= dim; ++v)
              if (v != face.opposite_vertex)
                x[n++] =
                  geometry.vertices()[geometry.vertex_indices(face.cell)[v]];
            if (std::max(before, wall.normal * (start - x[0])) >= -slack &&
                is_above(x, crossing))
              return true;
          }
        return false;
      }

      /** Whether @p place is on the face with the corners @p x, seen along its
       * normal. */
      static bool
      is_above(const std::array<Point<dim>, dim> &x, const Point<dim> &place)
      {
        // a place above the edge of two faces is above one of them
        constexpr double   rounding = 1e-6;
        Tensor<2, dim - 1> products;
        Tensor<1, dim - 1> right;
        for (unsigned int i = 0; i + 1 < dim; ++i)
          {
            right[i] = (x[i + 1] - x[0]) * (place - x[0]);
            for (unsigned int j = 0; j + 1 < dim; ++j)
              products[i][j] = (x[i + 1] - x[0]) * (x[j + 1] - x[0]);
          }
        const Tensor<1, dim - 1> weight = invert(products) * right;
        double                   first  = 1;
        bool                     inside = true;
        for (unsigned int i = 0; i + 1 < dim; ++i)
          {
            first -= weight[i];
            inside = inside && weight[i] >= -rounding;
          }
        return inside && first >= -rounding;
      }

      /** Those of the wall's boundary, which are rarely asked for. */
      const std::vector<BoundaryFace> &
      faces()
      {
        if (of_boundary.empty())
          {
            const types::boundary_id id =
              step.grid.boundary_id(wall.boundary, wall.parameter);
            for (const BoundaryFace &face : step.grid.boundary_faces())
              if (face.id == id)
                of_boundary.push_back(face);
          }
        return of_boundary;
      }

      const StepContext<dim>     &step;
      const SimplexGeometry<dim> &geometry;
      const NodalUnknowns<dim>    nodal;
      const OneSidedWall<dim>    &wall;
      const double                largest_way;
      /** Cells: what the next step takes back. */
      const double              most_of_corners;
      const double              inside;
      std::vector<unsigned int> vertices;
      std::vector<BoundaryFace> of_boundary;
      Passage                   furthest;
      double                    most_behind = 0;
    };



    /** @p cells: by which this rank's material stays behind the @p walls. */
    template <int dim>
    void
    warn_of_body_behind_walls(const StepContext<dim>               &step,
                              const std::vector<OneSidedWall<dim>> &walls,
                              std::vector<double>                   cells)
    {
      constexpr double much = 0.02;
      Utilities::MPI::max(cells, step.grid.communicator(), cells);
      for (unsigned int w = 0; w < walls.size(); ++w)
        if (cells[w] > much)
          step.warnings.add(
            "a body behind a wall",
            "At t = " + rounded(step.time) + " the body is " +
              rounded(cells[w]) + " cells behind the one-sided wall at <" +
              walls[w].boundary + "> of <" + walls[w].parameter +
              ">: on a grid that is kept, the wall holds only what was at the "
              "boundary when the grid was put back, and what came later only "
              "in part. Its force is too small. Put the grid back after each "
              "step (<Grid reset/Steps between resets = 1>), in statics with "
              "<Quadrature/Type = CPDI>: else a wall acts before the body "
              "reaches it then, by up to a cell, which smaller cells there "
              "make less. Keep the grid only where nothing comes to the wall "
              "that did not touch it at t = 0.");
    }
  } // namespace



  template <int dim>
  std::string
  passage_through_walls(const StepContext<dim>               &step,
                        const NodalField                     &unknowns,
                        const std::vector<OneSidedWall<dim>> &walls,
                        const bool                            may_be_cut)
  {
    // the next step takes back what is half a cell behind a wall, but in the
    // last one its force would be missing
    const double most_of_corners = may_be_cut ? 0.02 : 0.5;
    if (walls.empty())
      return {};
    // corners of domains may move by more than the nodes, but not by twice as
    // much
    const double way =
      2 * std::sqrt(double(dim)) * largest_increment(step, unknowns);
    std::vector<double> found, behind;
    for (const OneSidedWall<dim> &wall : walls)
      {
        PassageSearch<dim> search(step, unknowns, wall, way, most_of_corners);
        const Passage      passage = search.find();
        found.insert(found.end(),
                     {passage.cells, passage.depth, passage.unfelt});
        behind.push_back(search.stays_behind());
      }
    Utilities::MPI::max(found, step.grid.communicator(), found);
    if (step.grid_is_kept)
      warn_of_body_behind_walls(step, walls, behind);
    unsigned int most = 0;
    for (unsigned int w = 0; w < walls.size(); ++w)
      if (found[3 * w] > found[3 * most])
        most = w;
    if (found[3 * most] == 0)
      return {};
    const OneSidedWall<dim> &wall   = walls[most];
    const double             inside = distance_inside(step, wall, wall.at_end),
                 size =
                   side_of(step.grid, wall.boundary, wall.parameter).cell_size;
    return "the body goes through the one-sided wall <" + wall.boundary +
           "> (<" + wall.parameter + ">) within the step, by " +
           rounded(found[3 * most + 1]) + " m, " + rounded(found[3 * most]) +
           " cells, as its nodes " +
           (found[3 * most + 2] > 0 ? "did not act" : "hardly acted") +
           " on what was not in the cells of the boundary when the step began" +
           (inside > most_inside * size ?
              "; the wall stands " + rounded(inside) + " m, " +
                rounded(inside / size) +
                " cells, inside of the grid, so that smaller steps don't "
                "help: let the boundary of the grid be where the wall is" :
            step.grid_is_kept && !may_be_cut ?
              "; on a grid that is kept a body meets only what it was at when "
              "the grid was put back: <Grid reset/Steps between resets = 1>" :
              "");
  }



  template <int dim>
  bool
  is_far_from_walls(const StepContext<dim>               &step,
                    const std::vector<OneSidedWall<dim>> &walls)
  {
    bool far = !walls.empty();
    for (const OneSidedWall<dim> &wall : walls)
      {
        const double place =
          wall.most_at_start +
          side_of(step.grid, wall.boundary, wall.parameter).cell_size;
        for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
          for (unsigned int q = step.points.cell_start[k];
               far && q < step.points.cell_start[k + 1];
               ++q)
            far =
              wall.normal * step.points.location(step.grid.geometry(), k, q) >
              place;
      }
    return Utilities::MPI::min(far ? 1 : 0, step.grid.communicator()) == 1;
  }



  template <int dim>
  void
  warn_of_walls_inside(const StepContext<dim>               &step,
                       const std::vector<OneSidedWall<dim>> &walls)
  {
    for (const OneSidedWall<dim> &wall : walls)
      {
        const double size =
          side_of(step.grid, wall.boundary, wall.parameter).cell_size;
        const double inside = distance_inside(step, wall, wall.at_start);
        const bool   is_touched =
          std::any_of(wall.vertices.begin(),
                      wall.vertices.end(),
                      [&](const unsigned int v) {
                        return step.nodes.node(v) !=
                               numbers::invalid_unsigned_int;
                      });
        const bool any = Utilities::MPI::max(is_touched ? 1 : 0,
                                             step.grid.communicator()) == 1;
        if (!any && inside > most_inside * size)
          step.warnings.add(
            "a wall inside of the grid",
            "The one-sided wall at <" + wall.boundary + "> of <" +
              wall.parameter + "> stands " + rounded(inside) + " m, " +
              rounded(inside / size) +
              " cells, inside of the grid. It acts through the nodes of the "
              "boundary, on material in the cells there: a body that comes to "
              "it later is past the wall before it feels it, and the run ends "
              "with an error then. Let the boundary of the grid be where the "
              "wall is (<Grid>).");
      }
  }



  template std::string
  passage_through_walls(const StepContext<2> &,
                        const NodalField &,
                        const std::vector<OneSidedWall<2>> &,
                        const bool);
  template std::string
  passage_through_walls(const StepContext<3> &,
                        const NodalField &,
                        const std::vector<OneSidedWall<3>> &,
                        const bool);
  template bool
  is_far_from_walls(const StepContext<2> &,
                    const std::vector<OneSidedWall<2>> &);
  template bool
  is_far_from_walls(const StepContext<3> &,
                    const std::vector<OneSidedWall<3>> &);
  template void
  warn_of_walls_inside(const StepContext<2> &,
                       const std::vector<OneSidedWall<2>> &);
  template void
  warn_of_walls_inside(const StepContext<3> &,
                       const std::vector<OneSidedWall<3>> &);
} // namespace isochor
