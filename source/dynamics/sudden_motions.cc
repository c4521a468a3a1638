/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/dynamics/sudden_motions.h>
#include <isochor/equations/smallest_cell.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** What a condition prescribes at times of equal distance, this rank's:
     * values[k][i] of unknown i. */
    struct Samples
    {
      double                           start, length;
      std::vector<std::vector<double>> values;

      unsigned int
      n_parts() const
      {
        return values.size() - 1;
      }
    };



    /** Looks for jumps of the derivative of one order, 1 or 2, in samples of a
     * step and, where there may be one, in ever shorter times. */
    template <int dim>
    class JumpSearch
    {
    public:
      JumpSearch(const StepContext<dim>       &step,
                 const BoundaryCondition<dim> &condition);

      /** Samples of @p n_parts of equal @p length, of which the first begins at
       * @p start. */
      Samples
      sample(const double       start,
             const double       length,
             const unsigned int n_parts) const;

      /** Whether anything moves. Collective. */
      bool
      moves(const Samples &samples) const;

      /** Where the derivative of @p order may jump: times in the middle of
       * changes that stand out from those around. Collective. */
      std::vector<double>
      candidates(const Samples &samples, const unsigned int order);

      struct Jump
      {
        bool   is_there = false, is_of_place = false;
        double time = 0;
      };
      /** Magnify what is around @p time, from parts of @p length on.
       * Collective. */
      Jump
      magnify(double time, double length, const unsigned int order) const;

    private:
      /** The derivative of @p order of unknown @p i, times the power of the
       * length: from place @p k on. */
      static double
      difference(const Samples     &samples,
                 const unsigned int order,
                 const unsigned int k,
                 const unsigned int i);
      /** Of the change between the derivatives from place @p k and the next one
       * on: its part of the largest one of the same unknown. 0 if that may be
       * rounding or moves nothing. */
      double
      strength(const Samples     &samples,
               const unsigned int order,
               const unsigned int k,
               const unsigned int i) const;
      /** A time at which a change from place @p k on is. */
      static double
      time_of(const Samples     &samples,
              const unsigned int order,
              const unsigned int k)
      {
        return samples.start + (k + (order + 1) / 2.) * samples.length;
      }

      const StepContext<dim>       &step;
      const BoundaryCondition<dim> &condition;
      const MPI_Comm                comm;
      /** What is too small a way in a step to matter (m). */
      double negligible = 0;
      /** Of each unknown: the size of its values, and the largest derivative of
       * the order that is looked at. */
      std::vector<double> size, most;
    };



    template <int dim>
    JumpSearch<dim>::JumpSearch(const StepContext<dim>       &step,
                                const BoundaryCondition<dim> &condition)
      : step(step)
      , condition(condition)
      , comm(step.grid.communicator())
    {}



    /** What @p condition prescribes at the end of @p step. */
    template <int dim>
    void
    append_motion(const BoundaryCondition<dim> &condition,
                  const StepContext<dim>       &step,
                  std::vector<double>          &values)
    {
      if (const auto *const nodes =
            dynamic_cast<const ConstrainsNodes<dim> *>(&condition))
        nodes->append_motion(step, values);
      else if (const auto *const surface =
                 dynamic_cast<const ActsByAssembly<dim> *>(&condition))
        surface->append_motion(step, values);
    }



    template <int dim>
    Samples
    JumpSearch<dim>::sample(const double       start,
                            const double       length,
                            const unsigned int n_parts) const
    {
      Samples          samples{start, length, {}};
      StepContext<dim> until = step;
      for (unsigned int k = 0; k <= n_parts; ++k)
        {
          until.time = std::max(0., start + k * length);
          samples.values.emplace_back();
          append_motion(condition, until, samples.values.back());
        }
      return samples;
    }



    template <int dim>
    bool
    JumpSearch<dim>::moves(const Samples &samples) const
    {
      const auto &first = samples.values.front();
      const bool  any   = std::any_of(samples.values.begin(),
                                   samples.values.end(),
                                   [&first](const std::vector<double> &values) {
                                     return values != first;
                                   });
      return Utilities::MPI::max(any ? 1 : 0, comm) == 1;
    }



    template <int dim>
    double
    JumpSearch<dim>::difference(const Samples     &samples,
                                const unsigned int order,
                                const unsigned int k,
                                const unsigned int i)
    {
      const auto &u = samples.values;
      return order == 1 ? u[k + 1][i] - u[k][i] :
                          u[k + 2][i] - 2 * u[k + 1][i] + u[k][i];
    }



    template <int dim>
    double
    JumpSearch<dim>::strength(const Samples     &samples,
                              const unsigned int order,
                              const unsigned int k,
                              const unsigned int i) const
    {
      // formulas err by some units of the last digit of their values
      constexpr double rounding = 1e-13;
      const double     change = std::abs(difference(samples, order, k + 1, i) -
                                     difference(samples, order, k, i));
      const double     scale  = std::pow(samples.length, order);
      if (!(change > rounding * size[i]) ||
          !(change / scale * std::pow(step.step_size(), order) > negligible))
        return 0;
      return change / scale / most[i];
    }



    template <int dim>
    std::vector<double>
    JumpSearch<dim>::candidates(const Samples     &samples,
                                const unsigned int order)
    {
      constexpr double   stands_out     = 0.3;
      const double       smallest_share = (order == 1 ? 1e-3 : 0.1);
      const unsigned int n_changes      = samples.n_parts() - order,
                         around = order + 1, n = samples.values[0].size();
      const double scale   = std::pow(samples.length, order);
      const auto   at_rest = sample(0., 0., 0);
      negligible           = 1e-12 * smallest_cell(step);
      size.assign(n, 0.);
      most.assign(n, 0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          size[i] = std::abs(at_rest.values[0][i]);
          for (const auto &values : samples.values)
            size[i] = std::max(size[i], std::abs(values[i]));
          for (unsigned int k = 0; k <= n_changes; ++k)
            most[i] =
              std::max(most[i],
                       std::abs(difference(samples, order, k, i)) / scale);
        }
      std::vector<double> strengths(n_changes, 0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          const auto change = [&](const unsigned int k) {
            return difference(samples, order, k + 1, i) -
                   difference(samples, order, k, i);
          };
          for (unsigned int k = 0; k < n_changes; ++k)
            {
              const double share = strength(samples, order, k, i);
              if (share <= smallest_share)
                continue;
              const double before =
                             change(k >= around ? k - around : k + around),
                           after = change(k + around < n_changes ? k + around :
                                                                   k - around);
              if (std::abs(change(k) - (before + after) / 2) >
                  stands_out * std::abs(change(k)))
                strengths[k] = std::max(strengths[k], share);
            }
        }
      Utilities::MPI::max(strengths, comm, strengths);
      std::vector<double> times;
      for (unsigned int k = 0; k < n_changes; ++k)
        if (strengths[k] > 0 && (k == 0 || strengths[k] > strengths[k - 1]) &&
            (k + 1 == n_changes || strengths[k] >= strengths[k + 1]))
          times.push_back(time_of(samples, order, k));
      return times;
    }



    template <int dim>
    typename JumpSearch<dim>::Jump
    JumpSearch<dim>::magnify(double             time,
                             double             length,
                             const unsigned int order) const
    {
      // Four times, or three, the changes of what is smooth halve, those of a
      // jump are half of it to all of it; where a derivative of lower order
      // jumps, they double (of t^a with a < 1 they grow by 2^(1 - a)).
      const unsigned int n_halvings = (order == 1 ? 8 : 4),
                         n_first = (order == 1 ? 4 : 1), n_more = 8;
      constexpr double   least     = 0.45;
      const double       largest   = (order == 1 ? 2.5 : 4);
      const unsigned int n_changes = order + 2;
      double             first = 0, last = 0;
      for (unsigned int b = 1; b <= n_halvings + (order == 1 ? n_more : 0); ++b)
        {
          length /= 2;
          const Samples samples =
            sample(time - (order + 1) * length, length, 2 * (order + 1));
          std::vector<double> strengths(n_changes, 0.);
          for (unsigned int k = 0; k < n_changes; ++k)
            for (unsigned int i = 0; i < size.size(); ++i)
              strengths[k] =
                std::max(strengths[k], strength(samples, order, k, i));
          Utilities::MPI::max(strengths, comm, strengths);
          const auto strongest =
            std::max_element(strengths.begin(), strengths.end());
          if (*strongest == 0. && b > n_halvings)
            break; // as near as can be seen
          if (*strongest == 0.)
            return {};
          time = time_of(samples, order, strongest - strengths.begin());
          if (b <= n_halvings)
            last = *strongest;
          if (b == n_first)
            first = last;
        }
      const double ratio = last / first;
      if (ratio < least || (order == 2 && ratio > largest))
        return {};
      return {true, ratio > largest, time};
    }



    /** Whether @p condition prescribes at t = 0 that the body is elsewhere than
     * it is. Collective. */
    template <int dim>
    bool
    starts_elsewhere(const StepContext<dim>       &step,
                     const BoundaryCondition<dim> &condition)
    {
      // of a cell; nodes of curved walls aren't quite on them
      constexpr double little = 1e-6, little_of_equations = 1e-3;
      StepContext<dim> start = step;
      start.time             = 0;
      double           most  = 0;
      NodalConstraints constraints;
      constraints.reinit(step.nodes.n_local() * step.n_components,
                         step.nodes.control_entries(step.n_components));
      if (const auto *const role =
            dynamic_cast<const ConstrainsNodes<dim> *>(&condition))
        role->constrain(start, constraints);
      for (unsigned int i = 0; i < constraints.increment.size(); ++i)
        if (constraints.constrained[i] != NodalConstraints::is_free &&
            i % step.n_components < dim)
          most = std::max(most, std::abs(constraints.increment[i]));
      for (const auto &equation : constraints.equations)
        most =
          std::max(most,
                   std::abs(equation.value) * little / little_of_equations);
      if (const auto *const role =
            dynamic_cast<const ActsByAssembly<dim> *>(&condition);
          role != nullptr && role->moves_body(start))
        {
          std::vector<double> displacements;
          role->append_motion(start, displacements);
          for (const double displacement : displacements)
            most = std::max(most, std::abs(displacement));
        }
      return Utilities::MPI::max(most, step.grid.communicator()) >
             little * smallest_cell(step);
    }
  } // namespace



  template <int dim>
  Jumps
  find_jumps(const StepContext<dim>       &step,
             const BoundaryCondition<dim> &condition,
             const double                  end,
             const double                  start_precision)
  {
    constexpr unsigned int n_parts = 16; // of a step
    const double           h = step.step_size(), part = h / n_parts;
    const unsigned int     n_past = step.old_time > 0 ? 2 : 0;
    const unsigned int     n_after =
      std::min(2. * n_parts, std::round((end - step.old_time) / part));
    constexpr unsigned int fewest = 8; // to compare changes of both orders
    JumpSearch<dim>        search(step, condition);
    Jumps                  jumps;
    jumps.precision = 1e-3 * h;
    if (step.old_time == 0 && starts_elsewhere(step, condition))
      jumps.of_place = 0;
    if (n_past + n_after < fewest ||
        !search.moves(search.sample(step.old_time - n_past * part,
                                    (n_past + n_after) * part / 3,
                                    3)))
      return jumps;
    const Samples samples =
      search.sample(step.old_time - n_past * part, part, n_past + n_after);
    for (const unsigned int order : {1, 2})
      for (const double time : search.candidates(samples, order))
        {
          const auto jump = search.magnify(time, part, order);
          // a jump of an acceleration is found to 1/256 of a step
          const double precision = (order == 1 ? 1e-5 : 0.02) * h;
          const double behind =
            jump.time - step.old_time - // of the start
            (order == 1 ? std::max(start_precision, jumps.precision) :
                          precision);
          if (!jump.is_there)
            continue;
          if (jump.is_of_place)
            jumps.of_place =
              std::min(jumps.of_place,
                       std::abs(jump.time - step.old_time) <= precision ?
                         step.old_time :
                         jump.time);
          else if (jump.time >= step.old_time - precision && behind <= 0)
            jumps.at_start = true;
          else if (std::abs(jump.time - step.time) <= precision)
            jumps.next = std::min(jumps.next, step.time);
          else if (jump.time > step.old_time)
            jumps.next = std::min(jumps.next, jump.time);
        }
    return jumps;
  }



  template Jumps
  find_jumps(const StepContext<2> &,
             const BoundaryCondition<2> &,
             const double,
             const double);
  template Jumps
  find_jumps(const StepContext<3> &,
             const BoundaryCondition<3> &,
             const double,
             const double);
} // namespace isochor
