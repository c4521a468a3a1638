/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/dynamics/sudden_motions.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** What grows linearly with all that @p condition prescribes at @p time of
     * the step: increments, or the forces of a penalty. This rank's. */
    template <int dim>
    std::vector<double>
    prescribed_at(const StepContext<dim>       &step,
                  const BoundaryCondition<dim> &condition,
                  const bool                    by_force,
                  const double                  time)
    {
      StepContext<dim> until = step;
      until.time             = time;
      std::vector<double> values;
      if (by_force)
        {
          NodalField force, rest;
          step.nodes.initialize(force, step.n_components);
          step.nodes.initialize(rest, step.n_components);
          condition.add_boundary_force(until, rest, force);
          force.compress(VectorOperation::add);
          values.assign(force.begin(), force.end());
          return values;
        }
      NodalConstraints constraints;
      constraints.reinit(step.nodes.n_local() * step.n_components,
                         step.nodes.control_entries(step.n_components));
      condition.constrain(until, constraints);
      for (unsigned int i = 0; i < constraints.increment.size(); ++i)
        if (constraints.constrained[i] != NodalConstraints::is_free)
          values.push_back(constraints.increment[i]);
      for (const auto &equation : constraints.equations)
        values.push_back(equation.value);
      return values;
    }



    /** How the velocity of a motion changes from one part of a time to the
     * next. */
    struct Changes
    {
      double largest = 0, rounding = 0, speed = 0;
      double time = 0; ///< between the parts where the change is largest
    };

    /** Over @p n_parts of equal length, of which the first begins at @p start.
     * Collective. */
    template <int dim>
    Changes
    find_changes(const StepContext<dim>       &step,
                 const BoundaryCondition<dim> &condition,
                 const bool                    by_force,
                 const double                  start,
                 const double                  length,
                 const unsigned int            n_parts)
    {
      std::vector<std::vector<double>> values;
      for (unsigned int k = 0; k <= n_parts; ++k)
        values.push_back(
          prescribed_at(step, condition, by_force, start + k * length));
      // changes, the largest speed, the largest value
      std::vector<double> found(n_parts + 1, 0.);
      std::size_t         n_values = values[0].size();
      for (const auto &at_time : values)
        n_values = std::min(n_values, at_time.size());
      for (unsigned int i = 0; i < n_values; ++i)
        for (unsigned int k = 1; k <= n_parts; ++k)
          {
            const double speed = (values[k][i] - values[k - 1][i]) / length;
            double      &most  = found[n_parts - 1];
            most               = std::max(most, std::abs(speed));
            found[n_parts] = std::max(found[n_parts], std::abs(values[k][i]));
            if (k < n_parts)
              found[k - 1] =
                std::max(found[k - 1],
                         std::abs((values[k + 1][i] - values[k][i]) / length -
                                  speed));
          }
      Utilities::MPI::max(found, step.grid.communicator(), found);
      const auto largest =
        std::max_element(found.begin(), found.begin() + n_parts - 1);
      return {*largest,
              1e-11 * found[n_parts] / length,
              found[n_parts - 1],
              start + (largest - found.begin() + 1) * length};
    }
  } // namespace



  template <int dim>
  void
  warn_of_sudden_motion(const StepContext<dim>       &step,
                        const BoundaryCondition<dim> &condition)
  {
    const MPI_Comm comm = step.grid.communicator();
    const bool     by_force =
      Utilities::MPI::max(static_cast<int>(condition.moves_body(step)), comm) !=
      0;
    if (by_force && condition.assembles_load(step))
      return; // whose forces may bend
    constexpr unsigned int n_parts = 16, n_bisections = 8;
    const double           part = step.step_size() / n_parts;
    // what happens at the end of the step is for the next one
    const bool   has_past = step.old_time >= part;
    const double begin    = step.old_time - (has_past ? part : 0.);
    const double half     = (step.time - begin) / 2;
    if (find_changes(step, condition, by_force, begin, half, 2).speed == 0.)
      return; // nothing moves
    const Changes first =
      find_changes(step, condition, by_force, begin, part, n_parts + has_past);
    constexpr double small = 1e-3;
    if (first.largest <= std::max(small * first.speed, first.rounding))
      return;
    // that of a smooth motion halves with the parts
    Changes changes = first;
    double  length  = part;
    for (unsigned int b = 0; b < n_bisections; ++b)
      {
        length /= 2;
        changes = find_changes(
          step, condition, by_force, changes.time - 2 * length, length, 4);
      }
    if (changes.largest < 0.5 * first.largest ||
        changes.largest <= changes.rounding)
      return;
    step.warnings.add(
      "a motion that jumps",
      "The velocity that <Boundary conditions/" +
        (by_force ? "Displacement of body" : condition.name) +
        "> prescribes jumps at t = " + rounded(changes.time) +
        ". A body follows at once at t = 0 only: later what the steps don't "
        "resolve goes on with its old velocity, and forces ring, with another "
        "sign in each step. Let the motion begin and end smoothly, over some "
        "steps.");
  }



  template void
  warn_of_sudden_motion(const StepContext<2> &, const BoundaryCondition<2> &);
  template void
  warn_of_sudden_motion(const StepContext<3> &, const BoundaryCondition<3> &);
} // namespace isochor
