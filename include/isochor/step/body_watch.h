/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_watch_h
#define isochor_body_watch_h

#include <isochor/cut_cells/cavity_watch.h>
#include <isochor/material_points/point_spacing.h>
#include <isochor/transfer/contact_watch.h>
#include <isochor/transfer/interface_watch.h>

namespace isochor
{
  /** What is looked for whenever the grid is put back. */
  template <int dim>
  struct BodyWatch
  {
    explicit BodyWatch(const BackgroundGrid<dim> &grid)
      : spacing(grid)
    {}

    PointSpacing<dim> spacing;  ///< points too far apart
    ContactWatch<dim> contact;  ///< bodies that meet
    CavityWatch<dim>  cavities; ///< gaps that open

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &contact &cavities;
    }
  };
} // namespace isochor

#endif
