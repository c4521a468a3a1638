/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_relocation_h
#define isochor_relocation_h

#include <deal.II/base/mpi.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/particles/particle_handler.h>

#include <isochor/grid/background_grid.h>
#include <isochor/material_points/point_locator.h>
#include <isochor/material_points/point_records.h>

#include <functional>
#include <memory>
#include <vector>

namespace isochor
{
  using namespace dealii;

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

  /** For how many particles a handler of @p n should reserve memory: some may
   * come from other ranks of @p comm, if there are any, for which its arrays
   * would else be copied to twice the room. */
  inline std::size_t
  with_room_to_come(const std::size_t n, const MPI_Comm comm)
  {
    return Utilities::MPI::n_mpi_processes(comm) > 1 ? n + n / 32 : n;
  }

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
   * Particles that change their cell take places in memory that others have
   * left, so that after some time each is somewhere else, and whatever looks at
   * all of them waits for memory. Where many have done so, all are copied,
   * once, to where they belong: into a new handler with @p mapping, in which
   * they stand one behind the other and which replaces @p handler. Where two
   * copies would need too much memory, this isn't done. The order in which a
   * handler goes through its particles is the same either way.
   *
   * @param is_concerned By cell: 0 if all particles in it are as this left
   * them, so that they need not be looked at. Empty: look at all.
   * @param[in,out] n_out_of_order How many particles of this rank have come to
   * another cell since all stood in order.
   * @throws ExcMessage if the count over all ranks, lost points included, is
   * not conserved, or a rank disagrees with the sender on where a point is
   * (which means that the grids differ).
   */
  template <int dim>
  RelocationReport<dim>
  relocate(std::unique_ptr<Particles::ParticleHandler<dim>> &handler,
           const Mapping<dim>                               &mapping,
           const PointLocator<dim>                          &locator,
           const std::vector<unsigned char>                 &is_concerned,
           std::size_t                                      &n_out_of_order);

  /** Put the lost points back into the cells that they were last in, so that
   * the state can be looked at, and throw ExcPointsLeftGrid. Collective. */
  template <int dim>
  void
  throw_lost_points(const BackgroundGrid<dim>       &grid,
                    const RelocationReport<dim>     &report,
                    Particles::ParticleHandler<dim> &points);

  /**
   * Let @p change give the cells other owners, and bring the particles, which
   * must lie in the cells that they are in, to these. The rest is as with
   * relocate(). Collective.
   */
  template <int dim>
  void
  change_owners(std::unique_ptr<Particles::ParticleHandler<dim>> &handler,
                const Mapping<dim>                               &mapping,
                const PointLocator<dim>                          &locator,
                const std::function<void()>                      &change,
                std::size_t &n_out_of_order);
} // namespace isochor

#endif
