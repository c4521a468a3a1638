/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/rounding.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/material_points.h>
#include <isochor/material_points/relocation.h>

#include <map>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** The name of the boundary through which one leaves the grid from the
     * centre of @p cell to @p x. */
    template <int dim>
    std::string
    boundary_crossed(const BackgroundGrid<dim> &grid,
                     const unsigned int         cell,
                     const Point<dim>          &x)
    {
      AssertIndexRange(cell, grid.geometry().n_cells());
      const SimplexGeometry<dim> &geometry = grid.geometry();
      const Point<dim>            start    = cell_centroid(geometry, cell);

      // the first face that the line from there meets: where the barycentric
      // coordinate of the opposite vertex vanishes and the others don't exceed
      // 1
      double             first = 1 + rounding::places;
      types::boundary_id id    = numbers::invalid_boundary_id;
      for (const BoundaryFace &face : grid.boundary_faces())
        {
          const double a =
            geometry.barycentric(face.cell, start)[face.opposite_vertex];
          const double b =
            geometry.barycentric(face.cell, x)[face.opposite_vertex];
          if (!(a >= 0 && b < a))
            continue;
          const double s = a / (a - b);
          const auto   lambda =
            geometry.barycentric(face.cell,
                                 Point<dim>(start + s * (x - start)));
          if (s<first && * std::min_element(lambda.begin(), lambda.end())> -
              rounding::places)
            {
              first = s;
              id    = face.id;
            }
        }
      for (const auto &name : grid.boundary_names())
        if (name.second == id)
          return name.first;
      return "a boundary without a name";
    }
  } // namespace



  template <int dim>
  void
  throw_lost_points(const BackgroundGrid<dim>       &grid,
                    const RelocationReport<dim>     &report,
                    Particles::ParticleHandler<dim> &points)
  {
    constexpr std::size_t               most = 3; // places to list
    std::string                         places;
    std::map<std::string, unsigned int> n_through;
    for (std::size_t i = 0; i < report.lost.size(); ++i)
      {
        const Point<dim> &x = report.lost.locations[i];
        ++n_through[boundary_crossed(grid, report.lost.cells[i], x)];
        std::ostringstream place;
        place << " Point " << report.lost.ids[i] << " is at (" << x << ").";
        if (i < most)
          places += place.str();
        // kept, so that the state can be looked at
        points.insert_particle(
          x,
          SimplexGeometry<dim>::reference_location(
            grid.geometry().barycentric(report.lost.cells[i], x)),
          report.lost.ids[i],
          grid.geometry().cell_iterator(report.lost.cells[i]),
          report.lost.payload(i));
      }
    points.update_cached_numbers();

    std::map<std::string, unsigned int> n_through_all;
    std::string                         all_places, boundaries;
    std::vector<std::string>            names;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), n_through))
      for (const auto &entry : of_rank)
        n_through_all[entry.first] += entry.second;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), places))
      all_places += of_rank;
    for (const auto &entry : n_through_all)
      {
        boundaries += (boundaries.empty() ? "" : ", ") +
                      std::to_string(entry.second) + " through <" +
                      entry.first + ">";
        names.push_back(entry.first);
      }
    AssertThrow(false,
                ExcPointsLeftGrid(std::to_string(report.n_lost) +
                                    " material points left the background "
                                    "grid, " +
                                    boundaries + "." + all_places,
                                  names));
  }



  template void
  throw_lost_points(const BackgroundGrid<2> &,
                    const RelocationReport<2> &,
                    Particles::ParticleHandler<2> &);
  template void
  throw_lost_points(const BackgroundGrid<3> &,
                    const RelocationReport<3> &,
                    Particles::ParticleHandler<3> &);
} // namespace isochor
