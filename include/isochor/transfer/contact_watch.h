/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_contact_watch_h
#define isochor_contact_watch_h

#include <isochor/base/warnings.h>
#include <isochor/grid/background_grid.h>
#include <isochor/material_points/point_arrays.h>

#include <vector>

namespace isochor
{
  /**
   * Tells when bodies meet. Where they have nodes in common they are one, from
   * up to a cell before they touch, without slip, and also if they are pulled
   * apart: there is no law of contact between bodies, and forces differ from
   * what such a law would give.
   *
   * Bodies are what has no node in common at t = 0. If that is one body nothing
   * is looked for, also if it breaks.
   */
  template <int dim>
  class ContactWatch
  {
  public:
    explicit ContactWatch(const BackgroundGrid<dim> &grid);

    /** The grid was put back at @p time; @p vertices are all that this rank's
     * @p points act on, ascending. Collective. */
    void
    look(const PointArrays<dim>          &points,
         const std::vector<unsigned int> &vertices,
         const double                     time,
         const bool                       at_start,
         Warnings                        &warnings);

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &n_bodies &has_several;
    }

  private:
    /** Into how many bodies all points fall. Collective. */
    unsigned int
    count(const PointArrays<dim>          &points,
          const std::vector<unsigned int> &vertices) const;

    const BackgroundGrid<dim> &grid;
    bool                       has_several = false; ///< at t = 0
    unsigned int               n_bodies    = 0;     ///< at the last reset
  };
} // namespace isochor

#endif
