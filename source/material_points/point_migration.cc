/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of MaterialPoints that bring points to other cells and ranks.
#include <deal.II/base/mpi.h>

#include <isochor/material_points/material_points.h>
#include <isochor/material_points/relocation.h>

#include <map>
#include <sstream>
#include <utility>

namespace isochor
{
  template <int dim>
  types::particle_index
  MaterialPoints<dim>::relocate(const PointLocator<dim>          &locator,
                                const std::vector<unsigned char> &is_concerned)
  {
    forget_order();
    const RelocationReport<dim> report = isochor::relocate(
      particles, grid.mapping(), locator, is_concerned, n_out_of_order);
    if (report.n_lost == 0)
      return report.n_moved;

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
        particles->insert_particle(
          x,
          SimplexGeometry<dim>::reference_location(
            grid.geometry().barycentric(report.lost.cells[i], x)),
          report.lost.ids[i],
          grid.geometry().cell_iterator(report.lost.cells[i]),
          report.lost.payload(i));
      }
    particles->update_cached_numbers();

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
    return report.n_moved;
  }



  template <int dim>
  void
  MaterialPoints<dim>::change_grid(
    const PointLocator<dim>                                    &locator,
    const std::function<std::unique_ptr<Triangulation<dim>>()> &change,
    const bool                                                  keep_points)
  {
    forget_order();
    n_out_of_order                  = 0;
    const unsigned int n_properties = particles->n_properties_per_particle();
    PointRecords<dim>  records =
      keep_points ? all_points(*particles) : PointRecords<dim>(n_properties);
    particles->clear_particles();
    const std::unique_ptr<Triangulation<dim>> old = change();
    // lets go of the old one
    particles->initialize(grid.triangulation(), grid.mapping(), n_properties);
    if (!keep_points)
      return;
    for (std::size_t i = 0; i < records.size(); ++i)
      {
        const auto place =
          locator.locate(records.locations[i],
                         grid.cells_after_change()[records.cells[i]]);
        AssertThrow(place.found, ExcInternalError());
        records.cells[i] = place.cell;
      }
    std::size_t             n_shipped;
    const PointRecords<dim> own =
      exchange_points(std::move(records), grid.geometry(), n_shipped);
    particles->reserve(with_room_to_come(own.size(), grid.communicator()));
    insert_particles(*particles, locator, own);
  }



  template <int dim>
  void
  MaterialPoints<dim>::change_owners(const PointLocator<dim>     &locator,
                                     const std::function<void()> &change)
  {
    forget_order();
    isochor::change_owners(
      particles, grid.mapping(), locator, change, n_out_of_order);
  }



  template types::particle_index
  MaterialPoints<2>::relocate(const PointLocator<2> &,
                              const std::vector<unsigned char> &);
  template void
  MaterialPoints<2>::change_grid(
    const PointLocator<2> &,
    const std::function<std::unique_ptr<Triangulation<2>>()> &,
    const bool);
  template void
  MaterialPoints<2>::change_owners(const PointLocator<2> &,
                                   const std::function<void()> &);
  template types::particle_index
  MaterialPoints<3>::relocate(const PointLocator<3> &,
                              const std::vector<unsigned char> &);
  template void
  MaterialPoints<3>::change_grid(
    const PointLocator<3> &,
    const std::function<std::unique_ptr<Triangulation<3>>()> &,
    const bool);
  template void
  MaterialPoints<3>::change_owners(const PointLocator<3> &,
                                   const std::function<void()> &);
} // namespace isochor
