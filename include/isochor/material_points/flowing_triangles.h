/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_flowing_triangles_h
#define isochor_flowing_triangles_h

#include <isochor/material_model/material_model.h>
#include <isochor/material_points/place_table.h>
#include <isochor/material_points/triangle_shape.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <tuple>
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
    /** Where flow parts, faces on the surface are stretched without end. By
     * more than this F doesn't know of: where a face was at t = 0 is known to a
     * thousandth of its length, as det F of larger entries would be rounding.
     */
    static constexpr double largest_stretch = 1e3;

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

    /** By which turns are taken: a measure; where it is the same but for
     * rounding (as float, of equal triangles, or of an edge seen by both), how
     * far along a direction that no lattice has. So that neither rounding nor
     * the number of ranks decides. */
    using Turn = std::tuple<float, double, unsigned int>;
    static double
    tie_break(const Point<2> &place)
    {
      return place[0] + numbers::SQRT2 * place[1];
    }
    Turn
    turn(const double measure, const unsigned int triangle) const
    {
      return {static_cast<float>(measure),
              tie_break(centroid<2>(triangles[triangle].corners)),
              triangle};
    }

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
