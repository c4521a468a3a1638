/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/equations/final_state.h>
#include <isochor/transfer/stress_integral.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    constexpr double tolerated = 0.01;
    /** Mean stresses below this part of the shear modulus are rounding errors
     * of a body without load. */
    constexpr double no_stress = 1e-8;
    /** Of the mean of |σ|, the mean stress where it has one direction. */
    constexpr double one_direction = 0.5;
  } // namespace



  template <int dim>
  void
  StressIntegral<dim>::add(const SymmetricTensor<2, 3> &stress,
                           const double                 J,
                           const double                 point_volume,
                           const double                 weight)
  {
    difference += (weight - point_volume) * J * stress;
    integral += point_volume * J * stress;
    norm += point_volume * J * stress.norm();
    volume += point_volume * J;
  }



  template <int dim>
  void
  StressIntegral<dim>::add_massless_points(const StepContext<dim>   &step,
                                           const NodalUnknowns<dim> &nodal)
  {
    const PointArrays<dim>         &points = step.points;
    std::array<double, max_history> history;
    for (unsigned int k = points.n_occupied_cells; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto state =
            final_state<dim>(step, nodal, points, k, q, history.data());
          add(state.cauchy_stress, state.J, 0., points.measure(q));
        }
  }



  template <int dim>
  void
  StressIntegral<dim>::check(const StepContext<dim> &step) const
  {
    // domains that act at their corners stand for what of them is in the grid
    if (Utilities::MPI::max(step.points.domain_corners.cells.size(),
                            step.grid.communicator()) > 0)
      return;
    constexpr unsigned int n = SymmetricTensor<2, 3>::n_independent_components;
    std::array<double, 2 * n + 2> sums;
    for (unsigned int i = 0; i < n; ++i)
      {
        sums[i]         = difference.access_raw_entry(i);
        sums[n + 2 + i] = integral.access_raw_entry(i);
      }
    sums[n]     = norm;
    sums[n + 1] = volume;
    sum_over_ranks(sums, step.grid.communicator());
    double G = 0;
    for (const auto &material : step.kernel.materials)
      G = std::max(G, material->shear_modulus());
    if (!(sums[n] > no_stress * G * sums[n + 1]))
      return;
    SymmetricTensor<2, 3> total, mean;
    for (unsigned int i = 0; i < n; ++i)
      {
        total.access_raw_entry(i) = sums[i];
        mean.access_raw_entry(i)  = sums[n + 2 + i];
      }
    const double error = total.norm() / sums[n];
    if (!(error > tolerated) || !(mean.norm() > one_direction * sums[n]))
      return;
    step.warnings.add(
      "stress at the body's surface",
      "At t = " + rounded(step.time) +
        " the integral of the stress over the "
        "body is off by " +
        rounded(100 * error) +
        " % of the mean stress: where the surface of the body passes through "
        "cells, their points integrate another volume than the body fills, and "
        "stresses along the surface are not in balance there. The force "
        "between plates that press the body is wrong by about as much or "
        "more. Use "
        "<Quadrature/Type = CPDI>, or 'cell-filled + boundary' if it is not "
        "set, smaller cells at the surface (<Adaptive grid/Cell size at "
        "surface of body>), more <Material points/Points per cell>, or a grid "
        "that is kept (<Grid reset/Steps between resets>).");
  }



  template class StressIntegral<2>;
  template class StressIntegral<3>;
} // namespace isochor
