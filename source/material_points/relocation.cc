/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/exceptions.h>

#include <isochor/material_points/relocation.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Integers travel as doubles, which hold them exactly up to here. */
    constexpr double largest_exact_integer = 9007199254740992.; // 2^53



    /** Append point @p i to a message: cell, id, location, payload. */
    template <int dim>
    void
    pack(const PointRecords<dim> &records,
         const std::size_t        i,
         std::vector<double>     &message)
    {
      AssertThrow(records.ids[i] < largest_exact_integer,
                  ExcMessage("Particle ids must be less than 2^53."));
      message.push_back(records.cells[i]);
      message.push_back(records.ids[i]);
      for (unsigned int d = 0; d < dim; ++d)
        message.push_back(records.locations[i][d]);
      const auto values = records.payload(i);
      message.insert(message.end(), values.begin(), values.end());
    }



    /** Append all points of a message. Its first entry is the payload size. */
    template <int dim>
    void
    unpack(const std::vector<double> &message, PointRecords<dim> &records)
    {
      AssertThrow(message.front() == records.n_payload,
                  ExcMessage("This rank expects " +
                             std::to_string(records.n_payload) +
                             " values for each point, but received " +
                             std::to_string(message.front()) + "."));
      const std::size_t length = 2 + dim + records.n_payload;
      AssertThrow((message.size() - 1) % length == 0, ExcInternalError());

      for (auto entry = message.begin() + 1; entry != message.end();
           entry += length)
        {
          Point<dim> location;
          for (unsigned int d = 0; d < dim; ++d)
            location[d] = entry[2 + d];
          records.push_back(
            static_cast<unsigned int>(entry[0]),
            static_cast<types::particle_index>(entry[1]),
            location,
            ArrayView<const double>(message.data() + (entry - message.begin()) +
                                      2 + dim,
                                    records.n_payload));
        }
    }
  } // namespace



  template <int dim>
  PointRecords<dim>::PointRecords(const unsigned int n_payload)
    : n_payload(n_payload)
  {}



  template <int dim>
  std::size_t
  PointRecords<dim>::size() const
  {
    return ids.size();
  }



  template <int dim>
  void
  PointRecords<dim>::reserve(const std::size_t n)
  {
    cells.reserve(n);
    ids.reserve(n);
    locations.reserve(n);
    payloads.reserve(n * n_payload);
  }



  template <int dim>
  void
  PointRecords<dim>::push_back(const unsigned int             cell,
                               const types::particle_index    id,
                               const Point<dim>              &location,
                               const ArrayView<const double> &values)
  {
    AssertDimension(values.size(), n_payload);
    cells.push_back(cell);
    ids.push_back(id);
    locations.push_back(location);
    payloads.insert(payloads.end(), values.begin(), values.end());
  }



  template <int dim>
  void
  PointRecords<dim>::move(const std::size_t from, const std::size_t to)
  {
    if (from == to)
      return;
    cells[to]     = cells[from];
    ids[to]       = ids[from];
    locations[to] = locations[from];
    std::copy_n(payloads.begin() + from * n_payload,
                n_payload,
                payloads.begin() + to * n_payload);
  }



  template <int dim>
  void
  PointRecords<dim>::resize(const std::size_t n)
  {
    cells.resize(n);
    ids.resize(n);
    locations.resize(n);
    payloads.resize(n * n_payload);
  }



  template <int dim>
  ArrayView<const double>
  PointRecords<dim>::payload(const std::size_t i) const
  {
    return ArrayView<const double>(payloads.data() + i * n_payload, n_payload);
  }



  template <int dim>
  PointRecords<dim>
  exchange_points(PointRecords<dim>           records,
                  const SimplexGeometry<dim> &geometry,
                  std::size_t                &n_shipped)
  {
    const MPI_Comm     comm    = geometry.communicator();
    const unsigned int my_rank = Utilities::MPI::this_mpi_process(comm);

    const auto is_own = [&](const unsigned int cell) {
      return geometry.owner(cell) == my_rank;
    };
    std::map<unsigned int, std::vector<double>> messages;
    std::size_t                                 n_own = 0;
    for (std::size_t i = 0; i < records.size(); ++i)
      if (is_own(records.cells[i]))
        records.move(i, n_own++);
      else
        {
          std::vector<double> &message =
            messages[geometry.owner(records.cells[i])];
          if (message.empty())
            message.push_back(records.n_payload);
          pack(records, i, message);
        }
    n_shipped = records.size() - n_own;
    records.resize(n_own);
    for (const auto &received : Utilities::MPI::some_to_some(comm, messages))
      unpack(received.second, records);
    return records;
  }



  namespace
  {
    /** Update the reference location of the particles that stay, and take those
     * that leave their cell (into @p moved) or the grid (into @p lost) out of
     * the handler. */
    template <int dim>
    void
    detach_moved_particles(Particles::ParticleHandler<dim>  &handler,
                           const PointLocator<dim>          &locator,
                           const std::vector<unsigned char> &is_concerned,
                           PointRecords<dim>                &moved,
                           PointRecords<dim>                &lost)
    {
      std::vector<typename Particles::ParticleHandler<dim>::particle_iterator>
        leaving;
      for (auto particle = handler.begin(); particle != handler.end();
           ++particle)
        {
          const unsigned int old_cell =
            particle->get_surrounding_cell()->active_cell_index();
          if (!is_concerned.empty() && !is_concerned[old_cell])
            continue;
          const auto result =
            locator.locate(particle->get_location(), old_cell);
          if (result.cell == old_cell)
            {
              particle->set_reference_location(
                SimplexGeometry<dim>::reference_location(result.barycentric));
              continue;
            }
          leaving.push_back(particle);
          PointRecords<dim> &records = result.found ? moved : lost;
          records.push_back(result.found ? result.cell : old_cell,
                            particle->get_id(),
                            particle->get_location(),
                            particle->get_properties());
        }
      handler.remove_particles(leaving);
    }
  } // namespace



  template <int dim>
  void
  insert_particles(Particles::ParticleHandler<dim> &handler,
                   const PointLocator<dim>         &locator,
                   const PointRecords<dim>         &records)
  {
    const SimplexGeometry<dim> &geometry = locator.geometry();
    for (std::size_t i = 0; i < records.size(); ++i)
      {
        const unsigned int cell   = records.cells[i];
        const auto         result = locator.locate(records.locations[i], cell);
        AssertThrow(result.found,
                    ExcMessage("A rank sent particle " +
                               std::to_string(records.ids[i]) + " to cell " +
                               std::to_string(cell) +
                               ", but it is not in there: the ranks' vertex "
                               "coordinates differ."));
        handler.insert_particle(records.locations[i],
                                SimplexGeometry<dim>::reference_location(
                                  result.barycentric),
                                records.ids[i],
                                geometry.cell_iterator(cell),
                                records.payload(i));
      }
    handler.update_cached_numbers();
  }



  template <int dim>
  RelocationReport<dim>
  relocate(Particles::ParticleHandler<dim>  &handler,
           const PointLocator<dim>          &locator,
           const std::vector<unsigned char> &is_concerned)
  {
    const SimplexGeometry<dim> &geometry  = locator.geometry();
    const unsigned int          n_payload = handler.n_properties_per_particle();
    const std::size_t n_previous          = handler.n_locally_owned_particles();

    RelocationReport<dim> report;
    PointRecords<dim>     moved(n_payload);
    moved.reserve(n_previous); // what isn't written takes no memory
    report.lost = PointRecords<dim>(n_payload);
    detach_moved_particles(handler, locator, is_concerned, moved, report.lost);

    const std::size_t n_moved = moved.size();
    std::size_t       n_shipped;
    insert_particles(handler,
                     locator,
                     exchange_points(std::move(moved), geometry, n_shipped));

    const std::vector<std::uint64_t> local = {n_previous,
                                              n_moved,
                                              n_shipped,
                                              report.lost.size()};
    std::vector<std::uint64_t>       global(local.size());
    Utilities::MPI::sum(local, geometry.communicator(), global);
    report.n_moved   = global[1];
    report.n_shipped = global[2];
    report.n_lost    = global[3];
    AssertThrow(handler.n_global_particles() + report.n_lost == global[0],
                ExcMessage("Relocation changed the number of particles from " +
                           std::to_string(global[0]) + " to " +
                           std::to_string(handler.n_global_particles()) +
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



  template <int dim>
  void
  order_memory(Particles::ParticleHandler<dim> &handler,
               const PointLocator<dim>         &locator)
  {
    constexpr std::size_t most_bytes = 500000000;
    const unsigned int    n_payload  = handler.n_properties_per_particle();
    const std::size_t     n          = handler.n_locally_owned_particles();
    const bool fits = n * (n_payload + dim + 2) * sizeof(double) <= most_bytes;
    // inserting is collective
    if (Utilities::MPI::min(fits ? 1 : 0, locator.geometry().communicator()) ==
        0)
      return;
    const PointRecords<dim> records = all_points(handler);
    handler.clear_particles();
    insert_particles(handler, locator, records);
  }



  template struct PointRecords<2>;
  template struct PointRecords<3>;
  template PointRecords<2>
  exchange_points<2>(PointRecords<2>,
                     const SimplexGeometry<2> &,
                     std::size_t &);
  template PointRecords<3>
  exchange_points<3>(PointRecords<3>,
                     const SimplexGeometry<3> &,
                     std::size_t &);
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
  order_memory<2>(Particles::ParticleHandler<2> &, const PointLocator<2> &);
  template void
  order_memory<3>(Particles::ParticleHandler<3> &, const PointLocator<3> &);
  template RelocationReport<2>
  relocate<2>(Particles::ParticleHandler<2> &,
              const PointLocator<2> &,
              const std::vector<unsigned char> &);
  template RelocationReport<3>
  relocate<3>(Particles::ParticleHandler<3> &,
              const PointLocator<3> &,
              const std::vector<unsigned char> &);
} // namespace isochor
