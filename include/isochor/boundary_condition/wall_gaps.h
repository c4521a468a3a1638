/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_wall_gaps_h
#define isochor_wall_gaps_h

#include <isochor/boundary_condition/contact_search.h>

#include <limits>
#include <vector>

namespace isochor
{
  /**
   * The gaps between the body and its walls, by nodes of the grid. Let g_c be
   * the distance of corner c of a point's domain from the wall, and w_cI the
   * part of node I in N_I(x_c), of all nodes of the wall that act on c. If the
   * body moves towards the wall by g_I at its nodes there, no corner goes
   * through as long as
   *
   *   Σ_I w_cI g_I <= g_c   for all c,
   *
   * and the surface touches the wall where that is an equality. Wanted are the
   * largest g_I: they begin with the least g_c of the corners that act on the
   * node, and grow by
   *
   *   min_c (g_c - Σ_J w_cJ g_J) / (n_c w_cI)
   *
   * at a time, n_c the number of nodes of the wall that act on c, which keeps
   * what has been said above. (The least g_c alone is that of the surface up to
   * a cell beside the node.)
   *
   * Where points see the functions of their own cells only (cell-filled +
   * boundary), N_I are at the start of a step those of the cell that the corner
   * lies in, which may be empty of points.
   *
   * Points without domains are spheres of radius 3/4 V_p^(1/d) that deform with
   * the body, such that bodies that fill the cells at the wall have no gap:
   * these gaps are an estimate.
   */
  struct WallGaps
  {
    static constexpr double unknown = std::numeric_limits<double>::max();

    /** By nodes of all walls one after the other, the same on all ranks: the
     * gap (m), negative where the body is in the wall, exactly 0 where rounding
     * may have made what it is, unknown if no corner acts on the node; and the
     * size of a cell there (m). */
    std::vector<double> gap, cell_size;
  };

  /** At the start of the step, or at its end with its displacement increments
   * @p unknowns. @p walls: their nodes, without the forces. With @p spheres
   * points without domains count, too. Collective. */
  template <int dim>
  WallGaps
  find_wall_gaps(const StepContext<dim>               &step,
                 const NodalField *const               unknowns,
                 const std::vector<WallContacts<dim>> &walls,
                 const bool                            spheres);

  /**
   * What one-sided walls know of the body at the start of a step: its gaps, and
   * so that a node is to be held not at the wall, but where the surface of the
   * body reaches it. In statics, on grids that are put back; on others nodes
   * remember their gaps, and in dynamics the nodes that hit the wall in the
   * middle of a step would gain energy (9 % in tests/impact).
   */
  template <int dim>
  class BodyAtWalls
  {
  public:
    /** @p may_be: whether @p wall and its nodes have the shape for it; these
     * are known as @p nodes, whose gaps have the sign @p side. All that has
     * been known of them is forgotten. */
    void
    add(const StepContext<dim>        &step,
        const bool                     may_be,
        const WallContacts<dim>       &wall,
        const std::vector<WallNode *> &nodes,
        const int                      side);

    /** Let the nodes know. Collective. */
    void
    find(const StepContext<dim> &step);

  private:
    std::vector<WallContacts<dim>> walls;
    std::vector<WallNode *>        nodes;
    std::vector<int>               sides;
  };
} // namespace isochor

#endif
