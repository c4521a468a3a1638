/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_seeding_h
#define isochor_seeding_h

#include <deal.II/base/quadrature.h>

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
} // namespace isochor

#endif
