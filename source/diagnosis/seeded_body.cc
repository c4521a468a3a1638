/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/expression.h>
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/diagnosis/seeded_cells.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** Places looked at in each cell: if a slit of a tenth of a cell goes
     * through ten cells, 98 of 100 such slits are found. */
    constexpr unsigned int n_samples = 4;

    /** What points say of the surroundings of a vertex. */
    constexpr unsigned int body = 1, no_body = 2, boundary = 4;

    /** What was found: cells in which a gap, or a part of the body, lies
     * between the points, and a place of each. */
    template <int dim>
    struct LostParts
    {
      std::array<unsigned int, 2> n_cells{};
      std::array<Point<dim>, 2>   place;
    };

    /** In the @p cells, of vertices whose surroundings are all body, or without
     * it. Stretches along a surface are not looked at, as a surface that isn't
     * made of faces goes through cells anywhere between points. */
    template <int dim>
    LostParts<dim>
    look_between_points(const SimplexGeometry<dim>      &geometry,
                        const std::vector<unsigned int> &cells,
                        const std::vector<unsigned int> &surroundings,
                        const Expression<dim>           &in_body)
    {
      LostParts<dim> result;
      for (const unsigned int cell : cells)
        {
          // the body may end, or begin, between the boundary and the first
          // points
          constexpr double                   near_boundary = 0.6;
          unsigned int                       around        = 0;
          std::array<unsigned char, dim + 1> is_on_boundary{};
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const unsigned int here =
                surroundings[geometry.vertex_indices(cell)[v]];
              around |= here & (body | no_body);
              is_on_boundary[v] = (here & boundary) != 0;
            }
          if (around != body && around != no_body)
            continue;
          const auto corners = corners_of(geometry, cell);
          for (unsigned int s = 0; s < n_samples; ++s)
            {
              const auto x =
                spread_place<dim>(corners, std::size_t(cell) * n_samples + s);
              const auto lambda = geometry.barycentric(cell, x);
              double     part   = 0;
              for (unsigned int v = 0; v <= dim; ++v)
                part += is_on_boundary[v] ? lambda[v] : 0;
              if (part > near_boundary ||
                  (in_body(x, 0.) > 0) == (around == body))
                continue;
              const unsigned int what = around == body ? 0 : 1;
              if (result.n_cells[what]++ == 0)
                result.place[what] = x;
              break;
            }
        }
      return result;
    }

    /** What the points in the cells say of the surroundings of all vertices.
     * Collective. */
    template <int dim>
    std::vector<unsigned int>
    surroundings_of_vertices(
      const BackgroundGrid<dim>                          &grid,
      const std::vector<unsigned int>                    &own_cells,
      const std::vector<std::string>                     &groups,
      const std::vector<typename BodySeeding<dim>::Zone> &zones,
      const Expression<dim>                              &in_body)
    {
      const SimplexGeometry<dim> &geometry = grid.geometry();
      std::vector<unsigned int>   result(geometry.vertices().size(), 0);
      for (const unsigned int cell : own_cells)
        {
          unsigned int here = 0;
          if (!in_groups(geometry.cell_iterator(cell)->material_id(),
                         groups,
                         grid.group_ids()))
            here = no_body;
          else
            for (const Point<dim> &x :
                 places_in_cell<dim>(geometry, cell, zones))
              here |= in_body(x, 0.) > 0 ? body : no_body;
          for (unsigned int v = 0; v <= dim; ++v)
            if (geometry.neighbours(cell)[v] == SimplexGeometry<dim>::no_cell)
              for (unsigned int w = 0; w <= dim; ++w)
                if (w != v)
                  result[geometry.vertex_indices(cell)[w]] |= boundary;
          for (const unsigned int vertex : geometry.vertex_indices(cell))
            result[vertex] |= here;
        }
      for (const unsigned int bit : {body, no_body, boundary})
        {
          std::vector<unsigned int> has_bit;
          for (const unsigned int of_vertex : result)
            has_bit.push_back(of_vertex & bit);
          Utilities::MPI::max(has_bit, grid.communicator(), has_bit);
          for (unsigned int v = 0; v < has_bit.size(); ++v)
            result[v] |= has_bit[v];
        }
      return result;
    }
  } // namespace



  /** Gaps and parts of the region that are narrower than the distance of the
   * points. */
  template <int dim>
  class SeededBody : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/) override
    {
      const BackgroundGrid<dim> &grid       = scene.grid;
      const BodySeeding<dim>    &seeding    = scene.points.body_seeding();
      const auto                &parameters = seeding.parameters_read();
      if (names_in_formula(parameters.region).empty() ||
          !parameters.body_mesh.empty() || parameters.lattice_spacing > 0)
        return;
      const SimplexGeometry<dim> &geometry = grid.geometry();
      const MPI_Comm              comm     = grid.communicator();
      const unsigned int          rank = Utilities::MPI::this_mpi_process(comm);
      const auto                  zones =
        seeding.create_zones(scene.points.layout().with_domains);
      const Expression<dim>     in_body(parameters.region,
                                    "Material points/Region");
      std::vector<unsigned int> own;
      for (unsigned int cell = 0; cell < geometry.n_cells_of_first_layer();
           ++cell)
        if (geometry.owner(cell) == rank)
          own.push_back(cell);
      const auto surroundings =
        surroundings_of_vertices(grid, own, parameters.groups, zones, in_body);
      LostParts<dim> found;
      try
        {
          found = look_between_points(geometry, own, surroundings, in_body);
        }
      catch (const StandardExceptions::ExcMessage &)
        {} // the formula need have values at the points only
      warn_of_lost_parts(found, comm);
    }

  private:
    /** Collective. */
    void
    warn_of_lost_parts(const LostParts<dim> &found, const MPI_Comm comm) const
    {
      const auto all = Utilities::MPI::all_gather(comm, found.n_cells);
      for (const unsigned int what : {0, 1})
        {
          unsigned int n_cells = 0, first = all.size();
          for (unsigned int r = all.size(); r-- > 0;)
            {
              n_cells += all[r][what];
              first = all[r][what] > 0 ? r : first;
            }
          if (n_cells == 0)
            continue;
          std::ostringstream place;
          place << Utilities::MPI::broadcast(comm, found.place[what], first);
          this->warn(
            "<Material points/Region> " +
            std::string(what == 0 ? "does not hold" : "holds") +
            " in places of " + std::to_string(n_cells) +
            (n_cells == 1 ? " cell" : " cells") + ", as at (" + place.str() +
            "), where all points around are " +
            (what == 0 ? "in the body: a gap is filled" :
                         "outside: a part of the body is left out") +
            ". Use smaller cells, more points (<Points per cell in zones>) or "
            "a <Body mesh>.");
        }
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    SeededBody,
    "a region that is finer than the points",
    ISOCHOR_ESSENTIAL,
    "`Material points/Region`, seeded in the cells of the grid: four places in "
    "each cell are looked at, away from the surface that the points show. It "
    "does not hold at some though all points around are in it (a gap that is "
    "filled), or the other way round (a part that is left out). Not with "
    "`Lattice spacing` or a `Body mesh`; a single gap that goes through few "
    "cells or is thinner than a hundredth of them may be missed",
    "smaller cells, `Points per cell in zones`, a body mesh")
} // namespace isochor
