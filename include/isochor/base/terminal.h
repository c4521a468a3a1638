/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_terminal_h
#define isochor_terminal_h

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/timer.h>

#include <isochor/base/remaining_time.h>
#include <isochor/base/warnings.h>
#include <isochor/base/work_tally.h>

#include <ostream>
#include <string>

namespace isochor
{
  using namespace dealii;

  /** What a run prints: on rank 0, and as much as the user asks for. It also
   * holds the clocks, whose times are printed at the end. */
  class Terminal
  {
  public:
    Terminal(const MPI_Comm comm);

    /** Both with @p prm in its subsection "Output". */
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Where the lines of a run go. */
    const ConditionalOStream &
    out() const
    {
      return pcout;
    }

    /** Where the residuals of each iteration go; null if nobody asked. */
    std::ostream *
    log() const;

    /** Times of the parts of a run. */
    TimerOutput &
    timer()
    {
      return sections;
    }

    /** What was done and what was skipped. */
    WorkTally &
    work()
    {
      return tally;
    }

    const WorkTally &
    work() const
    {
      return tally;
    }

    /** The run has reached @p time (s): at its start and after each step. */
    void
    reached(const double time);

    /** How long it takes until @p end_time (s), in words. */
    std::string
    time_left(const double end_time) const;

    /** The table of times, at the end of a run, if it is asked for. */
    void
    print_times() const;

    /** The table of what was done and skipped, and what was @p not_needed, if
     * it is asked for. */
    void
    print_work(const std::vector<std::string> &not_needed) const;

    /** How many warnings there were. Goes where the warnings are, so that
     * nobody misses them because of 'quiet'. */
    void
    print_summary(const Warnings &warnings) const;

  private:
    const bool         first_rank;
    bool               verbose = false, tables = false;
    ConditionalOStream pcout;
    TimerOutput        sections;
    WorkTally          tally;
    Timer              clock;
    RemainingTime      remaining_time;
  };
} // namespace isochor

#endif
