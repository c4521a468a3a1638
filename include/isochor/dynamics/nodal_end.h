/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nodal_end_h
#define isochor_nodal_end_h

#include <isochor/dynamics/nodal_start.h>

namespace isochor
{
  /** What the nodes end a step with, and what the points take of it, see
   * InertiaTerm. */
  template <int dim>
  class NodalEnd
  {
  public:
    using Stencil = typename PointArrays<dim>::Stencil;

    /** η: the part of their own velocity that points keep. */
    double kept_part = 0;

    /** Of a step of size @p dt (s) with the nodal @p unknowns. @p
     * excess_of_mean, with dim components per node: what the acceleration of
     * the @p scheme exceeds that of the forces at the end by (m/s²). */
    void
    find(const StepContext<dim> &step,
         const NodalStart<dim>  &start,
         const TimeIntegrator   &scheme,
         const double            dt,
         const NodalField       &unknowns,
         const NodalField       &excess_of_mean);

    /** Of a point. */
    Tensor<1, dim>
    acceleration_at(const StepContext<dim> &step, const Stencil &stencil) const
    {
      return interpolate(step, stencil, acceleration);
    }

    /** Write velocity and acceleration into the @p properties of point @p q.
     * Returns its kinetic energy (J). */
    double
    move_point(const StepContext<dim>  &step,
               const Stencil           &stencil,
               const unsigned int       q,
               const PointLayout       &layout,
               const ArrayView<double> &properties) const;

  private:
    /** With dim components per node: the velocity less η times the projection
     * of those of the points, a_{n+1}, and its excess over what the equation of
     * motion has. */
    NodalField velocity, acceleration, excess;
  };
} // namespace isochor

#endif
