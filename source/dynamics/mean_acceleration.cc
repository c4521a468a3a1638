/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of InertiaTerm that average over the mass.
#include <isochor/base/mpi_sums.h>
#include <isochor/dynamics/inertia_term.h>

namespace isochor
{
  template <int dim>
  template <typename Acceleration>
  Tensor<1, dim>
  InertiaTerm<dim>::mean_over_mass(const StepContext<dim> &step,
                                   const Acceleration     &of_entry) const
  {
    std::array<double, dim + 1> sums{};
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      {
        const double m = mass.lumped.local_element(node);
        for (unsigned int d = 0; d < dim; ++d)
          sums[d] += m * of_entry(node, d);
        sums[dim] += m;
      }
    sum_over_ranks(sums, step.grid.communicator());
    Tensor<1, dim> mean;
    if (sums[dim] > 0)
      for (unsigned int d = 0; d < dim; ++d)
        mean[d] = sums[d] / sums[dim];
    return mean;
  }



  template <int dim>
  Tensor<1, dim>
  InertiaTerm<dim>::mean_acceleration(const StepContext<dim> &step) const
  {
    if (!is_active())
      return {};
    Tensor<1, dim> mean =
      mean_over_mass(step, [&](const unsigned int node, const unsigned int d) {
        return acceleration.local_element(node * dim + d);
      });
    if (!by_stresses)
      return mean;
    // the points have what a_n differs by from the acceleration of the forces
    std::array<double, dim + 1> sums{};
    const PointArrays<dim>     &points = step.points;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          for (unsigned int d = 0; d < dim; ++d)
            sums[d] += points.mass[q] * points.acceleration[q][d];
          sums[dim] += points.mass[q];
        }
    sum_over_ranks(sums, step.grid.communicator());
    for (unsigned int d = 0; d < dim; ++d)
      mean[d] -= sums[d] / sums[dim];
    return mean;
  }



  template <int dim>
  Tensor<1, dim>
  InertiaTerm<dim>::mean_trial_acceleration(const StepContext<dim> &step,
                                            const NodalField &unknowns) const
  {
    return mean_over_mass(
      step, [&](const unsigned int node, const unsigned int d) {
        return scheme().acceleration(unknowns.local_element(
                                       node * step.n_components + d),
                                     velocity.local_element(node * dim + d),
                                     acceleration.local_element(node * dim + d),
                                     step_size(step));
      });
  }



  template Tensor<1, 2>
  InertiaTerm<2>::mean_acceleration(const StepContext<2> &) const;
  template Tensor<1, 2>
  InertiaTerm<2>::mean_trial_acceleration(const StepContext<2> &,
                                          const NodalField &) const;
  template Tensor<1, 3>
  InertiaTerm<3>::mean_acceleration(const StepContext<3> &) const;
  template Tensor<1, 3>
  InertiaTerm<3>::mean_trial_acceleration(const StepContext<3> &,
                                          const NodalField &) const;
} // namespace isochor
