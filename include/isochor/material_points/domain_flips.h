/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_domain_flips_h
#define isochor_domain_flips_h

#include <isochor/material_model/material_model.h>
#include <isochor/material_points/material_points.h>
#include <isochor/material_points/place_table.h>
#include <isochor/material_points/point_domain.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Whether the domain of a point is one of material that flows, whose domains
   * may change: it has passed material on (UnseenVolume). */
  template <int dim>
  bool
  is_flowing(const double                                           *properties,
             const PointLayout                                      &layout,
             const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials);

  /**
   * Gives the domains of material that flows better shapes, in the plane: two
   * triangles that share an edge become those with the other diagonal of their
   * quadrilateral where the worse of the two is better then (Lawson's flips),
   * so that shear does not draw domains out to slivers. Nothing else of the
   * mesh changes, its corners and the body's surface least of all.
   *
   * What the old triangles have of a new one is theirs by area: V_0, mass and
   * momentum are conserved, and det F is that of the volumes. The rest of the
   * state is their mean (mean_state()): what flows has no memory of its shape,
   * so that F says no more than V/V_0, and where a point was at t = 0 is known
   * in the mean only; but F takes outer faces from where they were at t = 0,
   * which conditions on surfaces go by, and no triangle gets two of them.
   *
   * The quality of a triangle is 4√3 A / Σ l², 1 if it is equilateral (Bank,
   * PLTMG, 1998). All ranks do the same, with all triangles that are poor and
   * their neighbours, the worst first, so that it does not matter whose they
   * are.
   */
  class DomainFlips
  {
  public:
    using Materials = std::vector<std::unique_ptr<MaterialModel<2>>>;

    /** Domains with a lower quality look for a neighbour to flip with. */
    static constexpr double poor = 0.5;

    DomainFlips(MaterialPoints<2>       &points,
                const BackgroundGrid<2> &grid,
                const Materials         &materials);

    /** Flip what is better then. How many flips there were, on all ranks; if
     * any, points are no longer where the handler believes. Collective. */
    unsigned int
    flip();

  private:
    struct Triangle
    {
      PointDomain<2>::Corners     corners;
      PointDomain<2>::Corners     places; ///< at t = 0, of outer faces
      std::array<unsigned int, 3> number; ///< of the corners
      unsigned int                body, outer_faces;
      std::vector<double>         properties;
      bool                        is_changed = false;
    };
    /** Body and numbers of the two corners. */
    using Edge = std::array<unsigned int, 3>;
    /** Two triangles, by number, that share an edge. */
    struct Pair
    {
      unsigned int triangle;
      /** Places among its corners: of that which isn't on the edge, of the end
       * that it keeps when it is flipped, and of the one that it loses. */
      unsigned int apex, kept, lost;
    };
    using Pairs = std::array<Pair, 2>;

    Edge
    edge(const Triangle &triangle, const unsigned int opposite) const;
    /** The corners of those of the @p flowing domains that are poor, on all
     * ranks. Collective. */
    PlaceTable<2>
    corners_of_poor(const std::vector<PointDomain<2>> &flowing) const;
    /** Find the triangles that are poor on any rank, and what shares an edge
     * with them. Collective. */
    void
    collect();
    /** What collect() brought from a rank. */
    void
    add_triangles(const std::vector<double> &values, PlaceTable<2> &corners);
    /** Let @p triangle be known at its edges, or no longer. */
    void
    link(const unsigned int triangle, const bool is_there);
    /** The neighbour with which @p triangle is best off; false if it stays as
     * it is. */
    bool
    find_partner(const unsigned int triangle, Pairs &best) const;
    void
    flip(const Pairs &pairs);
    /** Give the first of the @p old triangles, flipped, the state of what was
     * where it is. */
    void
    set_state(const std::array<Triangle, 2> &old,
              const Pairs                   &pairs,
              Triangle                      &triangle) const;
    /** Change the reference corners of @p domain, with the corners of
     * @p triangle, so that its outer face is where it was, with the same area.
     */
    static void
    place_outer_face(const Triangle &triangle, PointDomain<2> &domain);
    /** Let own points know. */
    void
    store() const;

    MaterialPoints<2>       &points;
    const BackgroundGrid<2> &grid;
    const Materials         &materials;
    std::vector<Triangle>    triangles;
    unsigned int             first_own = 0; ///< its number
    /** The points of this rank among the triangles. */
    std::vector<Particles::ParticleIterator<2>> own;
    std::map<Edge, std::set<unsigned int>>      sides; ///< by edge: triangles
  };
} // namespace isochor

#endif
