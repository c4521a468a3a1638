/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/rounding.h>
#include <isochor/nonlinear_solver/load_stepping.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  void
  LoadStepping::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Time");
    prm.declare_entry("End time",
                      "1",
                      Patterns::Double(0),
                      "Time (s) at which the run ends; without inertia t is a "
                      "load parameter.");
    prm.declare_entry(
      "Step size",
      "1",
      Patterns::Double(0),
      "Size of the first step (s) or, if this parameter is changed, of the "
      "first one after a restart.");
    prm.declare_entry(
      "Minimum step size",
      "0",
      Patterns::Double(0),
      "A step that fails is halved down to this (s); then the "
      "run ends with an error. 0: a thousandth of 'Step size'.");
    prm.declare_entry(
      "Maximum step size",
      "0",
      Patterns::Double(0),
      "Steps that go well grow up to this (s). 0: 'Step size'.");
    prm.declare_entry(
      "Growth factor",
      "1.5",
      Patterns::Double(1),
      "Factor by which the size of steps grows after one that went well.");
    prm.declare_entry(
      "Iterations of an easy step",
      "5",
      Patterns::Integer(1),
      "A step went well if it took at most so many factorisations.");
    prm.declare_entry(
      "Tolerated error",
      "0",
      Patterns::Double(0),
      "In dynamics: what the displacements of the body may be wrong by (m, "
      "root mean square) because of one step, by an estimate. Steps that are "
      "worse are repeated with a smaller size, others grow up to 'Maximum step "
      "size' or to what this allows, but by no more than a cell's size of "
      "motion. About a ten-thousandth of the motion of interest is a start. 0: "
      "sizes don't depend on the error.");
    prm.declare_entry("Output interval",
                      "0",
                      Patterns::Double(0),
                      "Fields are written at multiples of this time (s), which "
                      "the steps hit exactly, and at the end. 0: after every "
                      "step.");
    prm.leave_subsection();
  }



  void
  LoadStepping::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Time");
    end       = prm.get_double("End time");
    step_size = prm.get_double("Step size");
    AssertThrow(end > 0,
                ExcMessage("The parameter <Time/End time> must be positive: "
                           "a run begins at t = 0."));
    AssertThrow(step_size > 0,
                ExcMessage("The parameter <Time/Step size> must be positive."));
    first_step_size = step_size;
    smallest        = prm.get_double("Minimum step size");
    if (smallest == 0)
      smallest = step_size / 1000;
    largest = prm.get_double("Maximum step size");
    if (largest == 0)
      largest = step_size;
    AssertThrow(smallest <= step_size && step_size <= largest,
                ExcMessage(
                  "The parameters of <Time> must satisfy <Minimum step "
                  "size> <= <Step size> <= <Maximum step size>."));
    growth          = prm.get_double("Growth factor");
    easy_iterations = prm.get_integer("Iterations of an easy step");
    tolerated_error = prm.get_double("Tolerated error");
    output_interval = prm.get_double("Output interval");
    prm.leave_subsection();
  }



  double
  LoadStepping::next_target() const
  {
    const double output = (reached_output + 1) * output_interval;
    // of 3 x 0.3 and 0.9 one counts
    return output_interval > 0 && output < (1 - rounding::accumulated) * end ?
             output :
             end;
  }



  bool
  LoadStepping::finished() const
  {
    return time >= end;
  }



  double
  LoadStepping::next_time() const
  {
    // no crumbs: of two targets that nearly agree one counts; a target within a
    // step and a bit is hit, the rest of the way to one within two steps is
    // halved
    const double next = next_target();
    const double target =
      next - extra_target < 5e-4 * step_size ? next : extra_target;
    const double rest = target - time;
    if (rest <= step_size * (1 + 1e-8))
      return target;
    return time + (rest < 2 * step_size * (1 - 1e-8) ? rest / 2 : step_size);
  }



  bool
  LoadStepping::is_last_step() const
  {
    return next_time() >= (1 - rounding::accumulated) * end_time();
  }



  void
  LoadStepping::accept(const unsigned int n_iterations)
  {
    Assert(!finished(), ExcMessage("The end has been reached."));
    Assert(next_time() > time, ExcMessage("The step has no size."));
    const double reached = next_time();
    if (output_interval > 0 && reached == next_target())
      reached_output = std::floor(reached / output_interval * (1 + 1e-12));
    last_size    = reached - time;
    time         = reached;
    extra_target = std::numeric_limits<double>::infinity();
    ++step;
    const double before = step_size;
    if (n_iterations <= easy_iterations)
      step_size = std::min(largest, step_size * growth);
    if (follows_error())
      {
        // little more is not worth another size: that would need another matrix
        constexpr double little = 1.2;
        const double     size   = tolerated_size(last_size);
        step_size               = size > before && size < little * before ?
                                    before :
                                    std::max(smallest, std::min(step_size, size));
        error = cells_crossed = 0;
      }
  }



  bool
  LoadStepping::tolerates(const double error, const double crossed)
  {
    Assert(!(error < 0) && !(crossed < 0), ExcInternalError());
    this->error   = error;
    cells_crossed = crossed;
    return !follows_error() || !can_be_cut() ||
           (error <= tolerated_error && crossed <= 1);
  }



  double
  LoadStepping::tolerated_size(const double size) const
  {
    Assert(size > 0, ExcInternalError());
    // the error of a step is of third order in its size, its way of first
    constexpr double margin = 0.9, most = 1e3;
    return size * std::min({most,
                            margin * std::cbrt(tolerated_error / error),
                            margin / cells_crossed});
  }



  std::vector<std::string>
  LoadStepping::changeable_parameters()
  {
    return {"Time/"};
  }



  bool
  LoadStepping::can_be_cut() const
  {
    // the difference of two times is rounded
    return (next_time() - time) / 2 >= smallest * (1 - 1e-8);
  }



  void
  LoadStepping::reject(const std::string &reason)
  {
    const double failed = next_time() - time;
    AssertThrow(
      can_be_cut(),
      ExcMessage("The step from t = " + std::to_string(time) + " of size " +
                 std::to_string(failed) +
                 " failed and can't be cut back further: " + reason +
                 ". What was computed up to there is written. Lower <Time/"
                 "Minimum step size>, or look at the last output for what goes "
                 "wrong."));
    step_size = failed / 2;
    if (error > tolerated_error || cells_crossed > 1)
      step_size = std::max({smallest, failed / 10, tolerated_size(failed)});
    error = cells_crossed = 0;
    ++n_cuts;
  }



  bool
  LoadStepping::output_due() const
  {
    // (relative to the interval, if that is meant to be never, any time would
    // be close to 0)
    return output_interval == 0 || time >= end ||
           std::abs(time - reached_output * output_interval) <= 1e-10 * time;
  }



  bool
  LoadStepping::next_output_due() const
  {
    return output_interval == 0 || next_time() == next_target();
  }



  void
  LoadStepping::resume(const LoadStepping &saved)
  {
    time           = saved.time;
    step           = saved.step;
    last_size      = saved.last_size;
    n_cuts         = saved.n_cuts;
    step_size      = saved.first_step_size == first_step_size ?
                       std::min(saved.step_size, largest) :
                       first_step_size;
    reached_output = saved.reached_output;
    if (saved.output_interval != output_interval)
      reached_output = output_interval > 0 ?
                         std::floor(time / output_interval * (1 + 1e-12)) :
                         0;
  }
} // namespace isochor
