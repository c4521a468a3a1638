/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

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



    /** What is prescribed at times of equal distance. */
    struct Samples
    {
      double start, length; ///< of the first part of the time, of each
      std::vector<std::vector<double>> values; ///< at their ends
    };



    template <int dim>
    Samples
    sample(const StepContext<dim>       &step,
           const BoundaryCondition<dim> &condition,
           const bool                    by_force,
           const double                  start,
           const double                  length,
           const unsigned int            n_parts)
    {
      Samples samples{start, length, {}};
      for (unsigned int k = 0; k <= n_parts; ++k)
        samples.values.push_back(
          prescribed_at(step, condition, by_force, start + k * length));
      std::size_t n_values = samples.values[0].size();
      for (const auto &values : samples.values)
        n_values = std::min(n_values, values.size());
      for (auto &values : samples.values)
        values.resize(n_values);
      return samples;
    }



    /** How a derivative with respect to the time changes from one part to the
     * next. */
    struct Changes
    {
      double largest = 0, rounding = 0;
      double most = 0; ///< the largest derivative
      double time = 0; ///< where the change is largest

      bool
      are_clear() const
      {
        return largest > 10 * rounding;
      }
    };

    /** Of the derivative of @p order 1 or 2. Collective. */
    Changes
    find_changes(const Samples     &samples,
                 const unsigned int order,
                 const MPI_Comm     comm)
    {
      const std::size_t n_values = samples.values[0].size();
      auto              rates    = samples.values;
      for (unsigned int o = 0; o < order; ++o, rates.pop_back())
        for (unsigned int k = 0; k + 1 < rates.size(); ++k)
          for (std::size_t i = 0; i < n_values; ++i)
            rates[k][i] = (rates[k + 1][i] - rates[k][i]) / samples.length;
      // changes, the largest derivative, the largest value
      const unsigned int  n_changes = rates.size() - 1;
      std::vector<double> found(n_changes + 2, 0.);
      const auto          look = [](double &most, const double value) {
        most = std::max(most, std::abs(value));
      };
      for (unsigned int k = 0; k < rates.size(); ++k)
        for (std::size_t i = 0; i < n_values; ++i)
          {
            look(found[n_changes], rates[k][i]);
            look(found[n_changes + 1], samples.values[k][i]);
            if (k < n_changes)
              look(found[k], rates[k + 1][i] - rates[k][i]);
          }
      Utilities::MPI::max(found, comm, found);
      const auto largest =
        std::max_element(found.begin(), found.begin() + n_changes);
      return {*largest,
              1e-11 * found[n_changes + 1] / std::pow(samples.length, order),
              found[n_changes],
              samples.start +
                (largest - found.begin() + (order + 1) / 2.) * samples.length};
    }



    /** Looks closer and closer at the time of the largest change. */
    template <int dim>
    class Magnifier
    {
    public:
      Magnifier(const StepContext<dim>       &step,
                const BoundaryCondition<dim> &condition,
                const bool                    by_force)
        : step(step)
        , condition(condition)
        , by_force(by_force)
        , comm(step.grid.communicator())
      {}

      /** Look at @p n_parts of equal @p length, of which the first begins at
       * @p start. */
      void
      look_at(const double       start,
              const double       length,
              const unsigned int n_parts)
      {
        samples = sample(step, condition, by_force, start, length, n_parts);
      }

      Changes
      changes(const unsigned int order) const
      {
        return find_changes(samples, order, comm);
      }

      /** Halve the parts around @p time. Returns false before t = 0. */
      bool
      halve(const double time, const unsigned int order)
      {
        const double length = samples.length / 2;
        const double start  = time - (order + 1) * length;
        if (start < 0)
          return false;
        look_at(start, length, 2 * (order + 1));
        return true;
      }

    private:
      const StepContext<dim>       &step;
      const BoundaryCondition<dim> &condition;
      const bool                    by_force;
      const MPI_Comm                comm;
      Samples                       samples;
    };



    /** Of the derivative of @p order. Where it doesn't jump, its changes halve
     * with the parts; where the one below it does, they double. */
    template <int dim>
    Jump
    find_jump_of(Magnifier<dim>     magnifier,
                 const unsigned int order,
                 const double       smallest_share,
                 const unsigned int n_halvings)
    {
      const Changes first   = magnifier.changes(order);
      Changes       changes = first;
      if (!(first.largest > smallest_share * first.most) || !first.are_clear())
        return {};
      for (unsigned int b = 0; b < n_halvings; ++b)
        {
          if (!magnifier.halve(changes.time, order))
            return {};
          changes = magnifier.changes(order);
          if (!changes.are_clear())
            return {};
        }
      // a jump is seen as half of it at least, since parts have it in common
      constexpr double least = 0.45, most = 4;
      const double     ratio = changes.largest / first.largest;
      if (ratio < least || (order == 2 && ratio > most))
        return {};
      // nearer, as long as it can be seen
      for (unsigned int b = 0; order == 1 && b < n_halvings; ++b)
        {
          if (!magnifier.halve(changes.time, order))
            break;
          const Changes nearer = magnifier.changes(order);
          if (!nearer.are_clear())
            break;
          changes = nearer;
        }
      return {changes.time, 0, ratio > most, ""};
    }
  } // namespace



  template <int dim>
  Jump
  find_jump(const StepContext<dim>       &step,
            const BoundaryCondition<dim> &condition)
  {
    // what happens at the end of the step is for the next one
    constexpr unsigned int n_parts  = 16;
    constexpr double       at_end   = 1e-4; // of a step
    const double           part     = (1 - at_end) * step.step_size() / n_parts;
    const bool             has_past = step.old_time >= part;
    const double           begin    = step.old_time - (has_past ? part : 0.);
    StepContext<dim>       with_past = step;
    with_past.old_time               = begin;
    const bool by_force =
      Utilities::MPI::max(static_cast<int>(condition.moves_body(with_past)),
                          step.grid.communicator()) != 0;
    if (by_force && condition.assembles_load(step))
      return {}; // whose forces may bend
    Magnifier<dim> magnifier(step, condition, by_force);
    magnifier.look_at(begin, (n_parts + has_past) * part / 2, 2);
    if (magnifier.changes(1).most == 0.)
      return {}; // nothing moves
    magnifier.look_at(begin, part, n_parts + has_past);
    Jump jump      = find_jump_of(magnifier, 1, 1e-3, 8);
    jump.precision = at_end * step.step_size();
    if (jump.time == Jump::never)
      {
        jump           = find_jump_of(magnifier, 2, 0.1, 4);
        jump.precision = 0.01 * step.step_size(); // 1/256 at best
      }
    jump.parameter = by_force ? "Displacement of body" : condition.name;
    return jump;
  }



  template Jump
  find_jump(const StepContext<2> &, const BoundaryCondition<2> &);
  template Jump
  find_jump(const StepContext<3> &, const BoundaryCondition<3> &);
} // namespace isochor
