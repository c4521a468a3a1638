/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_merging_h
#define isochor_point_merging_h

#include <isochor/material_model/material_model.h>
#include <isochor/material_points/material_points.h>
#include <isochor/material_points/place_table.h>
#include <isochor/material_points/point_domain.h>
#include <isochor/material_points/point_locator.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Merges points that are small for the cells they are in: what was split
   * where the grid was fine is put together again where it is coarse, never
   * more than that. Volume V_0, mass and momentum are conserved to rounding.
   * Domains are put together in the reverse order of their bisections, and so
   * that no corner hangs: all parts around the middle of an edge that was
   * bisected at once, if that still is the newest corner of all of them (as
   * Chen & Zhang, SIAM J. Numer. Anal. 48 (2010) 1321-1341, coarsen grids), and
   * if the edge is nearly straight. The whole has the deformation gradient of
   * its corners; the current volume around the middle stays.
   *
   * Two parts are merged only if they are strained alike: if their deformation
   * gradients differ by at most `tolerance` times their Green strain. Of their
   * strain energy, quadratic in the strain, about (tolerance / 2)^2 at most is
   * lost then.
   */
  template <int dim>
  class PointMerging
  {
  public:
    using Materials = std::vector<std::unique_ptr<MaterialModel<dim>>>;

    /** How far a corner in the middle of an edge may be from there, relative to
     * the edge. */
    static constexpr double straightness = 0.01;
    static constexpr double tolerance    = 0.1; ///< of strains

    /** The volume of a merged point is at most @p largest_share of that of its
     * cell. */
    PointMerging(MaterialPoints<dim>       &points,
                 const BackgroundGrid<dim> &grid,
                 const PointLocator<dim>   &locator,
                 const Materials           &materials,
                 const double               largest_share);

    /** Merge what can be merged; how many points have vanished, over all ranks.
     * Collective. */
    types::particle_index
    merge();

    /** After merge(): the domains of the points of this rank. */
    std::vector<PointDomain<dim>>
    take_domains()
    {
      return std::move(domains);
    }

  private:
    /** One of the two parts of a domain. */
    struct Part
    {
      PointDomain<dim>                 domain;
      const double                    *properties = nullptr;
      Particles::ParticleIterator<dim> particle; ///< if it is of this rank
      bool                             is_own   = false;
      bool                             is_there = false;
    };
    /** Two parts of a domain, in the order in which its corners have the ends
     * of the edge. */
    struct Pair
    {
      std::array<Part, 2> parts;
      unsigned int        middle; ///< number of the corner both have
      PointDomain<dim>    whole;
      std::vector<double> properties;
    };

    types::particle_index
    merge_domains();

    bool
    fits(const double volume, const unsigned int cell) const;
    bool
    is_willing(const PointDomain<dim> &part) const;
    /** The middles of edges that may vanish if it is for the parts around them;
     * the same on all ranks. Adds the own parts that are willing, by the
     * place among the domains. */
    PlaceTable<dim>
    find_middles(std::vector<unsigned int> &willing,
                 std::vector<unsigned int> &is_vetoed) const;
    /** Of the parts that are @p willing. */
    std::vector<Pair>
    find_pairs(const std::vector<unsigned int> &willing,
               const PlaceTable<dim>           &middles,
               const std::vector<unsigned int> &is_vetoed);
    /** Bring parts to ranks that have the other one. */
    void
    exchange_parts(std::vector<Part> &parts);
    /** Make the whole; whether it is as it should be. */
    bool
    unite(Pair &pair) const;
    bool
    are_alike(const double *first, const double *second) const;

    MaterialPoints<dim>       &points;
    const BackgroundGrid<dim> &grid;
    const PointLocator<dim>   &locator;
    const Materials           &materials;
    const double               largest_share;
    const PlaceScale<dim>      scale;
    /** Of the points of this rank before this round. */
    std::vector<PointDomain<dim>> domains;
    /** Corners at t = 0 of what was merged in the last round, the same on all
     * ranks: elsewhere nothing that could not be merged can be now. None in
     * the first round, in which all is looked at. */
    std::optional<PlaceTable<dim>> changed_places;
    /** By cell: whether points in it have been merged in this round; empty if
     * that isn't known. */
    std::vector<unsigned char> is_concerned;
    /** What exchange_parts() brought, to which parts point. */
    std::vector<std::vector<double>> received;
  };
} // namespace isochor

#endif
