/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_boundary_partner_h
#define isochor_grid_boundary_partner_h

#include <isochor/base/expression.h>
#include <isochor/boundary_condition/one_sided_wall.h>
#include <isochor/boundary_condition/wall_surface.h>
#include <isochor/interaction/partner.h>
#include <isochor/interaction/smooth_facets.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * A named boundary of the grid as what a surface interacts with: where the
   * grid was generated or, if it has a prescribed motion, where it is by this,
   * moved along its normal by a formula n(x, t), x the place at t = 0. It is
   * smooth where faces meet at less than 40 degrees (WallSurface). A formula
   * that depends on the place moves the vertices. Of the copies of the grid
   * (layers) it is that of the first. The same on all ranks.
   */
  template <int dim>
  class GridBoundaryPartner : public Partner<dim>
  {
  public:
    /** Number @p which of the @p walls. Others with the same formula may be
     * parts of one smooth surface. */
    GridBoundaryPartner(const std::vector<OneSidedWall> &walls,
                        const unsigned int               which);

    void
    initialize(const BackgroundGrid<dim> &grid) override;
    void
    set_trial(const TrialMotion &next) override
    {
      trial    = next;
      is_built = false;
    }
    void
    update(const StepContext<dim> &step, const NodalField &unknowns) override;
    PartnerPlace<dim>
    nearest(const typename Partner<dim>::SurfacePlace &place) const override;
    /** The surface there keeps to the place of the boundary that it was next to
     * at t = 0. */
    PartnerPlace<dim>
    original(const typename Partner<dim>::SurfacePlace &place) const override;

  private:
    using Facets = SmoothFacets<dim>;
    using Faces  = std::vector<typename WallSurface<dim>::Face>;

    /** The faces of the boundary, with the vertices of the grid given. @p move:
     * see WallSurface. */
    Faces
    faces_at(const std::vector<Point<dim>>          &vertices,
             const typename WallSurface<dim>::Shift &move) const;
    std::unique_ptr<Facets>
    facets_at(const std::vector<Point<dim>>          &vertices,
              const typename WallSurface<dim>::Shift &move) const;
    /** By its vertices the faces at an edge: number, if it is one of this
     * boundary, and the direction in the face away from the edge. */
    struct AtEdge
    {
      unsigned int   face;
      Tensor<1, dim> way;
    };
    using Edge  = std::array<unsigned int, dim - 1>;
    using Edges = std::map<Edge, std::vector<AtEdge>>;
    Edges
    edges_of(const Faces &faces) const;
    /** What becomes of the surface at an edge of face @p f, with the faces
     * there; those that it goes on in smoothly are added to @p smooth. */
    typename Facets::Rim
    rim_of(const Faces               &faces,
           const unsigned int         f,
           const std::vector<AtEdge> &at_edge,
           std::vector<unsigned int> &smooth) const;
    void
    find_rims();
    /** Where a place @p X of the body at t = 0 is on a face of the boundary, or
     * between this chord and the smooth surface, its distance from that (m): an
     * error of the body's surface, which fits the wall. Else 0. */
    double
    distance_of_chord(const Point<dim> &X) const;
    /** n(x, t) (m) at the end of the step, or of a trial. */
    double
    shift_at(const Point<dim> &x) const;

    const OneSidedWall       wall;
    std::vector<std::string> boundaries; ///< with the same formula; own first
    const Expression<dim>    formula;
    bool                     depends_on_place = false;

    const BackgroundGrid<dim> *grid = nullptr;
    std::vector<Point<dim>>    reference; ///< vertices at t = 0
    /** By face: its rims and the number of its part, see SmoothFacets. */
    std::vector<std::array<typename Facets::Rim, dim>> rims;
    std::vector<unsigned int>                          parts;
    std::unique_ptr<Facets>                            at_start, now;
    double      shift    = 0; ///< if it is the same everywhere
    double      time     = 0;
    bool        is_built = false;
    TrialMotion trial;
  };
} // namespace isochor

#endif
