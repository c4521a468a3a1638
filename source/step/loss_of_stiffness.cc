/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// How much the body has lost of its stiffness, by the steps that converge.
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/base/rounding.h>
#include <isochor/equations/invariants.h>
#include <isochor/equations/smallest_cell.h>
#include <isochor/step/failure_report.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Directions in which loads change are the same up to this cosine (25
     * degrees). */
    constexpr double alike = 0.9;


    /** The largest displacement of the step (m) on this rank. */
    template <int dim>
    double
    largest_displacement(const StepContext<dim> &step,
                         const NodalField       &unknowns)
    {
      Assert(invariants::fits(unknowns, step.nodes, step.n_components),
             ExcOtherNodes());
      double largest = 0;
      for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
        {
          double square = 0;
          for (unsigned int a = 0; a < dim; ++a)
            square +=
              std::pow(unknowns.local_element(node * step.n_components + a), 2);
          // also of what is no number
          if (!(square <= largest))
            largest = square;
        }
      return std::sqrt(largest);
    }
  } // namespace



  template <int dim>
  double
  FailureReport<dim>::Softness::growth(const Softness &stiffest) const
  {
    if (!(per_time > 0) || !(stiffest.per_time > 0))
      return -1;
    const double by_time = per_time / stiffest.per_time;
    return per_load > 0 && stiffest.per_load > 0 ?
             std::min(by_time, per_load / stiffest.per_load) :
             by_time;
  }



  template <int dim>
  std::string
  FailureReport<dim>::Softness::measure(const Softness &stiffest) const
  {
    return per_load > 0 && stiffest.per_load > 0 ? "load" : "time";
  }



  template <int dim>
  void
  FailureReport<dim>::Softness::take_smaller(const Softness &other)
  {
    const auto take = [](double &mine, const double theirs) {
      if (theirs > 0)
        mine = mine > 0 ? std::min(mine, theirs) : theirs;
    };
    take(per_time, other.per_time);
    take(per_load, other.per_load);
  }



  template <int dim>
  bool
  FailureReport<dim>::Softness::is_of_other_loading() const
  {
    return loads.size > 0 && loads.likeness < alike;
  }



  template <int dim>
  double
  FailureReport<dim>::largest_prescribed(const StepContext<dim> &step,
                                         const Drive            &drive)
  {
    double largest = 0;
    for (const double increment : drive.constraints.increment)
      largest = std::max(largest, std::abs(increment));
    for (const double value : drive.constraints.followers.value)
      largest = std::max(largest, std::abs(value));
    return Utilities::MPI::max(largest, step.grid.communicator());
  }



  template <int dim>
  bool
  FailureReport<dim>::is_dragged(const StepContext<dim> &step,
                                 const Drive            &drive)
  {
    return Utilities::MPI::max(drive.dragged ? 1 : 0,
                               step.grid.communicator()) == 1;
  }



  template <int dim>
  typename FailureReport<dim>::Softness
  FailureReport<dim>::softness(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const Drive            &drive) const
  {
    const double u = Utilities::MPI::max(largest_displacement(step, unknowns),
                                         step.grid.communicator());
    const double h = smallest_cell(step);
    // what holds a node in place may be rounding, and a body at rest moves by
    // what Newton's method leaves
    constexpr double negligible = 0.01;
    Softness         result;
    const double     told    = largest_prescribed(step, drive);
    const bool       dragged = is_dragged(step, drive);
    if (!std::isfinite(u) || u < rounding::accumulated * h ||
        told > negligible * u || dragged)
      return result;
    result.per_time = u / step.step_size();
    result.in_cells = u / h;
    result.loads    = drive.change_of_loads(loading);
    if (result.loads.size > 0)
      result.per_load = u / result.loads.size;
    return result;
  }



  template <int dim>
  void
  FailureReport<dim>::take_yardstick(const TimeInterval &step)
  {
    if (last.is_of_other_loading())
      {
        loading  = step;
        stiffest = Softness();
      }
    stiffest.take_smaller(last);
  }



  template <int dim>
  void
  FailureReport<dim>::remember(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const Drive            &drive)
  {
    Assert(!step.has_inertia,
           ExcMessage("Softness is that of a body without inertia."));
    Assert(step.step_size() > 0, ExcInternalError());
    last = softness(step, unknowns, drive);
    take_yardstick({step.old_time, step.time});
    const double growth = last.growth(stiffest);
    if (!(growth > Softening::large_growth))
      {
        soft = Softening();
        return;
      }
    if (soft.n_steps == 0)
      soft.since = step.old_time;
    ++soft.n_steps;
    soft.way += last.in_cells;
    soft.growth  = growth;
    soft.measure = last.measure(stiffest);
  }



  template double
  FailureReport<2>::Softness::growth(const FailureReport<2>::Softness &) const;
  template std::string
  FailureReport<2>::Softness::measure(const FailureReport<2>::Softness &) const;
  template void
  FailureReport<2>::Softness::take_smaller(const FailureReport<2>::Softness &);
  template bool
  FailureReport<2>::Softness::is_of_other_loading() const;
  template double
  FailureReport<3>::Softness::growth(const FailureReport<3>::Softness &) const;
  template std::string
  FailureReport<3>::Softness::measure(const FailureReport<3>::Softness &) const;
  template void
  FailureReport<3>::Softness::take_smaller(const FailureReport<3>::Softness &);
  template bool
  FailureReport<3>::Softness::is_of_other_loading() const;
  template double
  FailureReport<2>::largest_prescribed(const StepContext<2> &, const Drive &);
  template bool
  FailureReport<2>::is_dragged(const StepContext<2> &, const Drive &);
  template void
  FailureReport<2>::remember(const StepContext<2> &,
                             const NodalField &,
                             const Drive &);
  template typename FailureReport<2>::Softness
  FailureReport<2>::softness(const StepContext<2> &,
                             const NodalField &,
                             const Drive &) const;
  template double
  FailureReport<3>::largest_prescribed(const StepContext<3> &, const Drive &);
  template bool
  FailureReport<3>::is_dragged(const StepContext<3> &, const Drive &);
  template void
  FailureReport<3>::remember(const StepContext<3> &,
                             const NodalField &,
                             const Drive &);
  template typename FailureReport<3>::Softness
  FailureReport<3>::softness(const StepContext<3> &,
                             const NodalField &,
                             const Drive &) const;
} // namespace isochor
