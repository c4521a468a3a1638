/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_distance_to_body_h
#define isochor_distance_to_body_h

#include <isochor/equations/equation_term.h>

#include <functional>
#include <vector>

namespace isochor
{
  /**
   * How far (m) the body is from each of @p vertices, all vertices of a wall,
   * along the unit vectors @p inwards, at the start of a step with a reset of
   * the grid: where the line through the vertex enters the first domain of a
   * point that acts on the vertex. Where it meets none of these, the least
   * height of their corners: the body ends beside the vertex. Where a corner of
   * the body is nearer to the wall than this function, linear on the wall's
   * faces, says, vertices of the face that are further away come as much nearer
   * as it takes; at a smooth surface that is of second order in the size of
   * cells. Negative where the body has gone beyond the vertex; infinity where
   * no point acts on the vertex. Empty if points have no domains that say on
   * which nodes they act (BodyQuadrature::makes_stencils()): what is between
   * them and the wall is not known then. Collective.
   */
  template <int dim>
  std::vector<double>
  distance_to_body(const StepContext<dim>            &step,
                   const std::vector<unsigned int>   &vertices,
                   const std::vector<Tensor<1, dim>> &inwards);

  /**
   * The same from a wall that has been displaced along @p inwards by
   * @p displacement (m, of the number of a vertex) since its vertices were at
   * the places @p reference, by vertex of the grid: negative where it has to
   * push the body. Zero where no point acts on a vertex, and if the body
   * touches the wall but for rounding. Collective.
   */
  template <int dim>
  std::vector<double>
  gaps_of_body(const StepContext<dim>                          &step,
               const std::vector<Point<dim>>                   &reference,
               const std::vector<unsigned int>                 &vertices,
               const std::vector<Tensor<1, dim>>               &inwards,
               const std::function<double(const unsigned int)> &displacement);
} // namespace isochor

#endif
