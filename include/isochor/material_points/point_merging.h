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
   *
   * Domains are put together in the reverse order of their bisections, and so
   * that no corner hangs: all parts around the middle of an edge that was
   * bisected at once, if that still is the newest corner of all of them (as
   * Chen & Zhang, SIAM J. Numer. Anal. 48 (2010) 1321-1341, coarsen grids), and
   * if the edge is nearly straight. The whole has the deformation gradient of
   * its corners; the current volume around the middle stays.
   *
   * Without domains the nearest points of a cell are merged at their centre of
   * mass, if their deformation gradients are nearly the same. The whole has
   * their mean, scaled to their current volume.
   *
   * Two parts are merged only if they are strained alike: if their deformation
   * gradients differ by at most a tolerance times their Green strain. Of their
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

    /** The volume of a merged point is at most @p largest_share of that of its
     * cell; domains are left alone where their cell would be left with fewer
     * than @p least_points. */
    PointMerging(MaterialPoints<dim>       &points,
                 const BackgroundGrid<dim> &grid,
                 const PointLocator<dim>   &locator,
                 const Materials           &materials,
                 const double               largest_share,
                 const double               tolerance,
                 const unsigned int         least_points);

    /** Merge what can be merged; how many points have vanished, over all ranks.
     * Collective. */
    types::particle_index
    merge();

    /** After merge(): the domains of the points, which have them, of this
     * rank. */
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
    merge_points_of_cells();
    types::particle_index
    merge_domains();
    void
    unite_points(Particles::ParticleIterator<dim>       &remaining,
                 const Particles::ParticleIterator<dim> &vanishing) const;

    bool
    fits(const double volume, const unsigned int cell) const;
    /** Into the cell and those next to it: a point that soon comes to one of
     * them is not to be split again. */
    bool
    fits_around(const double volume, const unsigned int cell) const;
    /** Count the points of cells, and find what has changed since the last
     * round: corners of what was merged, and those of domains in cells that
     * have more points now. */
    void
    find_changes();
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
    const double               largest_share, tolerance;
    const unsigned int         least_points;
    const PlaceScale<dim>      scale;
    /** Of the points of this rank before this round. */
    std::vector<PointDomain<dim>> domains;
    /** By cell, the own ones in this round. */
    std::vector<unsigned int> n_points;
    /** Corners at t = 0 of what this rank has merged in the last round. */
    std::vector<double> corners_of_merged;
    /** What find_changes() has found, the same on all ranks: where nothing
     * has changed nothing that could not be merged can be now. None in the
     * first round, in which all is looked at. */
    std::optional<PlaceTable<dim>> changed_places;
    /** By cell: whether points in it have been merged in this round; empty if
     * that isn't known. */
    std::vector<unsigned char> is_concerned;
    /** What exchange_parts() brought, to which parts point. */
    std::vector<std::vector<double>> received;
  };
} // namespace isochor

#endif
