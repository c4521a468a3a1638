/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/inertia_term.h>
#include <isochor/nonlinear_solver/load_stepping.h>

namespace isochor
{
  template <int dim>
  double
  InertiaTerm<dim>::work_of_jump(const StepContext<dim>    &step,
                                 const MaterialPoints<dim> &points,
                                 const LoadStepping        &time) const
  {
    const bool is_first = time.step == 0;
    if (!is_active() || !(is_first ? starts_with_impulse : time.starts_anew))
      return 0;
    double work = 0;
    for (unsigned int k = 0; k < step.points.cell.size(); ++k)
      for (unsigned int q = step.points.cell_start[k];
           q < step.points.cell_start[k + 1];
           ++q)
        {
          const Tensor<1, dim> v =
            interpolate(step,
                        step.points.stencil(step.grid.geometry(), k, q),
                        start.velocity);
          work += step.points.mass[q] / 2 * v.norm_square();
          if (is_first)
            work -=
              step.points.mass[q] / 2 * step.points.velocity[q].norm_square();
        }
    const PointLayout &l = points.layout();
    if (!is_first)
      for (const auto &particle : points.handler())
        for (unsigned int d = 0; d < dim; ++d)
          work -= particle.get_properties()[l.mass] / 2 *
                  std::pow(particle.get_properties()[l.velocity + d], 2);
    return work;
  }



  template double
  InertiaTerm<2>::work_of_jump(const StepContext<2> &,
                               const MaterialPoints<2> &,
                               const LoadStepping &) const;
  template double
  InertiaTerm<3>::work_of_jump(const StepContext<3> &,
                               const MaterialPoints<3> &,
                               const LoadStepping &) const;
} // namespace isochor
