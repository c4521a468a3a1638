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
   * Splits material points that are too large for the cells: where the body is
   * stretched, or small cells of a moving or adaptive grid come to where larger
   * ones were seeded. A cell inside of the body without points has nothing that
   * would remember the material in it: the body closes such gaps, and loses
   * volume while det F of every point stays right.
   *
   * A point becomes four (2D) or five (3D) equal ones, itself and the corners
   * of an equilateral triangle or tetrahedron around it, all of which know what
   * it knew. Volume, mass and momentum are conserved, and so are centre and
   * second moment of the mass; beside a wall of the grid, where there is no
   * room for them, the others come closer, and the second moment becomes less:
   * that across the wall if it is along an axis, else all of it.
   *
   * Domains of points are bisected, and those of neighbours with them, so that
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

    /** To be called before refine(): whether the quadrature integrates over
     * domains. Then they have to fit together, and cells need no points of
     * their own. */
    void
    integrate_over_domains(const bool integrate)
    {
      have_to_fit = integrate;
      if (least_points == 0 && !integrate)
        least_points = 1;
    }

    /** Whether points may be split on a grid that does not adapt. */
    bool
    splits_points() const
    {
      return largest_share > 0;
    }

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
      const BackgroundGrid<dim>                   &grid,
      const typename PointMerging<dim>::Materials &materials) const;
    /** Split points without domains; those with more than @p share of their
     * cell become smaller. What they have lost. */
    std::vector<NewPoint>
    split(MaterialPoints<dim>     &points,
          const PointLocator<dim> &locator,
          const double             share) const;
    /** Split points with @p domains that are large, and where cells have fewer
     * than @p least points; whether they are @p flipped at times. What was
     * added to the points. Collective. */
    std::vector<NewPoint>
    split_domains(MaterialPoints<dim>                 &points,
                  const std::vector<PointDomain<dim>> &domains,
                  const BackgroundGrid<dim>           &grid,
                  const PointLocator<dim>             &locator,
                  const IsLarge                       &is_large,
                  const bool                           flipped,
                  const unsigned int                   least) const;
    /** The parts of those of the @p domains of all points that have been
     * bisected, in their order. Collective. */
    std::vector<PointDomain<dim>>
    bisect_domains(const std::vector<PointDomain<dim>> &domains,
                   const BackgroundGrid<dim>           &grid,
                   const PointLocator<dim>             &locator,
                   const IsLarge                       &is_large,
                   const bool                           flipped,
                   const unsigned int                   least) const;
    /** Insert @p parts and bring them, and what they were split from, to their
     * cells. Collective. */
    void
    insert(MaterialPoints<dim>         &points,
           const BackgroundGrid<dim>   &grid,
           const PointLocator<dim>     &locator,
           const std::vector<NewPoint> &parts) const;

    /** Of a point in its cell; 0: any. */
    double largest_share = 0, share_on_adaptive_grids = 0;
    /** In cells inside of the body, with domains. */
    unsigned int least_points = 0;
    bool         have_to_fit  = true; ///< domains of neighbours
    std::string  merging;
    double       merging_tolerance = 0;
    /** Numbers of points, over all ranks. */
    types::particle_index n_added = 0, n_removed = 0;
  };
} // namespace isochor

#endif
