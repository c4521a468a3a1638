/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/stress_recovery.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/base/rounding.h>
#include <isochor/diagnosis/diagnosis.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Over the ranks, of a step or a sum over steps (J). */
    struct Squares
    {
      double error = 0, norm = 0;
      double least   = 0; ///< a norm below is none
      double kinetic = 0; ///< in dynamics
    };



    template <int dim>
    Squares
    squares_of(const StepContext<dim> &step, const NodalField &unknowns)
    {
      const BodyState<dim>  state = state_of_body(step, unknowns);
      const StressError     error = recovered_error(state);
      std::array<double, 4> sums{{0., error.norm_square, 0., 0.}};
      for (unsigned int q = 0; q < state.size(); ++q)
        {
          sums[0] += error.squares[q];
          // strains that a body has by rounding when it is carried along
          sums[2] += state.volume[q] * state.shear_modulus[q] *
                     rounding::places * rounding::places;
        }
      if (!step.points.velocity.empty())
        for (unsigned int q = 0; q < state.size(); ++q)
          sums[3] +=
            step.points.mass[q] / 2 * step.points.velocity[q].norm_square();
      sum_over_ranks(sums, step.grid.communicator());
      return {sums[0], sums[1], sums[2], sums[3]};
    }



    /** At the start of the step. Collective. */
    template <int dim>
    double
    norm_square_at_start(const StepContext<dim> &step,
                         const NodalField       &unknowns)
    {
      NodalField at_rest = unknowns;
      for (unsigned int i = 0; i < step.nodes.n_local() * step.n_components;
           ++i)
        if (i % step.n_components < dim)
          at_rest.local_element(i) = 0;
      return Utilities::MPI::sum(energy_norm_square(
                                   state_of_body(step, at_rest)),
                                 step.grid.communicator());
    }
  } // namespace



  /**
   * Estimates by how much the grid is too coarse for what the body does, and
   * warns if the stresses are wrong (stress_recovery.h) by as much as where
   * forces and displacements are wrong by a tenth or more. In statics those of
   * the last step count, unless it unloads the body. In dynamics, where the
   * last step may be any, it is the mean over time of the squares that count;
   * the first ten steps and each tenth one are looked at. A body whose kinetic
   * energy is larger than what its stresses store, as one that flies or turns,
   * moves rightly by and large even if its stresses are wrong: they are then
   * measured against its kinetic energy, which is the same in a vibration.
   */
  template <int dim>
  class TooCoarseGrid : public Diagnosis<dim>
  {
  public:
    void
    step_converged(const ConvergedStep<dim> &converged) override
    {
      constexpr unsigned int  each     = 10;
      const bool              dynamic  = converged.scene.has_inertia();
      const unsigned int      n        = converged.scene.time.step + 1;
      const StepContext<dim> &step     = converged.result.step;
      const NodalField       &unknowns = converged.result.unknowns;
      if (!converged.is_last && !(dynamic && (n <= each || n % each == 0)))
        return;
      const Squares of_step = squares_of(step, unknowns);
      if (dynamic)
        {
          // a step stands for those that were left out before it
          const double weight = std::min(n - last_look, each);
          last_look           = n;
          of_run.error += weight * of_step.error;
          of_run.norm += weight * of_step.norm;
          of_run.least += weight * of_step.least;
          of_run.kinetic += weight * of_step.kinetic;
          if (converged.is_last)
            judge(step.time, of_run, ", mean over time");
          return;
        }
      // what is left when the load is gone says nothing
      constexpr double unloaded = 0.5;
      if (of_step.norm > unloaded * norm_square_at_start(step, unknowns))
        judge(step.time, of_step, "");
    }

    std::string
    run_ended() const override
    {
      return estimate;
    }

  private:
    /** Warn, or note the estimate. */
    void
    judge(const double time, const Squares &squares, const std::string &of_what)
    {
      constexpr double much = 0.36;
      if (squares.norm <= squares.least)
        return;
      const double part =
        squares.error / std::max(squares.norm, squares.kinetic);
      const auto percent = [](const double share) {
        const double tenths = std::round(1000 * share);
        return tenths < 1 ? "less than 0.1 %" : rounded(tenths / 10) + " %";
      };
      const std::string of_stresses =
        percent(std::sqrt(squares.error / squares.norm)) +
        " (energy norm, by recovery" + of_what + ")";
      if (part > much * much)
        this->warn("up to t = " + rounded(time) +
                   " stresses are wrong by an estimated " + of_stresses +
                   ": an elastic body resists too much, by some " +
                   percent(part) +
                   ". Use smaller cells, <Grid/Shape functions = Q1>, or "
                   "<Adaptive grid/Target of relative error>.");
      else
        estimate = "Estimated error of the grid: stresses " + of_stresses +
                   ", resistance of an elastic body " + percent(part);
    }

    Squares      of_run;        ///< in dynamics
    unsigned int last_look = 0; ///< the step
    std::string  estimate;
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    TooCoarseGrid,
    "coarse grid",
    ISOCHOR_ESSENTIAL,
    "in the last step of a quasi-static analysis, unless it unloads the body "
    "or strains are below 10⁻⁶; at the end of a run in dynamics, for the first "
    "ten steps and each tenth one (since a restart) together, as means over "
    "time: the error of the stresses, estimated by recovery (energy norm, "
    "\"The error\" in [method.md](method.md)), is more than 36 %. In dynamics "
    "it is measured against the kinetic energy where that is larger. The "
    "square of it is about the part by which an elastic body resists too much "
    "(a beam bent by its rigid end, four cells high, form u: 24 % too much "
    "moment, estimate 44 %, squared 19 %; with eight cells 6 %, 23 %, 5.4 %). "
    "Smaller estimates stand at the end of the output (`Estimated error of the "
    "grid`). It is of all stresses: errors of the bending of a beam that is "
    "also pressed along its axis are a smaller part, and contact that is "
    "little wider than a cell isn't seen",
    "smaller cells, `Grid/Shape functions = Q1`, an adaptive grid with `Target "
    "of relative error`")
} // namespace isochor
