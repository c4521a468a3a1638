/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/material_points/material_points.h>
#include <isochor/material_points/relocation.h>

#include <map>
#include <sstream>

namespace isochor
{
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
        ++n_through[grid.boundary_crossed(report.lost.cells[i], x)];
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
