/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_domain_h
#define isochor_point_domain_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <isochor/material_points/material_points.h>
#include <isochor/material_points/place_table.h>

#include <array>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The domain of a material point, by its corners. */
  template <int dim>
  struct PointDomain
  {
    using Corners = std::array<Point<dim>, dim + 1>;

    Corners      reference; ///< at t = 0, where neighbours share corners
    Corners      current;
    double       volume = 0;     ///< J V_0 of the point
    Point<dim>   location;       ///< of the point: the centroid, if in the grid
    unsigned int cell       = 0; ///< that holds the location
    unsigned int point      = 0; ///< the point that it comes from
    unsigned int n_halvings = 0; ///< of that point's domain
    /** What Ancestry makes of the bisections. */
    double ancestry = 0;
    /** See PointArrays::outer_faces. */
    unsigned int outer_faces = 0;
  };

  /** The domains of the points of this rank, in the order of the handler. */
  template <int dim>
  std::vector<PointDomain<dim>>
  point_domains(const MaterialPoints<dim> &points);

  /** The corners of the domain of a point with these @p properties at t = 0,
   * from the point. */
  template <int dim>
  CornerVectors<dim>
  corners_at_start(const double *properties, const PointLayout &layout);

  /** The edges from the first of the @p corners, points or vectors, as columns.
   */
  template <int dim, typename Corners>
  Tensor<2, dim>
  edge_matrix(const Corners &corners)
  {
    Tensor<2, dim> columns;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        columns[d][c] = corners[c + 1][d] - corners[0][d];
    return columns;
  }

  /** Let @p properties of a point tell where @p domain is: domain, ancestry,
   * and the displacement of the point to its location. */
  template <int dim>
  void
  store_domain(const PointDomain<dim>  &domain,
               const PointLayout       &layout,
               const ArrayView<double> &properties);

  /** Let @p properties of a point tell what it has when the faces of its domain
   * have moved through the material, which stays, at the density of t = 0: V_0
   * and mass, and the displacement to where its centroid has come, @p from
   * where. The volumes are in the plane in axisymmetry, where rings of R =
   * r/F_θθ pass. False, and all is as before, if nothing would be left. */
  template <int dim>
  bool
  move_domain(const Point<dim>  &from,
              const double       volume_before,
              const Point<dim>  &centre,
              const double       volume,
              const PointLayout &layout,
              double            *properties);

  /** The mean of the corners. */
  template <int dim>
  Point<dim>
  centroid(const typename PointDomain<dim>::Corners &corners);

  /** The longest edge of a domain with these @p corners, over how far @p cell
   * and its neighbours extend in the direction of that edge. */
  template <int dim>
  double
  length_in_cells(const typename PointDomain<dim>::Corners &corners,
                  const SimplexGeometry<dim>               &geometry,
                  const unsigned int                        cell);

  /** From this length_in_cells() on, nodes between the corners of a domain feel
   * nothing: a bar with domains of half of a cell at first was right up to a
   * stretch of 2.4. */
  constexpr double tolerated_length = 1.2;

  /** How places at t = 0 are told apart: by a tiny part of the extent of the
   * grid and of its smallest cell but, far from the origin, by more than what
   * coordinates are rounded to there.
   * @throws ExcMessage if the cells are too small for that. */
  template <int dim>
  PlaceScale<dim>
  scale_of_places(const BackgroundGrid<dim> &grid);

  /**
   * The bisections that a domain comes from, as the digits of an integer that a
   * double holds exactly; 0 for a domain as it was seeded. If they become too
   * many the first are forgotten.
   *
   * The corners of the parts of a domain are, in this order: those that are not
   * on the edge that was bisected, the end of that edge which the part has,
   * and its middle. The last digit says where the ends were among the corners
   * of the whole.
   */
  template <int dim>
  struct Ancestry
  {
    /** Of the part that has the end at place @p kept of the bisected edge, not
     * the one at @p lost. */
    static double
    of_part(const double       whole,
            const unsigned int kept,
            const unsigned int lost);
    /** The places (kept, lost) of the last bisection; @p part is not 0. */
    static std::pair<unsigned int, unsigned int>
    last(const double part);
    /** Of the whole. */
    static double
    of_whole(const double part);
  };

} // namespace isochor

#endif
