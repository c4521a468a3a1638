/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_cavity_watch_h
#define isochor_cavity_watch_h

#include <isochor/base/warnings.h>
#include <isochor/cut_cells/cell_occupancy.h>

namespace isochor
{
  /** Warns when the body has more cavities, enclosed gaps that are no holes,
   * than it had at t = 0. */
  template <int dim>
  class CavityWatch
  {
  public:
    /** The grid was reset at @p time. Collective. */
    void
    look(const CellOccupancy<dim> &occupancy,
         const double              time,
         const bool                at_start,
         Warnings                 &warnings);

    /** Whether the body had cavities at t = 0 that are no larger than what may
     * be a hole. */
    bool
    body_has_small_ones() const
    {
      return n_small_at_start > 0;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &n_small_at_start &n_large_at_start &n_last;
    }

  private:
    unsigned int n_small_at_start = 0, n_large_at_start = 0;
    unsigned int n_last = 0; ///< at the last reset
  };
} // namespace isochor

#endif
