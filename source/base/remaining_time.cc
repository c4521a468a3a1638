/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/remaining_time.h>

#include <cmath>
#include <limits>

namespace isochor
{
  void
  RemainingTime::reached(const double simulated_time, const double wall_time)
  {
    marks.emplace_back(simulated_time, wall_time);
    if (marks.size() > n_steps + 1)
      marks.pop_front();
  }



  double
  RemainingTime::seconds_to(const double end_time) const
  {
    if (!marks.empty() && marks.back().first >= end_time)
      return 0.;
    if (marks.size() < 2)
      return std::numeric_limits<double>::quiet_NaN();
    const auto &[first_time, first_wall] = marks.front();
    const auto &[time, wall]             = marks.back();
    return (end_time - time) * (wall - first_wall) / (time - first_time);
  }



  std::string
  readable_duration(const double seconds)
  {
    if (!std::isfinite(seconds))
      return "";
    const auto in_units = [](const double      amount,
                             const long        per_unit,
                             const char *const unit,
                             const char *const part) {
      const long total = std::lround(amount);
      const long rest  = total % per_unit;
      return std::to_string(total / per_unit) + " " + unit +
             (rest > 0 ? " " + std::to_string(rest) + " " + part : "");
    };
    const double minute = 60, hour = 60 * minute, day = 24 * hour;
    if (std::round(seconds) < minute)
      return std::to_string(std::lround(seconds)) + " s";
    if (std::round(seconds) < 10 * minute)
      return in_units(seconds, 60, "min", "s");
    if (std::round(seconds / minute) * minute < hour)
      return std::to_string(std::lround(seconds / minute)) + " min";
    if (std::round(seconds / minute) * minute < 10 * hour)
      return in_units(seconds / minute, 60, "h", "min");
    if (std::round(seconds / hour) * hour < day)
      return std::to_string(std::lround(seconds / hour)) + " h";
    return in_units(seconds / hour, 24, "d", "h");
  }
} // namespace isochor
