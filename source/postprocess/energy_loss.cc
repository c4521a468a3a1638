/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/postprocess/energy_loss.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Of the stiffness: energies that are those of rounding errors. */
    constexpr double rounding = 4e-14;
  } // namespace



  void
  EnergyLoss::look(const double   time,
                   const Balance &balance,
                   const bool     motion_starts,
                   const bool     is_cpdi,
                   const bool     grid_is_kept,
                   const bool     is_last,
                   Warnings      &warnings)
  {
    constexpr double       threshold     = 0.01;
    constexpr unsigned int n_first_steps = 10, n_between = 50;

    const double total  = balance.kinetic + balance.internal;
    const double before = std::exchange(lost, balance.supplied - total);
    // starts that follow each other don't hide all
    if (motion_starts && n_since_start >= n_between)
      n_since_start = 0;
    if (n_since_start < n_first_steps)
      lost_at_starts += lost - before;
    else
      kinetic_change += std::abs(balance.kinetic - kinetic);
    ++n_since_start;
    kinetic           = balance.kinetic;
    largest           = std::max(largest, total);
    const double loss = lost - lost_at_starts,
                 size = std::max(largest, kinetic_change / 4);
    // before, a motion that begins smoothly has hardly any energy
    if (n_since_start == n_first_steps ||
        (is_last &&
         n_since_start < (lost_at_starts > 0 ? n_between : n_first_steps)))
      warn_of_starts(time, balance, is_last, warnings);
    if (std::abs(loss) <=
        std::max(threshold * size, rounding * balance.stiffness))
      return;
    std::ostringstream text;
    text.precision(3);
    text << "By t = " << time << " the scheme has "
         << (loss > 0 ? "lost " : "created ") << std::abs(loss) << " J, "
         << 100 * std::abs(loss) / size
         << " % of the largest energy of the body"
         << (size > largest ? " per cycle" : "")
         << ", see 'Energy lost by the scheme' in the statistics. ";
    const std::string keep =
      "a grid that is kept (<Grid reset/Steps between resets = 0>; where "
      "bodies have come together or cells are distorted it is put back all "
      "the same)";
    if (!is_cpdi && !grid_is_kept)
      text << "Points that change cells take their stresses with them: "
              "<Quadrature/Type = CPDI> or "
           << keep
           << " hardly lose any. Else smaller steps (<Time/Step size>) and "
              "cells.";
    else if (told[loss > 0 ? 1 : 0])
      text << "It has " << (loss > 0 ? "created" : "lost")
           << " energy before, so that another <Dynamics/Spectral radius> "
              "helps against one only: use smaller steps (<Time/Step size>) "
              "and cells"
           << (grid_is_kept ? "" : ", or " + keep) << '.';
    else
      text << "Use "
           << (loss > 0 ? "smaller steps (<Time/Step size>) and cells, a "
                          "larger" :
                          "a smaller")
           << " <Dynamics/Spectral radius>"
           << (grid_is_kept ? "" : ", or " + keep) << '.';
    told[loss > 0 ? 0 : 1] = true;
    warnings.add(loss > 0 ? "energy lost by the scheme" :
                            "energy created by the scheme",
                 text.str());
  }



  /** What steps lose at a start is what a sudden motion or an impact radiates
   * into waves that they don't resolve, but all there is to see of a run that
   * has hardly more steps. What they create isn't meant. */
  void
  EnergyLoss::warn_of_starts(const double   time,
                             const Balance &balance,
                             const bool     is_last,
                             Warnings      &warnings) const
  {
    constexpr double much_lost = 0.05, much_created = 0.1;
    const double     much = lost_at_starts > 0 ? much_lost : much_created;
    const double     size = std::abs(lost_at_starts);
    if (size <= std::max(much * largest, rounding * balance.stiffness) ||
        (lost_at_starts > 0 && (!is_last || told[0])))
      return;
    std::ostringstream text;
    text.precision(3);
    text << "By t = " << time << " the steps at the start have "
         << (lost_at_starts > 0 ? "lost " : "created ") << size << " J, "
         << 100 * size / largest
         << " % of the largest energy of the body: they don't resolve what "
            "happens in them, ";
    if (lost_at_starts > 0)
      text << "a load that acts at once or a vibration for example, which is "
              "damped. Use smaller steps (<Time/Step size>), a tenth of the "
              "shortest vibration that matters or less, and loads and motions "
              "that begin smoothly.";
    else
      text << "an impact for example. Use smaller steps "
              "(<Time/Step size>) that don't grow (<Time/Growth factor = 1>), "
              "or let their error choose them (<Time/Tolerated error>).";
    warnings.add(lost_at_starts > 0 ? "energy lost at the start" :
                                      "energy created at the start",
                 text.str());
  }



  void
  EnergyLoss::look_in_statics(const double   time,
                              const Balance &balance,
                              const bool     is_cpdi,
                              Warnings      &warnings)
  {
    constexpr double threshold = 0.05;

    lost = balance.supplied - balance.internal;
    if (n_since_start++ == 0)
      lost_at_starts = lost;
    largest           = std::max(largest, balance.internal);
    const double loss = lost - lost_at_starts;
    if (std::abs(loss) <=
        std::max(threshold * largest, rounding * balance.stiffness))
      return;
    std::ostringstream text;
    text.precision(3);
    text
      << "By t = " << time << " the work done on the elastic body is "
      << std::abs(loss) << " J " << (loss > 0 ? "more" : "less")
      << " than what it has stored, " << 100 * std::abs(loss) / largest
      << " % of its largest energy. If it has not snapped, this comes from "
         "putting the grid back: each time the body finds another "
         "equilibrium, and what this changes adds up. Under loads that come "
         "and go it drifts, in the end by as much as it moves. Put the grid "
         "back less often or never (<Grid reset/Steps between resets>), take "
         "fewer steps and smaller cells"
      << (is_cpdi ? "." : ", or <Quadrature/Type = CPDI>.");
    warnings.add("a body that drifts", text.str());
  }



  void
  EnergyLoss::save(std::ostream &state) const
  {
    state << largest << ' ' << kinetic << ' ' << kinetic_change << ' ' << lost
          << ' ' << lost_at_starts << ' ' << n_since_start << ' ';
  }



  void
  EnergyLoss::load(std::istream &state)
  {
    state >> largest >> kinetic >> kinetic_change >> lost >> lost_at_starts >>
      n_since_start;
  }
} // namespace isochor
