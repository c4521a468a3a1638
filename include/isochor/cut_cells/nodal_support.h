/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nodal_support_h
#define isochor_nodal_support_h

#include <isochor/cut_cells/cell_occupancy.h>

#include <vector>

namespace isochor
{
  /**
   * The *support* of a node: the part of the cells around it that the body
   * fills, as the node sees it,
   *   φ_I = Σ_p J_p w_p N_pI / Σ_{e∋I} |e|/(d+1),
   * w_p the volume of integration.
   */
  template <int dim>
  class NodalSupport
  {
  public:
    /** Both arguments are kept by reference. */
    NodalSupport(const BackgroundGrid<dim> &grid,
                 const CellOccupancy<dim>  &occupancy)
      : grid(grid)
      , occupancy(occupancy)
    {}

    /** Of @p points with the weights of the step; the occupancy is up to date.
     * Collective. */
    void
    find(const PointArrays<dim> &points);

    /** φ_I, of vertices near this rank. */
    double
    operator()(const unsigned int vertex) const;

  private:
    const BackgroundGrid<dim> &grid;
    const CellOccupancy<dim>  &occupancy;
    /** Σ_p J_p w_p N_pI by vertex, near this rank; and where it isn't zero. */
    std::vector<double>       volume_at;
    std::vector<unsigned int> summed;
  };
} // namespace isochor

#endif
