/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_carried_motion_h
#define isochor_carried_motion_h

#include <isochor/grid/background_grid.h>
#include <isochor/transfer/last_motion.h>

#include <memory>
#include <vector>

namespace isochor
{
  /** The last motion of the nodes of an adaptive grid on the way to the next
   * one: interpolated in the cells of the old grid. */
  template <int dim>
  class CarriedMotion
  {
  public:
    /** Take @p last_motion, of all ranks, from the nodes of @p grid.
     * Collective. */
    CarriedMotion(const BackgroundGrid<dim> &grid,
                  const LastMotion          &last_motion);

    /** Make it that of the nodes of the next @p grid that lie where it is
     * known. */
    void
    hand_over(const BackgroundGrid<dim> &grid, LastMotion &last_motion) const;

  private:
    std::unique_ptr<const SimplexGeometry<dim>> geometry; ///< null: at rest
    std::vector<Leaf<dim>>                      leaves;
    std::vector<unsigned int>                   first_cells; ///< of leaves
    unsigned int                                n_components = 0;
    std::vector<double>                         unknowns; ///< by vertex
    std::vector<unsigned char>                  is_known;
  };
} // namespace isochor

#endif
