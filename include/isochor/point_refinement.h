/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_refinement_h
#define isochor_point_refinement_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/cell_occupancy.h>
#include <isochor/material_points.h>

#include <vector>

namespace isochor
{
  /**
   * Splits material points where the cells are too small for them: where the
   * body is stretched, or small cells of a moving grid come to where large ones
   * were seeded. A hole, a cell inside of the body without points, has nothing
   * that would remember the material in it, and larger gaps are not even
   * recognised as inside: the body would close them, and lose volume while
   * det F of every point stays right.
   *
   * A hole gets a point at its centroid, half of the largest of the points in
   * the cells next to it, with all that this one knows; if that point is no
   * larger than the hole, it is a gap between points dense enough, and nothing
   * is done. Volume, mass and momentum are conserved.
   */
  template <int dim>
  class PointRefinement
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    /** Throws if switched on where there are no holes, or for points with
     * domains. */
    void
    parse_parameters(ParameterHandler &prm);

    bool
    is_active() const
    {
      return active;
    }

    /** The points to split, by this rank: see MaterialPoints::split(). */
    std::vector<PointSplit<dim>>
    find(const PointArrays<dim>   &points,
         const CellOccupancy<dim> &occupancy) const;

  private:
    bool active = false;
  };
} // namespace isochor

#endif
