/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_remaining_time_h
#define isochor_remaining_time_h

#include <deque>
#include <string>
#include <utility>

namespace isochor
{
  /**
   * Estimates how long a run still takes: the simulated time that is left over
   * the simulated time per second of wall time in the last steps. Failed
   * attempts between these steps count, as they took their time.
   */
  class RemainingTime
  {
  public:
    /** Tell that @p simulated_time was reached when the clock on the wall
     * showed @p wall_time (s, from any origin): first at the start of the run,
     * then after each step. */
    void
    reached(const double simulated_time, const double wall_time);

    /** Seconds of wall time from the last call of reached() to @p end_time;
     * zero if that is reached, not-a-number before the first step. */
    double
    seconds_to(const double end_time) const;

  private:
    /** As many steps as the estimate looks back: enough to level out single
     * steps, few enough to follow the growth of steps. */
    static constexpr unsigned int n_steps = 10;

    /** Simulated and wall times reached. */
    std::deque<std::pair<double, double>> marks;
  };



  /** @p seconds to read, in the two largest units that matter: "48 s",
   * "1 min 5 s", "1 h 12 min", "2 d 3 h"; from ten minutes on in full minutes,
   * from ten hours on in full hours. Empty for what isn't a number. */
  std::string
  readable_duration(const double seconds);
} // namespace isochor

#endif
