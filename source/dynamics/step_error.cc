/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/dynamics/inertia_term.h>

#include <cmath>

namespace isochor
{
  template <int dim>
  double
  InertiaTerm<dim>::error_of_step(const StepContext<dim> &step,
                                  const NodalField       &unknowns) const
  {
    if (!is_active())
      return 0;
    const double dt     = step.step_size();
    const double factor = integrator->smooth_start(dt).velocity_per_jerk;
    // all schemes that are stable at any size of step have at least 1/12
    AssertThrow(std::abs(factor) > 1e-3 * dt * dt,
                ExcMessage("<Dynamics/Newmark beta> and <Newmark gamma> are "
                           "such that <Time/Tolerated error> has no measure of "
                           "the error: 1/6 - beta - (1/2 - gamma)/2 is zero. "
                           "Choose <Dynamics/Scheme = Bossak>, or set "
                           "<Tolerated error> to 0."));
    double sum = 0, mass_sum = 0;
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      {
        const double m = std::max(start.mass.lumped.local_element(node), 0.);
        mass_sum += m;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i   = node * dim + d;
            const double       a_n = start.acceleration.local_element(i);
            const double       a =
              integrator->acceleration(unknowns.local_element(
                                         node * step.n_components + d),
                                       start.velocity.local_element(i),
                                       a_n,
                                       dt);
            // what is held is where it shall be
            const double error = start.held[i] ? 0. : factor * (a - a_n);
            sum += m * error * error;
          }
      }
    sum      = Utilities::MPI::sum(sum, step.grid.communicator());
    mass_sum = Utilities::MPI::sum(mass_sum, step.grid.communicator());
    return mass_sum > 0 ? std::sqrt(sum / mass_sum) : 0.;
  }



  template double
  InertiaTerm<2>::error_of_step(const StepContext<2> &,
                                const NodalField &) const;
  template double
  InertiaTerm<3>::error_of_step(const StepContext<3> &,
                                const NodalField &) const;
} // namespace isochor
