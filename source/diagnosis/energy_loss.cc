/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/postprocess/energy_balance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace isochor
{
  /** The energy that the scheme loses or makes. */
  template <int dim>
  class EnergyLoss : public Diagnosis<dim>
  {
  public:
    void
    scene_read(const ParameterHandler & /*prm*/,
               const Scene<dim> &scene,
               const GridReset<dim> & /*reset*/) override
    {
      size_of_steps = scene.time.follows_error() ? "<Time/Tolerated error>" :
                                                   "<Time/Step size>";
    }

    void
    step_ended(const ConvergedStep<dim> &step) override
    {
      const StepResult<dim> &result  = step.result;
      const bool             is_cpdi = result.step.points.has_stencils();
      for (const auto *const energies :
           with_role<const HasEnergyBalance<dim>>(step.scene.postprocessors))
        if (const auto *const balance = energies->energy_balance(result))
          step.scene.has_inertia() ?
            look(result.step.time,
                 *balance,
                 result.time.starts_anew,
                 is_cpdi,
                 result.step.grid_is_kept,
                 result.step.time >= result.time.end_time()) :
            look_in_statics(result.step.time, *balance, is_cpdi);
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      state << largest << ' ' << kinetic << ' ' << kinetic_change << ' ' << lost
            << ' ' << lost_at_starts << ' ' << n_since_start;
      return state.str();
    }
    void
    load_state(const std::string &text) override
    {
      std::istringstream state(text);
      state >> largest >> kinetic >> kinetic_change >> lost >> lost_at_starts >>
        n_since_start;
    }

  private:
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
    look(const double         time,
         const EnergyBalance &balance,
         const bool           motion_starts,
         const bool           is_cpdi,
         const bool           grid_is_kept,
         const bool           is_last)
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
        warn_of_starts(time, balance, is_last);
      if (std::abs(loss) <=
          std::max(threshold * size, rounding * balance.stiffness))
        return;
      report(time,
             loss,
             loss / size,
             size > largest ? "by the scheme, per cycle" : "by the scheme",
             is_cpdi || grid_is_kept ?
               "Use smaller steps (" + size_of_steps + ") and cells, or " +
                 (loss > 0 ? "a larger" : "a smaller") +
                 " <Dynamics/Spectral radius>." :
               "Use <Quadrature/Type = CPDI>, or <Grid reset/Steps between "
               "resets = 0>.");
    }

    /** What steps lose at a start is what a sudden motion or an impact radiates
     * into waves that they don't resolve, but all there is to see of a run that
     * has hardly more steps. What they create isn't meant. */
    void
    warn_of_starts(const double         time,
                   const EnergyBalance &balance,
                   const bool           is_last) const
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
             "Use smaller steps (" + size_of_steps +
               "), and loads and motions that begin smoothly.");
    }

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
    look_in_statics(const double         time,
                    const EnergyBalance &balance,
                    const bool           is_cpdi)
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
             is_cpdi ?
               "Use fewer resets (<Grid reset/Steps between resets>) or "
               "smaller cells." :
               "Use <Quadrature/Type = CPDI>, or fewer resets (<Grid "
               "reset/Steps between resets>).");
    }

    /** Warn of @p loss (J), @p share of the largest energy. */
    void
    report(const double       time,
           const double       loss,
           const double       share,
           const std::string &by_what,
           const std::string &remedy) const
    {
      this->warn("up to t = " + rounded(time) + " " + rounded(std::abs(loss)) +
                 " J were " + (loss > 0 ? "lost " : "created ") + by_what +
                 ", " + rounded(100 * std::abs(share)) +
                 " % of the largest energy of the body. " + remedy);
    }

    /** Of the stiffness: energies that are those of rounding errors. */
    static constexpr double rounding = 4e-14;

    std::string size_of_steps; ///< the parameter
    double      largest = 0, kinetic = 0, kinetic_change = 0;
    /** All that was lost, and what of it doesn't count. */
    double lost = 0, lost_at_starts = 0;
    /** Steps since the last start. */
    unsigned int n_since_start = 0;
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    EnergyLoss,
    "energy balance",
    ISOCHOR_ESSENTIAL,
    "dynamics: since the tenth step kinetic and strain energy and plastic work "
    "have fallen behind, or grown beyond, the external work by more than 1 % "
    "of the largest energy, per cycle of a vibration; or the first ten steps "
    "(those behind a jump) have created more than 10 %, or lost more than 5 % "
    "at the end of a run of less than 50. Quasi-static, elastic materials, "
    "from the eleventh step on: external work and stored energy have come "
    "apart by more than 5 %. If the body has not snapped, this is what resets "
    "of the grid set free; with it places of the body drift, under loads that "
    "come and go by 0.1 to 0.2 of that share of the amplitude "
    "([stability.md](stability.md#cycles))",
    "`Quadrature/Type = CPDI`; no reset (`Grid reset/Steps between resets = "
    "0`, with `Smallest element quality = 0`); smaller steps and cells; loads "
    "and motions that begin smoothly; a larger `Dynamics/Spectral radius` "
    "where energy is lost, a smaller one where it is created, or `Time/Tolerated error`")
} // namespace isochor
