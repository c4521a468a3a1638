/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_spacing_h
#define isochor_point_spacing_h

#include <isochor/base/warnings.h>
#include <isochor/grid/background_grid.h>
#include <isochor/material_points/material_points.h>

#include <set>
#include <vector>

namespace isochor
{
  /**
   * Tells whether the material points lie too far apart for the grid, or
   * otherwise than their volume says. A cell inside
   * of the body that holds no point resists nothing, so that the body is too
   * soft or falls apart; or it is a hole, whose state is a guess.
   *
   * A cell counts as inside if its centroid lies in what a point stands for,
   * the ball of the point's volume at t = 0, deformed by F. A few such cells
   * are the method's own error; they are to be expected as soon as points of
   * half a cell's volume move through the grid.
   */
  template <int dim>
  class PointSpacing
  {
  public:
    PointSpacing(const BackgroundGrid<dim> &grid);

    /**
     * Look at @p points as they are at a reset of the grid, with the points of
     * integration that holes have got. Costs a loop over the points where none
     * is larger than half of its cell. Collective.
     * @throws ExcMessage if the body falls apart @p at_start.
     */
    void
    check(const PointArrays<dim> &points,
          const double            time,
          const bool              at_start,
          Warnings               &warnings) const;

    /** Compare the volume that @p points integrate with that which they stand
     * for; warn if they have differed for several resets. Collective. */
    void
    compare_volumes(const PointArrays<dim> &points,
                    const double            time,
                    Warnings               &warnings);

    /** For the plain quadrature: @p n_changed of @p n_points have changed their
     * cell at the reset at @p time. Warn once they are too many for its
     * stresses. The same on all ranks. */
    void
    watch_changes_of_cells(const double n_changed,
                           const double n_points,
                           const double time,
                           Warnings    &warnings);

  private:
    /** CPDI: warn of domains that are longer than their cells, or as large as
     * these and beside their nodes. Collective. */
    void
    warn_of_long_domains(const PointArrays<dim> &points,
                         const double            time,
                         Warnings               &warnings) const;
    /** The largest J V_0 / |e| of this rank's points. */
    double
    largest_share(const PointArrays<dim> &points) const;
    /** Cells without points whose centroid lies in what a point stands for:
     * those of this rank, found by all. Collective. */
    std::set<unsigned int>
    find_bare_cells(const PointArrays<dim> &points) const;
    /** Add the cells around a point that it covers. */
    void
    add_covered_cells(const PointArrays<dim> &points,
                      const unsigned int      k,
                      const unsigned int      q,
                      std::set<unsigned int> &covered) const;
    /** Into how many pieces, not connected by any face, or by any vertex, the
     * cells of all ranks fall. */
    unsigned int
    n_pieces(const std::vector<unsigned int> &own_cells,
             const bool                       by_faces = true) const;
    /** Warn if, at the start, a part of the body hangs on a vertex. */
    void
    warn_of_hinges(const PointArrays<dim> &points, Warnings &warnings) const;
    /** Warn if domains of points, the largest of which is @p share of its cell,
     * are too large for shape functions that are not linear. */
    void
    warn_of_large_domains(const PointArrays<dim> &points,
                          const double            share,
                          Warnings               &warnings) const;

    const BackgroundGrid<dim> &grid;
    /** For how many resets the volumes have differed. */
    unsigned int n_resets_apart = 0;
    /** How often a point has changed its cell so far, in the mean. */
    double changes_per_point = 0;
  };
} // namespace isochor

#endif
