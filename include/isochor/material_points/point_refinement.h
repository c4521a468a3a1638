/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_refinement_h
#define isochor_point_refinement_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/statistics.h>
#include <isochor/grid/background_grid.h>
#include <isochor/material_points/material_points.h>
#include <isochor/material_points/point_locator.h>
#include <isochor/material_points/point_merging.h>

#include <functional>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * Splits domains of points that are too large for the cells: where the body
   * is stretched, or small cells of a moving or adaptive grid come to where
   * larger ones were seeded.
   *
   * Domains are bisected, and those of neighbours with them, so that
   * they go on sharing whole faces (DomainBisection): they fill the old ones,
   * so that volume, mass, momentum, centre and second moment are conserved
   * whatever their shape. In the plane those of material that flows are also
   * bisected where they become longer than their cells, and then flipped
   * (DomainFlips).
   */
  template <int dim>
  class PointRefinement
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Split what is too large, if asked for; on adaptive grids, if it
     * @p merges, merge what was split and is small, see PointMerging.
     * Invalidates what was gathered from the points. Whether any point has
     * come or gone. Collective. */
    bool
    refine(MaterialPoints<dim>                         &points,
           const BackgroundGrid<dim>                   &grid,
           const PointLocator<dim>                     &locator,
           const typename PointMerging<dim>::Materials &materials,
           const bool                                   merges);

    /** How many points came and went by it since this was called last. */
    void
    evaluate(Statistics &statistics);

  private:
    using IsLarge = std::function<bool(const PointDomain<dim> &)>;

    struct NewPoint
    {
      unsigned int        cell; ///< of the point it comes from
      Point<dim>          location;
      std::vector<double> properties;
    };

    /** Whether domains of what flows are bisected and flipped. */
    bool
    domains_follow_flow(
      const MaterialPoints<dim>                   &points,
      const typename PointMerging<dim>::Materials &materials) const;
    /** Split points with @p domains that are large; whether they are
     * @p flipped at times. What was added to the points. Collective. */
    std::vector<NewPoint>
    split_domains(MaterialPoints<dim>                 &points,
                  const std::vector<PointDomain<dim>> &domains,
                  const BackgroundGrid<dim>           &grid,
                  const PointLocator<dim>             &locator,
                  const IsLarge                       &is_large,
                  const bool                           flipped) const;
    /** The parts of those of the @p domains of all points that have been
     * bisected, in their order. Collective. */
    std::vector<PointDomain<dim>>
    bisect_domains(const std::vector<PointDomain<dim>> &domains,
                   const BackgroundGrid<dim>           &grid,
                   const PointLocator<dim>             &locator,
                   const IsLarge                       &is_large,
                   const bool                           flipped) const;
    /** Insert @p parts and bring them, and what they were split from, to their
     * cells. Collective. */
    void
    insert(MaterialPoints<dim>         &points,
           const BackgroundGrid<dim>   &grid,
           const PointLocator<dim>     &locator,
           const std::vector<NewPoint> &parts) const;

    /** What is merged may grow by a fourth before it is split again. */
    static constexpr double hysteresis = 0.8;
    /** Of a point in its cell; 0: any. */
    double largest_share = 0, usual_share = 0;
    /** Numbers of points, over all ranks. */
    types::particle_index n_added = 0, n_removed = 0;
  };
} // namespace isochor

#endif
