/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/nodal_end.h>
#include <isochor/equations/invariants.h>

namespace isochor
{
  template <int dim>
  void
  NodalEnd<dim>::find(const StepContext<dim> &step,
                      const NodalStart<dim>  &start,
                      const TimeIntegrator   &scheme,
                      const double            dt,
                      const NodalField       &unknowns,
                      const NodalField       &excess_of_mean)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    for (NodalField *const field : {&velocity, &acceleration, &excess})
      {
        step.nodes.initialize(*field, dim);
        // ranks write all that they hold themselves
        field->set_ghost_state(true);
      }
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i   = node * dim + d;
          const double       v_n = start.velocity.local_element(i);
          const double       a_n = start.acceleration.local_element(i);
          const double       a   = scheme.acceleration(
            unknowns.local_element(node * step.n_components + d), v_n, a_n, dt);
          velocity.local_element(i) = scheme.velocity(v_n, a_n, a, dt);
          if (kept_part > 0)
            velocity.local_element(i) -=
              kept_part * start.projected.local_element(i);
          // M (1 - α) a_{n+1} is what differs
          const double a_end = a - excess_of_mean.local_element(i) /
                                     scheme.inertial_acceleration(0, 1);
          acceleration.local_element(i) = a_end;
          excess.local_element(i) =
            a_end - scheme.inertial_acceleration(a_n, a_end);
        }
  }



  template <int dim>
  double
  NodalEnd<dim>::move_point(const StepContext<dim>  &step,
                            const Stencil           &stencil,
                            const unsigned int       q,
                            const PointLayout       &layout,
                            const ArrayView<double> &properties) const
  {
    const Tensor<1, dim> v = kept_part * step.points.velocity[q] +
                             interpolate(step, stencil, velocity);
    const auto write = [&](const unsigned int first, const auto &vector) {
      for (unsigned int d = 0; d < dim; ++d)
        properties[first + d] = vector[d];
    };
    write(layout.velocity, v);
    write(layout.acceleration, acceleration_at(step, stencil));
    if (layout.with_excess)
      write(layout.excess, interpolate(step, stencil, excess));
    return properties[layout.mass] / 2 * v.norm_square();
  }



  template class NodalEnd<2>;
  template class NodalEnd<3>;
} // namespace isochor
