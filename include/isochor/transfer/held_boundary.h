/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_held_boundary_h
#define isochor_held_boundary_h

#include <isochor/grid/simplex_geometry.h>
#include <isochor/material_points/point_locator.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace isochor
{
  /** A vertex, and the name of a part of the body. */
  using VertexOfPart = std::pair<unsigned int, unsigned int>;

  /**
   * The boundary of the grid where conditions hold it, for ApproachWatch: which
   * vertices, and where its faces look. Normals are outward and of length 1;
   * two are alike that are less than 60 degrees apart, as boundaries may be
   * curved.
   */
  template <int dim>
  class HeldBoundary
  {
  public:
    using Normals = std::vector<Tensor<1, dim>>;

    /** The @p vertices that conditions hold in any direction, ascending. */
    void
    set(const std::vector<unsigned int> &vertices);

    bool
    is_empty() const
    {
      return walls.empty();
    }

    /** To be called before what follows, after set(). */
    void
    find_normals(const SimplexGeometry<dim> &geometry);

    /** Normals of the boundary at those vertices of a @p cell with which the
     * part @p name has @p touched it. */
    Normals
    touched_normals(const SimplexGeometry<dim>   &geometry,
                    const std::set<VertexOfPart> &touched,
                    const unsigned int            cell,
                    const unsigned int            name) const;

    /** Add to the normals @p own of a boundary along which points slide, those
     * that a curved one has at the @p cell which they have come to. */
    void
    follow(const SimplexGeometry<dim> &geometry,
           const unsigned int          cell,
           Normals                    &own) const;

    /** Whether @p place is at a face whose vertices are held. */
    bool
    is_at(const SimplexGeometry<dim> &geometry,
          const LocateResult<dim>    &place) const;

    /** Add to @p found the held vertices of faces of a @p cell at the boundary
     * that face another way than the normals @p own, with the part @p name. */
    void
    find_others(const SimplexGeometry<dim> &geometry,
                const unsigned int          cell,
                const Normals              &own,
                const unsigned int          name,
                std::set<VertexOfPart>     &found) const;

    /** Add to @p found the held vertices of a @p cell where the boundary faces
     * as the normals @p own do, with the part @p name. */
    void
    find_own(const SimplexGeometry<dim> &geometry,
             const unsigned int          cell,
             const Normals              &own,
             const unsigned int          name,
             std::set<VertexOfPart>     &found) const;

  private:
    bool
    is_wall(const unsigned int vertex) const;

    std::vector<unsigned int> walls;
    /** Of the faces at the boundary, by vertex. */
    std::map<unsigned int, Normals> normals;
  };
} // namespace isochor

#endif
