/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/explanation.h>
#include <isochor/base/plain_message.h>
#include <isochor/postprocess/energy_loss.h>

#include <algorithm>
#include <cmath>
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
    report(time,
           loss,
           loss / size,
           size > largest ? "by the scheme, per cycle" : "by the scheme",
           is_cpdi || grid_is_kept ?
             "Use smaller steps (<Time/Step size>) and cells, or another "
             "<Dynamics/Spectral radius>." :
             "Use <Quadrature/Type = CPDI>, or <Grid reset/Steps between "
             "resets = 0>.",
           warnings);
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
        (lost_at_starts > 0 && !is_last))
      return;
    report(time,
           lost_at_starts,
           lost_at_starts / largest,
           "in the first steps, which don't resolve what happens in them",
           "Use smaller steps (<Time/Step size>), and loads and motions that "
           "begin smoothly.",
           warnings);
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
    report(time,
           loss,
           loss / largest,
           "by resets of the grid, if the body has not snapped",
           is_cpdi ? "Use fewer resets (<Grid reset/Steps between resets>) or "
                     "smaller cells." :
                     "Use <Quadrature/Type = CPDI>, or fewer resets (<Grid "
                     "reset/Steps between resets>).",
           warnings);
  }



  void
  EnergyLoss::report(const double       time,
                     const double       loss,
                     const double       share,
                     const std::string &by_what,
                     const std::string &remedy,
                     Warnings          &warnings)
  {
    warnings.add("energy balance",
                 "up to t = " + rounded(time) + " " + rounded(std::abs(loss)) +
                   " J were " + (loss > 0 ? "lost " : "created ") + by_what +
                   ", " + rounded(100 * std::abs(share)) +
                   " % of the largest energy of the body. " + remedy);
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



  ISOCHOR_EXPLAIN(
    energy_balance,
    "energy balance",
    ISOCHOR_ESSENTIAL,
    "dynamics: since the tenth step kinetic and strain energy and plastic "
    "work have fallen behind, or grown beyond, the external work by more "
    "than 1 % of the largest energy, per cycle of a vibration; or the first"
    " ten steps (those behind a jump) have created more than 10 %, or lost "
    "more than 5 % at the end of a run of less than 50. Statics, elastic "
    "materials, from the eleventh step on: external work and stored energy "
    "have come apart by more than 5 %. If the body has not snapped, this is"
    " what resets of the grid set free; with it places of the body drift, "
    "under loads that come and go by 0.1 to 0.2 of that share of the "
    "amplitude ([stability.md](stability.md#cycles))",
    "`Quadrature/Type = CPDI`; a grid that is kept (`Grid reset/Steps "
    "between resets = 0`, with `Smallest element quality = 0`); smaller "
    "steps and cells; loads and motions that begin smoothly; where energy "
    "is created, a smaller `Dynamics/Spectral radius`, or `Time/Tolerated "
    "error`")
} // namespace isochor
