/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_energy_loss_h
#define isochor_energy_loss_h

#include <isochor/base/warnings.h>

#include <iosfwd>
#include <string>

namespace isochor
{
  /** Watches the energy that the scheme loses or makes. */
  class EnergyLoss
  {
  public:
    /** At the end of a step (J). */
    struct Balance
    {
      double kinetic;
      double internal;  ///< strain energy and plastic work
      double supplied;  ///< external work, and what there was at t = 0
      double stiffness; ///< Σ_p V_p G
    };

    /**
     * Warn once the scheme has lost, or made, more than 1 % of the largest
     * energy, or of that for each cycle: a vibration turns its energy into
     * kinetic energy and back twice, which changes that by four times as much.
     * What goes in the first steps doesn't count, nor in those after a
     * prescribed motion that starts (@p motion_starts) once in a while:
     * energies are small beside what is to come, and what sudden motions do
     * faster than the steps is damped on purpose; but energy that is made
     * there, more than 10 % of the largest, is told of at their end or that of
     * the run, the step that @p is_last, and then also what is lost there, if
     * the run has hardly more steps. Energies at strains of 2e-7 are those of
     * rounding and of what Newton's method leaves.
     */
    void
    look(const double   time,
         const Balance &balance,
         const bool     motion_starts,
         const bool     is_cpdi,
         const bool     grid_is_kept,
         const bool     is_last,
         Warnings      &warnings);

    /**
     * In statics, for bodies of elastic materials: warn once external work and
     * stored energy differ by more than 5 % of the largest energy, counted from
     * the first call. Each reset of the grid leaves the body a little out of
     * equilibrium on the new one; what is set free when it finds that is lost,
     * and the places of points that come with it add up from reset to reset. A
     * nearly incompressible cantilever that is bent up and down
     * (doc/benchmarks/scenes/cycles.prm) has drifted by 0.1 to 0.15 of that
     * share of its amplitude.
     */
    void
    look_in_statics(const double   time,
                    const Balance &balance,
                    const bool     is_cpdi,
                    Warnings      &warnings);

    void
    save(std::ostream &state) const;
    void
    load(std::istream &state);

  private:
    /** See look(). */
    void
    warn_of_starts(const double   time,
                   const Balance &balance,
                   const bool     is_last,
                   Warnings      &warnings) const;

    /** Warn of @p loss (J), @p share of the largest energy. */
    static void
    report(const double       time,
           const double       loss,
           const double       share,
           const std::string &by_what,
           const std::string &remedy,
           Warnings          &warnings);

    double largest = 0, kinetic = 0, kinetic_change = 0;
    /** All that was lost, and what of it doesn't count. */
    double lost = 0, lost_at_starts = 0;
    /** Steps since the last start. */
    unsigned int n_since_start = 0;
  };
} // namespace isochor

#endif
