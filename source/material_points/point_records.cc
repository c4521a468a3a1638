/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <isochor/material_points/point_records.h>

#include <algorithm>
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
} // namespace isochor
