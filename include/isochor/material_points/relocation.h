/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_relocation_h
#define isochor_relocation_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>
#include <deal.II/particles/particle_handler.h>

#include <isochor/material_points/point_locator.h>

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

  /** The outcome of relocate(). */
  template <int dim>
  struct RelocationReport
  {
    /** Points that changed their cell, over all ranks. */
    types::particle_index n_moved = 0;
    /** Among them, those that changed the rank. */
    types::particle_index n_shipped = 0;
    /** Points outside the grid, over all ranks. */
    types::particle_index n_lost = 0;
    /** The lost points of this rank, with the cell each was last in. They are
     * no longer in the handler. What to do about them is up to the caller;
     * usually it is an error. */
    PointRecords<dim> lost;
  };

  /** All particles of this rank, in the order of @p handler. */
  template <int dim>
  PointRecords<dim>
  all_points(const Particles::ParticleHandler<dim> &handler);

  /** Insert points of this rank's cells into the cells that they name.
   * Collective.
   * @throws ExcMessage if one is not in there. */
  template <int dim>
  void
  insert_particles(Particles::ParticleHandler<dim> &handler,
                   const PointLocator<dim>         &locator,
                   const PointRecords<dim>         &records);

  /**
   * Bring all particles of this rank into the cells of their present locations:
   * update the reference locations, and move the particles that left their cell
   * to the new one, on whatever rank. Collective; replaces
   * ParticleHandler::sort_particles_into_subdomains_and_cells(), which in 9.4
   * takes simplices for cubes. Iterators to particles and ghost particles are
   * invalid afterwards.
   *
   * @param is_concerned By cell: 0 if all particles in it are as this left
   * them, so that they need not be looked at. Empty: look at all.
   * @throws ExcMessage if the count over all ranks, lost points included, is
   * not conserved, or a rank disagrees with the sender on where a point is
   * (which means that the grids differ).
   */
  template <int dim>
  RelocationReport<dim>
  relocate(Particles::ParticleHandler<dim>  &handler,
           const PointLocator<dim>          &locator,
           const std::vector<unsigned char> &is_concerned = {});

  /**
   * Lay out what @p handler holds anew, in the order in which it goes through
   * its particles, which stays as it is. Particles that change their cell take
   * places in memory that others have left, so that after some time each is
   * somewhere else, and whatever looks at all of them waits for memory. Needs a
   * copy of all of them for a moment; where this would be too much, nothing is
   * done. Iterators to particles are invalid afterwards. Collective.
   */
  template <int dim>
  void
  order_memory(Particles::ParticleHandler<dim> &handler,
               const PointLocator<dim>         &locator);
} // namespace isochor

#endif
