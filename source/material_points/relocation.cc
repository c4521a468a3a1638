/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/exceptions.h>

#include <isochor/material_points/relocation.h>

#include <cstdint>
#include <numeric>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Where each particle of a rank lies, in the order of the handler. */
    template <int dim>
    struct Places
    {
      explicit Places(const std::size_t n)
      {
        handles.reserve(n);
        from.reserve(n);
        to.reserve(n);
      }

      std::vector<typename Particles::PropertyPool<dim>::Handle> handles;
      std::vector<unsigned int> from, to; ///< cells; to: no_cell if lost
      std::size_t               n_moved = 0, n_lost = 0;
    };



    /** Particles that haven't moved. */
    template <int dim>
    Places<dim>
    same_places(const Particles::ParticleHandler<dim> &handler)
    {
      Places<dim> places(handler.n_locally_owned_particles());
      for (const auto &particle : handler)
        {
          places.handles.push_back(particle.get_local_index());
          places.from.push_back(
            particle.get_surrounding_cell()->active_cell_index());
        }
      places.to = places.from;
      return places;
    }



    /** Locate all particles, and update the reference locations of those that
     * are found. */
    template <int dim>
    Places<dim>
    find_places(Particles::ParticleHandler<dim>  &handler,
                const PointLocator<dim>          &locator,
                const std::vector<unsigned char> &is_concerned)
    {
      Places<dim> places(handler.n_locally_owned_particles());
      for (auto &particle : handler)
        {
          const unsigned int old =
            particle.get_surrounding_cell()->active_cell_index();
          places.handles.push_back(particle.get_local_index());
          places.from.push_back(old);
          places.to.push_back(old);
          if (!is_concerned.empty() && !is_concerned[old])
            continue;
          const auto result = locator.locate(particle.get_location(), old);
          if (result.found)
            particle.set_reference_location(
              SimplexGeometry<dim>::reference_location(result.barycentric));
          places.to.back() =
            result.found ? result.cell : SimplexGeometry<dim>::no_cell;
          places.n_lost += !result.found;
          places.n_moved += result.found && result.cell != old;
        }
      return places;
    }



    /** The reference location of a point that another rank has sent. */
    template <int dim>
    Point<dim>
    reference_location(const PointLocator<dim> &locator,
                       const PointRecords<dim> &records,
                       const std::size_t        i)
    {
      const auto result =
        locator.locate(records.locations[i], records.cells[i]);
      AssertThrow(result.found,
                  ExcMessage("A rank sent particle " +
                             std::to_string(records.ids[i]) + " to cell " +
                             std::to_string(records.cells[i]) +
                             ", but it is not in there: the ranks' vertex "
                             "coordinates differ."));
      return SimplexGeometry<dim>::reference_location(result.barycentric);
    }



    /** Append particle @p handle to @p records, as one of @p cell. */
    template <int dim>
    void
    append(Particles::PropertyPool<dim> &pool,
           const unsigned int            handle,
           const unsigned int            cell,
           PointRecords<dim>            &records)
    {
      records.push_back(cell,
                        pool.get_id(handle),
                        pool.get_location(handle),
                        pool.get_properties(handle));
    }



    /** Send the particles that are now in cells of other ranks there. Returns
     * what this rank received. Collective. */
    template <int dim>
    PointRecords<dim>
    exchange_particles(const Particles::ParticleHandler<dim> &handler,
                       const Places<dim>                     &places,
                       const SimplexGeometry<dim>            &geometry,
                       std::size_t                           &n_shipped)
    {
      auto              &pool = handler.get_property_pool();
      PointRecords<dim>  leaving(pool.n_properties_per_slot());
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(geometry.communicator());
      for (std::size_t i = 0; i < places.to.size(); ++i)
        if (places.to[i] != SimplexGeometry<dim>::no_cell &&
            geometry.owner(places.to[i]) != rank)
          append(pool, places.handles[i], places.to[i], leaving);
      return exchange_points(std::move(leaving), geometry, n_shipped);
    }



    /** Take the particles that are lost out of the handler, as well as those
     * that moved, which go where they are now unless another rank has them. */
    template <int dim>
    PointRecords<dim>
    move_particles(Particles::ParticleHandler<dim> &handler,
                   const Places<dim>               &places,
                   const SimplexGeometry<dim>      &geometry)
    {
      using Pool = Particles::PropertyPool<dim>;
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(geometry.communicator());
      Pool                   &pool = handler.get_property_pool();
      PointRecords<dim>       lost(pool.n_properties_per_slot());
      PointRecords<dim>       moved(pool.n_properties_per_slot());
      std::vector<Point<dim>> references;
      moved.reserve(places.n_moved);
      references.reserve(places.n_moved);
      std::vector<typename Particles::ParticleHandler<dim>::particle_iterator>
           leaving;
      auto particle = handler.begin();
      for (std::size_t i = 0; i < places.to.size(); ++i, ++particle)
        {
          const unsigned int cell    = places.to[i];
          const bool         is_lost = cell == SimplexGeometry<dim>::no_cell;
          const bool         is_own  = !is_lost && geometry.owner(cell) == rank;
          if (is_own && cell == places.from[i])
            continue;
          leaving.push_back(particle);
          if (is_lost)
            append(pool, places.handles[i], places.from[i], lost);
          else if (is_own)
            {
              append(pool, places.handles[i], cell, moved);
              references.push_back(
                pool.get_reference_location(places.handles[i]));
            }
        }
      // backwards, so that the others' places within their cells stay right
      for (auto last = leaving.rbegin(); last != leaving.rend(); ++last)
        handler.remove_particle(*last);
      for (std::size_t i = 0; i < moved.size(); ++i)
        handler.insert_particle(moved.locations[i],
                                references[i],
                                moved.ids[i],
                                geometry.cell_iterator(moved.cells[i]),
                                moved.payload(i));
      return lost;
    }



    /** Particles of a rank, sorted by cell: handles, or where the entry is at
     * least n_handles, what was received. */
    struct SortedSources
    {
      std::vector<unsigned int> first; ///< of each cell, and the end
      std::vector<unsigned int> source;
      unsigned int              n_handles;
    };



    /** The order that move_particles() and then insert_particles() of what was
     * @p received would leave behind. */
    template <int dim>
    SortedSources
    sort_by_cell(const Places<dim>               &places,
                 const std::vector<unsigned int> &received,
                 const SimplexGeometry<dim>      &geometry,
                 const unsigned int               n_handles)
    {
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(geometry.communicator());
      const auto is_own = [&](const unsigned int cell) {
        return cell != SimplexGeometry<dim>::no_cell &&
               geometry.owner(cell) == rank;
      };
      SortedSources sorted;
      sorted.n_handles = n_handles;
      sorted.first.assign(geometry.n_cells() + 1, 0);
      for (const unsigned int cell : places.to)
        if (is_own(cell))
          ++sorted.first[cell + 1];
      for (const unsigned int cell : received)
        ++sorted.first[cell + 1];
      std::partial_sum(sorted.first.begin(),
                       sorted.first.end(),
                       sorted.first.begin());
      sorted.source.resize(sorted.first.back());

      // those that stay come first; in place of one that leaves, the last
      std::vector<unsigned int> next(sorted.first), staying;
      for (std::size_t begin = 0, end = 0; begin < places.from.size();
           begin = end)
        {
          const unsigned int cell = places.from[begin];
          for (; end < places.from.size() && places.from[end] == cell; ++end)
            ;
          if (!is_own(cell))
            continue; // it has another owner now
          staying.assign(places.handles.begin() + begin,
                         places.handles.begin() + end);
          for (std::size_t i = end; i-- > begin;)
            if (places.to[i] != cell)
              {
                staying[i - begin] = staying.back();
                staying.pop_back();
              }
          for (const unsigned int handle : staying)
            sorted.source[next[cell]++] = handle;
        }
      for (std::size_t i = 0; i < places.to.size(); ++i)
        if (places.to[i] != places.from[i] && is_own(places.to[i]))
          sorted.source[next[places.to[i]]++] = places.handles[i];
      for (unsigned int i = 0; i < received.size(); ++i)
        sorted.source[next[received[i]]++] = n_handles + i;
      return sorted;
    }



    /** Let @p fresh, which is empty, have the particles of @p old where they
     * are now and those @p received, one behind the other in memory. */
    template <int dim>
    void
    copy_in_order(const Particles::ParticleHandler<dim> &old,
                  const Places<dim>                     &places,
                  const PointRecords<dim>               &received,
                  const PointLocator<dim>               &locator,
                  Particles::ParticleHandler<dim>       &fresh)
    {
      const SimplexGeometry<dim> &geometry = locator.geometry();
      auto                       &pool     = old.get_property_pool();
      const SortedSources         sorted =
        sort_by_cell(places, received.cells, geometry, pool.n_slots());
      fresh.reserve(
        with_room_to_come(sorted.source.size(), geometry.communicator()));
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        for (unsigned int k = sorted.first[cell]; k < sorted.first[cell + 1];
             ++k)
          if (const unsigned int source = sorted.source[k];
              source < sorted.n_handles)
            fresh.insert_particle(pool.get_location(source),
                                  pool.get_reference_location(source),
                                  pool.get_id(source),
                                  geometry.cell_iterator(cell),
                                  pool.get_properties(source));
          else
            {
              const unsigned int i = source - sorted.n_handles;
              fresh.insert_particle(received.locations[i],
                                    reference_location(locator, received, i),
                                    received.ids[i],
                                    geometry.cell_iterator(cell),
                                    received.payload(i));
            }
    }



    /** Whether there is memory for a second copy of @p n points. */
    template <int dim>
    bool
    fits_twice(const std::size_t n, const unsigned int n_payload)
    {
      constexpr std::size_t most_bytes = 500000000;
      return n * (n_payload + 2 * dim + 1) * sizeof(double) <= most_bytes;
    }
  } // namespace



  template <int dim>
  void
  insert_particles(Particles::ParticleHandler<dim> &handler,
                   const PointLocator<dim>         &locator,
                   const PointRecords<dim>         &records)
  {
    for (std::size_t i = 0; i < records.size(); ++i)
      handler.insert_particle(records.locations[i],
                              reference_location(locator, records, i),
                              records.ids[i],
                              locator.geometry().cell_iterator(
                                records.cells[i]),
                              records.payload(i));
    handler.update_cached_numbers();
  }



  namespace
  {
    /** Bring all particles to @p places, on whatever rank, those that are lost
     * to @p lost. Returns how many went to other ranks. See relocate().
     * Collective. */
    template <int dim>
    std::size_t
    bring_to_places(std::unique_ptr<Particles::ParticleHandler<dim>> &handler,
                    const Mapping<dim>                               &mapping,
                    const PointLocator<dim>                          &locator,
                    const Places<dim>                                &places,
                    std::size_t       &n_out_of_order,
                    PointRecords<dim> &lost)
    {
      const SimplexGeometry<dim> &geometry = locator.geometry();
      std::size_t                 n_shipped;
      const PointRecords<dim>     received =
        exchange_particles(*handler, places, geometry, n_shipped);
      const std::size_t n = places.to.size() + received.size();
      n_out_of_order += places.n_moved + received.size();
      // Points in any order cost a step half of what laying them out anew
      // does; those that moved into neighbouring cells are far from that.
      if (places.n_lost == 0 && n_out_of_order > places.to.size() &&
          fits_twice<dim>(n, received.n_payload))
        {
          auto fresh = std::make_unique<Particles::ParticleHandler<dim>>(
            geometry.triangulation(), mapping, received.n_payload);
          copy_in_order(*handler, places, received, locator, *fresh);
          fresh->update_cached_numbers();
          handler        = std::move(fresh);
          n_out_of_order = 0;
        }
      else
        {
          lost = move_particles(*handler, places, geometry);
          insert_particles(*handler, locator, received);
        }
      return n_shipped;
    }
  } // namespace



  template <int dim>
  void
  change_owners(std::unique_ptr<Particles::ParticleHandler<dim>> &handler,
                const Mapping<dim>                               &mapping,
                const PointLocator<dim>                          &locator,
                const std::function<void()>                      &change,
                std::size_t &n_out_of_order)
  {
    const Places<dim> places = same_places(*handler);
    change();
    PointRecords<dim> none;
    bring_to_places(handler, mapping, locator, places, n_out_of_order, none);
  }



  template <int dim>
  RelocationReport<dim>
  relocate(std::unique_ptr<Particles::ParticleHandler<dim>> &handler,
           const Mapping<dim>                               &mapping,
           const PointLocator<dim>                          &locator,
           const std::vector<unsigned char>                 &is_concerned,
           std::size_t                                      &n_out_of_order)
  {
    const std::size_t     n_previous = handler->n_locally_owned_particles();
    const Places<dim>     places = find_places(*handler, locator, is_concerned);
    RelocationReport<dim> report;
    const std::size_t     n_shipped = bring_to_places(
      handler, mapping, locator, places, n_out_of_order, report.lost);

    const std::vector<std::uint64_t> local = {n_previous,
                                              places.n_moved,
                                              n_shipped,
                                              places.n_lost};
    std::vector<std::uint64_t>       global(local.size());
    Utilities::MPI::sum(local, locator.geometry().communicator(), global);
    report.n_moved   = global[1];
    report.n_shipped = global[2];
    report.n_lost    = global[3];
    AssertThrow(handler->n_global_particles() + report.n_lost == global[0],
                ExcMessage("Relocation changed the number of particles from " +
                           std::to_string(global[0]) + " to " +
                           std::to_string(handler->n_global_particles()) +
                           " and " + std::to_string(report.n_lost) +
                           " lost ones."));
    return report;
  }



  template <int dim>
  PointRecords<dim>
  all_points(const Particles::ParticleHandler<dim> &handler)
  {
    PointRecords<dim> records(handler.n_properties_per_particle());
    records.reserve(handler.n_locally_owned_particles());
    for (const auto &particle : handler)
      records.push_back(particle.get_surrounding_cell()->active_cell_index(),
                        particle.get_id(),
                        particle.get_location(),
                        particle.get_properties());
    return records;
  }



  template void
  insert_particles<2>(Particles::ParticleHandler<2> &,
                      const PointLocator<2> &,
                      const PointRecords<2> &);
  template void
  insert_particles<3>(Particles::ParticleHandler<3> &,
                      const PointLocator<3> &,
                      const PointRecords<3> &);
  template PointRecords<2>
  all_points<2>(const Particles::ParticleHandler<2> &);
  template PointRecords<3>
  all_points<3>(const Particles::ParticleHandler<3> &);
  template void
  change_owners<2>(std::unique_ptr<Particles::ParticleHandler<2>> &,
                   const Mapping<2> &,
                   const PointLocator<2> &,
                   const std::function<void()> &,
                   std::size_t &);
  template void
  change_owners<3>(std::unique_ptr<Particles::ParticleHandler<3>> &,
                   const Mapping<3> &,
                   const PointLocator<3> &,
                   const std::function<void()> &,
                   std::size_t &);
  template RelocationReport<2>
  relocate<2>(std::unique_ptr<Particles::ParticleHandler<2>> &,
              const Mapping<2> &,
              const PointLocator<2> &,
              const std::vector<unsigned char> &,
              std::size_t &);
  template RelocationReport<3>
  relocate<3>(std::unique_ptr<Particles::ParticleHandler<3>> &,
              const Mapping<3> &,
              const PointLocator<3> &,
              const std::vector<unsigned char> &,
              std::size_t &);
} // namespace isochor
