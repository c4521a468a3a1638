/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/terminal.h>

#include <iostream>

namespace isochor
{
  Terminal::Terminal(const MPI_Comm comm)
    : first_rank(Utilities::MPI::this_mpi_process(comm) == 0)
    , pcout(std::cout, false)
    , sections(std::cout, TimerOutput::never, TimerOutput::wall_times)
  {}



  void
  Terminal::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry("Terminal",
                      "progress",
                      Patterns::Selection("quiet|progress|times|verbose"),
                      "Warnings and errors only; a line per step with an "
                      "estimate of the time left; in addition tables of the "
                      "times and of the work done at the end; and the "
                      "residuals of each iteration.");
  }



  void
  Terminal::parse_parameters(ParameterHandler &prm)
  {
    const std::string amount = prm.get("Terminal");
    pcout.set_condition(first_rank && amount != "quiet");
    verbose = pcout.is_active() && amount == "verbose";
    tables  = verbose || (pcout.is_active() && amount == "times");
  }



  std::ostream *
  Terminal::log() const
  {
    return verbose ? &std::cout : nullptr;
  }



  void
  Terminal::reached(const double time)
  {
    remaining_time.reached(time, clock.wall_time());
  }



  std::string
  Terminal::time_left(const double end_time) const
  {
    return readable_duration(remaining_time.seconds_to(end_time));
  }



  void
  Terminal::print_times() const
  {
    if (tables)
      sections.print_summary();
  }



  void
  Terminal::print_work(const std::vector<std::string> &not_needed) const
  {
    if (tables)
      tally.print(std::cout, not_needed);
  }



  void
  Terminal::print_summary(const Warnings &warnings) const
  {
    if (warnings.all().empty())
      pcout << warnings.summary() << std::endl;
    else if (first_rank)
      std::cerr << warnings.summary()
                << "\n(isochor --explain NAME tells more of one.)" << std::endl;
  }
} // namespace isochor
