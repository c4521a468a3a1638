/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_region_cut_h
#define isochor_region_cut_h

#include <isochor/base/rounding.h>
#include <isochor/material_points/body_seeding.h>
#include <isochor/material_points/place_table.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * Cuts the simplex domains of points by the border of a region, of which only
   * inside and outside are known. The domains go on tiling what they tiled, and
   * share whole faces.
   *
   * Where the border crosses an edge of a domain is found by bisection. As in
   * isosurface stuffing (Labelle & Shewchuk, ACM Trans. Graph. 26 (2007) 57),
   * an end that is near to the crossing is moved onto it, so that no slivers
   * come about. A vertex on the surface of the body, or between points of
   * different material, is moved along this surface only. At the crossings left
   * all domains at an edge are bisected, edge by edge in one order, the longest
   * first: neighbours divide the face between them alike.
   *
   * Corners are looked at from within each domain, so that a border on faces of
   * domains cuts none. A domain with all its corners on one side belongs, as a
   * whole, to the side of its centroid. An edge or a corner of the region
   * inside of a domain becomes a chamfer, unless its sides are cut one after
   * the other (SeedsInRegion).
   */
  template <int dim>
  class RegionCut
  {
  public:
    /** The region is where @p condition is positive. What is outside of it is
     * dropped, or kept. The condition must outlive this object. */
    RegionCut(const Expression<dim> &condition, const bool keep_outside);

    /** Bit c: corner c of the domain of @p seed is inside of the region, as
     * seen from within the domain. */
    unsigned char
    corners_inside(const Seed<dim> &seed) const;

    /**
     * Cut the domains of points, once. Returns the points left, each at the
     * centroid of its domain, in the order of @p all; @p is_inside says which
     * of them are in the region. Parts have the cell of the whole, but a domain
     * of which a vertex was moved need not lie in it.
     */
    std::vector<Seed<dim>>
    cut(const std::vector<Seed<dim>> &all, std::vector<bool> &is_inside);

  private:
    using Corners = std::array<unsigned int, dim + 1>;

    /** A domain at the border, or one that has a vertex with such a domain. */
    struct Part
    {
      unsigned int seed;
      Corners      corners; ///< numbers of vertices
    };
    /** A corner of such domains. */
    struct Vertex
    {
      Point<dim>                  place;
      bool                        is_on_border = false;
      bool                        touches  = false; ///< nearly on the border
      bool                        is_moved = false;
      std::vector<unsigned int>   parts;   ///< around it
      std::vector<unsigned int>   beyond;  ///< vertices across the border
      std::vector<Tensor<1, dim>> normals; ///< of faces that it must not leave
    };
    /** Where the border crosses the edge between two vertices. */
    struct Crossing
    {
      unsigned int inside, outside; ///< numbers of vertices
      Point<dim>   place;
      double       share; ///< of the edge, from the vertex inside
      unsigned int rank   = 0;
      unsigned int vertex = 0; ///< there, if the edge is cut

      /** Both vertices, and the share of the edge from each. */
      std::array<std::pair<unsigned int, double>, 2>
      ends() const
      {
        return {{{inside, share}, {outside, 1 - share}}};
      }
    };

    const Expression<dim> &condition;
    const bool             keep_outside;
    std::vector<Seed<dim>> seeds;
    /** Bit c: corner c is inside; all alike if the domain isn't cut. */
    std::vector<unsigned char> sides;

    std::vector<Part>     parts; ///< in the order of seeds
    std::vector<Vertex>   vertices;
    std::vector<Crossing> crossings;
    std::map<std::pair<unsigned int, unsigned int>, unsigned int>
      crossing_of_edge;

    static constexpr unsigned char all_corners = (1u << (dim + 1)) - 1;

    bool
    is_in(const Point<dim> &x) const
    {
      return condition(x, 0.) > 0;
    }
    /** The same, as seen from within the domain of @p seed. */
    bool
    is_in_from(const Seed<dim> &seed, const Point<dim> &x) const
    {
      return is_in(x + rounding::accumulated * (seed.location - x));
    }
    bool
    is_at_border(const unsigned int seed) const
    {
      return sides[seed] != 0 && sides[seed] != all_corners;
    }
    /** Whether the corner @p c is. */
    bool
    is_inside(const Part &part, const unsigned int c) const
    {
      AssertIndexRange(c, dim + 1);
      return ((sides[part.seed] >> c) & 1) != 0;
    }
    void
    find_parts();
    void
    find_crossings();
    Crossing
    find_crossing(const Seed<dim>   &seed,
                  const unsigned int inside,
                  const unsigned int outside) const;
    void
    find_fixed_faces();
    void
    move_vertices();
    /** Whether @p vertex may be moved to @p place. */
    bool
    may_move(const Vertex &vertex, const Point<dim> &place) const;
    /** Order the edges to be cut, and make vertices of their crossings. */
    void
    number_crossings();
    std::vector<Corners>
    divide(const Part &part) const;
    Seed<dim>
    seed_of(const Part &part, const Corners &corners) const;
    bool
    is_piece_inside(const Part      &part,
                    const Corners   &corners,
                    const Seed<dim> &seed) const;
  };
} // namespace isochor

#endif
