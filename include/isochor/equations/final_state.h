/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_final_state_h
#define isochor_final_state_h

#include <isochor/equations/equation_term.h>
#include <isochor/equations/nodal_unknowns.h>

namespace isochor
{
  /** MixedKernel::final_state() of point @p q of @p points, which is in cell
   * @p k of their list, with the unknowns of the nodes around it. @p history
   * gets the new history. */
  template <int dim>
  typename MixedKernel<dim>::PointState
  final_state(const StepContext<dim>   &step,
              const NodalUnknowns<dim> &nodal,
              const PointArrays<dim>   &points,
              const unsigned int        k,
              const unsigned int        q,
              double                   *history)
  {
    const auto stencil = points.stencil(step.grid.geometry(), k, q);
    return step.kernel.final_state(points,
                                   q,
                                   nodal.deformation_at(stencil),
                                   nodal.hoop_at(stencil, points, q),
                                   step.mixed(),
                                   nodal.pressure_at(stencil),
                                   history);
  }
} // namespace isochor

#endif
