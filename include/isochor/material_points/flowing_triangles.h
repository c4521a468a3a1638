/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_flowing_triangles_h
#define isochor_flowing_triangles_h

#include <isochor/material_model/material_model.h>
#include <isochor/material_points/place_table.h>
#include <isochor/material_points/point_domain.h>

#include <algorithm>
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

  /** Positive if the corners go around it counter-clockwise. */
  double
  area(const Point<2> &a, const Point<2> &b, const Point<2> &c);

  /** 4√3 A / Σ l², 1 if the triangle is equilateral (Bank, PLTMG, 1998). */
  double
  quality(const Point<2> &a, const Point<2> &b, const Point<2> &c);

  inline double
  quality(const PointDomain<2>::Corners &corners)
  {
    return quality(corners[0], corners[1], corners[2]);
  }

  PointDomain<2>::Corners
  map_corners(const Tensor<2, 2> &map, const PointDomain<2>::Corners &corners);

  /** The lengths of the edges opposite to the corners. */
  std::array<double, 3>
  edge_lengths(const PointDomain<2>::Corners &corners);

  inline double
  shortest_edge(const PointDomain<2>::Corners &corners)
  {
    const std::array<double, 3> lengths = edge_lengths(corners);
    return *std::min_element(lengths.begin(), lengths.end());
  }

  /**
   * Domains of material that flows, in the plane, that have poor shapes, with
   * those around them, for DomainFlips and DomainCollapse to change. All ranks
   * have all of them and change them alike, so that it does not matter whose
   * they are.
   */
  class FlowingTriangles
  {
  public:
    using Materials = std::vector<std::unique_ptr<MaterialModel<2>>>;

    /** Triangles with a lower quality are poor. */
    static constexpr double poor = 0.5;
    /** If they are so in their cell, too, which may be long itself. */
    static bool
    is_poor(const PointDomain<2>::Corners &corners,
            const Tensor<2, 2>            &to_unit);
    /** Edges are short that have less than this length, in cells: nodes see
     * nothing of what they do. */
    static constexpr double short_in_cells = 0.2;

    struct Triangle
    {
      PointDomain<2>::Corners     corners;
      PointDomain<2>::Corners     places; ///< at t = 0, of outer faces
      std::array<unsigned int, 3> number; ///< of the corners
      unsigned int                body, outer_faces;
      Tensor<2, 2>                to_unit; ///< FlowingTriangles::to_unit()
      std::vector<double>         properties;
      bool                        is_changed = false, is_gone = false;

      /** Whether the edge opposite to a corner is on the body's surface. */
      bool
      has_face(const unsigned int opposite) const;
      /** Which corner has a number; 3 if none has. */
      unsigned int
      place_of(const unsigned int corner) const;
    };
    /** Body and numbers of the two corners. */
    using Edge = std::array<unsigned int, 3>;

    /** Find the triangles that are poor on any rank, and what touches them.
     * Collective. */
    FlowingTriangles(MaterialPoints<2>       &points,
                     const BackgroundGrid<2> &grid,
                     const Materials         &materials);

    const PointLayout &
    layout() const
    {
      return points.layout();
    }

    static Edge
    edge(const Triangle &triangle, const unsigned int opposite);

    /** The triangles that share an edge. */
    const std::set<unsigned int> &
    at_edge(const Edge &edge) const
    {
      return sides.at(edge);
    }

    /** R of the centroid in axisymmetry, else 1. */
    double
    radius_at_start(const Triangle &triangle) const;

    /** Scale F so that V_0 fills the corners, and what the law remembers of
     * volumes, which is of the determinant @p J. */
    void
    fill(const double J, Triangle &triangle) const;

    /** Let @p triangle be known at its edges, or no longer. */
    void
    link(const unsigned int triangle, const bool is_there);

    /** Let own points know. Those that are gone leave the handler; where the
     * others are it doesn't know. Collective. */
    void
    store();

    MaterialPoints<2>       &points;
    const BackgroundGrid<2> &grid;
    const Materials         &materials;
    std::vector<Triangle>    triangles;

  private:
    /** The corners of those of the @p flowing domains that are poor, on all
     * ranks. Collective. */
    PlaceTable<2>
    corners_of_poor(const std::vector<PointDomain<2>> &flowing) const;
    /** What scales the extents of a cell to 1. */
    Tensor<2, 2>
    to_unit(const unsigned int cell) const;
    /** What comes from a rank. */
    void
    add_triangles(const std::vector<double> &values, PlaceTable<2> &corners);
    /** Change the reference corners of @p domain, with the corners of
     * @p triangle, so that its outer face is where it was, with the same area.
     */
    static void
    place_outer_face(const Triangle &triangle, PointDomain<2> &domain);

    unsigned int first_own = 0; ///< its number
    /** The points of this rank among the triangles. */
    std::vector<Particles::ParticleIterator<2>> own;
    std::map<Edge, std::set<unsigned int>>      sides; ///< by edge: triangles
  };
} // namespace isochor

#endif
