/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_on_domains_h
#define isochor_surface_on_domains_h

#include <deal.II/numerics/rtree.h>

#include <isochor/material_points/point_arrays.h>
#include <isochor/material_points/surface_seeding.h>

#include <vector>

namespace isochor
{
  /**
   * Which parts of the body's surface are faces of which points' domains. Both
   * are compared as they were at t = 0: the surface doesn't change there, and
   * domains tile the body, now as then, whether or not they have been split or
   * merged since, and wherever their points are.
   */
  template <int dim>
  class SurfaceOnDomains
  {
  public:
    /** What a face of the surface and a face of a domain have in common, or a
     * simplex of it. */
    struct Part
    {
      FaceCorners<dim> corners; ///< at t = 0
      unsigned int     face;    ///< its number in faces()
      unsigned int     k, q;    ///< cell of the list, and point, of the domain
    };

    SurfaceOnDomains() = default;
    /** @p faces, the same on all ranks. */
    explicit SurfaceOnDomains(const std::vector<SurfaceFace<dim>> &faces);

    const std::vector<SurfaceFace<dim>> &
    faces() const
    {
      return all_faces;
    }

    /** Parts on the domains of this rank's points, in the order of these. The
     * domain is on the inner side. @p at_start, when it is to be found out
     * which faces consist of faces of domains, planes are compared more
     * strictly. */
    std::vector<Part>
    parts(const SimplexGeometry<dim> &geometry,
          const PointArrays<dim>     &body,
          const bool                  at_start) const;

    /** By face: the part of its area that lies on domains, of all ranks.
     * Collective. */
    std::vector<double>
    covered_shares(const std::vector<Part> &parts, const MPI_Comm comm) const;

  private:
    void
    add_parts(const unsigned int                     face,
              const std::array<Point<dim>, dim + 1> &domain,
              const unsigned int                     k,
              const unsigned int                     q,
              const bool                             at_start,
              std::vector<Part>                     &parts) const;

    using Entry = std::pair<BoundingBox<dim>, unsigned int>;

    std::vector<SurfaceFace<dim>> all_faces;
    RTree<Entry>                  tree;
  };
} // namespace isochor

#endif
