/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_seeding_h
#define isochor_seeding_h

#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * The places and volume fractions (weights that sum to 1) of @p n_points
   * material points in the reference simplex:
   *  - n = k^dim: the centroids of the regular subdivision into k^dim simplices
   *    of equal volume (1, 4, 9, 16, ... in 2D; 1, 8, 27, ... in 3D);
   *  - 2D, 3, 6 and 12: the symmetric rules of degree 2, 4 and 6 of Dunavant,
   *    Int. J. Numer. Meth. Eng. 21 (1985) 1129-1148;
   *  - 3D, 4: the symmetric rule of degree 2;
   *  - every other count for which deal.II has a simplex rule.
   * Throws otherwise, naming the counts there are.
   */
  template <int dim>
  Quadrature<dim>
  material_point_rule(const unsigned int n_points);

  /** The corners of a simplex relative to its centroid. */
  template <int dim>
  using CornerVectors = std::array<Tensor<1, dim>, dim + 1>;

  /** The d! Kuhn simplices of the unit cube, by their corners. They tile it. */
  template <int dim>
  std::vector<std::array<Point<dim>, dim + 1>>
  box_simplices();

  /**
   * The simplex domains of the points of material_point_rule(), in the same
   * order and in the reference simplex. For n = k^dim they are the simplices of
   * the subdivision, which tile the cell. The domains of other rules are images
   * of the cell, scaled to the volume fraction of the point and centred at it;
   * they overlap and leave gaps.
   */
  template <int dim>
  std::vector<CornerVectors<dim>>
  material_point_domains(const unsigned int n_points);
} // namespace isochor

#endif
