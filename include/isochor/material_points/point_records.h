/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_point_records_h
#define isochor_point_records_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <isochor/grid/simplex_geometry.h>

#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Points detached from any container, with the same number of doubles as
   * payload for each (whatever the point carries: mass, stress, history, ...).
   */
  template <int dim>
  struct PointRecords
  {
    explicit PointRecords(const unsigned int n_payload = 0);

    /** Number of points. */
    std::size_t
    size() const;

    /** Make room for @p n points in all. */
    void
    reserve(const std::size_t n);

    /** Append a point. @p values must have n_payload entries. */
    void
    push_back(const unsigned int             cell,
              const types::particle_index    id,
              const Point<dim>              &location,
              const ArrayView<const double> &values);

    /** Let point @p to be what point @p from is. */
    void
    move(const std::size_t from, const std::size_t to);

    /** Keep the first @p n points. */
    void
    resize(const std::size_t n);

    /** The payload of point @p i. */
    ArrayView<const double>
    payload(const std::size_t i) const;

    unsigned int                       n_payload;
    std::vector<unsigned int>          cells;
    std::vector<types::particle_index> ids;
    std::vector<Point<dim>>            locations;
    /** n_payload entries for each point, one point after the other. */
    std::vector<double> payloads;
  };

  /**
   * Hand points over to the ranks that own their cells. Collective.
   * @param records Any points; their cells are active cell indices.
   * @param geometry Tells each cell's owner and the communicator.
   * @param[out] n_shipped Number of points this rank sent to others.
   * @return The points in cells of this rank, from all ranks: its own first,
   * then by rank of origin, in the order they had there.
   * @throws ExcMessage if the ranks disagree on n_payload.
   */
  template <int dim>
  PointRecords<dim>
  exchange_points(PointRecords<dim>           records,
                  const SimplexGeometry<dim> &geometry,
                  std::size_t                &n_shipped);
} // namespace isochor

#endif
