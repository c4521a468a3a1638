/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/coarse_grid_watch.h>
#include <isochor/adaptation/stress_recovery.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  CoarseGridWatch<dim>::look(const StepContext<dim> &step,
                             const NodalField       &unknowns,
                             const bool              has_inertia,
                             const unsigned int      n,
                             const bool              is_last)
  {
    constexpr unsigned int each = 10;
    if (!is_last && !(has_inertia && (n <= each || n % each == 0)))
      return;
    const Squares of_step = squares(step, unknowns);
    if (has_inertia)
      {
        // a step stands for those that were left out before it
        const double weight = std::min(n - last_look, each);
        last_look           = n;
        of_run.error += weight * of_step.error;
        of_run.norm += weight * of_step.norm;
        of_run.least += weight * of_step.least;
        of_run.kinetic += weight * of_step.kinetic;
        if (is_last)
          judge(step, of_run, true);
        return;
      }
    // what is left when the load is gone says nothing
    constexpr double unloaded = 0.5;
    if (of_step.norm > unloaded * norm_square_at_start(step, unknowns))
      judge(step, of_step, false);
  }



  template <int dim>
  typename CoarseGridWatch<dim>::Squares
  CoarseGridWatch<dim>::squares(const StepContext<dim> &step,
                                const NodalField       &unknowns)
  {
    // strains as small as rounding errors of a body that is carried along
    constexpr double      no_strain = 1e-6;
    const BodyState<dim>  state     = state_of_body(step, unknowns);
    const StressError     error     = recovered_error(state);
    std::array<double, 4> sums{{0., error.norm_square, 0., 0.}};
    for (unsigned int q = 0; q < state.size(); ++q)
      {
        sums[0] += error.squares[q];
        sums[2] +=
          state.volume[q] * state.shear_modulus[q] * no_strain * no_strain;
      }
    if (!step.points.velocity.empty())
      for (unsigned int q = 0; q < state.size(); ++q)
        sums[3] +=
          step.points.mass[q] / 2 * step.points.velocity[q].norm_square();
    sum_over_ranks(sums, step.grid.communicator());
    return {sums[0], sums[1], sums[2], sums[3]};
  }



  template <int dim>
  double
  CoarseGridWatch<dim>::norm_square_at_start(const StepContext<dim> &step,
                                             const NodalField       &unknowns)
  {
    NodalField at_rest = unknowns;
    for (unsigned int i = 0; i < step.nodes.n_local() * step.n_components; ++i)
      if (i % step.n_components < dim)
        at_rest.local_element(i) = 0;
    return Utilities::MPI::sum(energy_norm_square(state_of_body(step, at_rest)),
                               step.grid.communicator());
  }



  template <int dim>
  void
  CoarseGridWatch<dim>::judge(const StepContext<dim> &step,
                              const Squares          &squares,
                              const bool              of_whole_run)
  {
    constexpr double much = 0.36;
    if (squares.norm <= squares.least)
      return;
    const double part = squares.error / std::max(squares.norm, squares.kinetic);
    const auto   percent = [](const double share) {
      const double tenths = std::round(1000 * share);
      return tenths < 1 ? "less than 0.1 %" : rounded(tenths / 10) + " %";
    };
    const std::string of_stresses =
      percent(std::sqrt(squares.error / squares.norm)) +
      " (energy norm, by recovery" + (of_whole_run ? ", mean over time" : "") +
      ")";
    if (!(part > much * much))
      {
        estimate = "Estimated error of the grid: stresses " + of_stresses +
                   ", resistance of an elastic body " + percent(part);
        return;
      }
    step.warnings.add(
      "a grid that is too coarse",
      (of_whole_run ? "Up to t = " : "At t = ") + rounded(step.time) +
        " the stresses are wrong by an estimated " + of_stresses +
        ": cells are too large for what the body "
        "does. By the square of that, some " +
        percent(part) +
        ", an elastic body resists too much: forces are too large where "
        "motions are given, displacements too small where forces are" +
        (of_whole_run ? ", vibrations too fast" : "") +
        ". Use smaller cells, <Grid/Shape functions = Q1>, or let "
        "them adapt (<Adaptive grid/Target of relative error>).");
  }



  template class CoarseGridWatch<2>;
  template class CoarseGridWatch<3>;
} // namespace isochor
