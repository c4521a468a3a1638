/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_load_stepping_h
#define isochor_load_stepping_h

#include <deal.II/base/parameter_handler.h>

#include <limits>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * The sizes of the load (time) steps: cut back when a step fails, growing
   * when it goes well or, in dynamics, by the error that they make, and hitting
   * output times and the end exactly.
   */
  class LoadStepping
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Whether the end is reached. */
    bool
    finished() const;

    /** The end of the step that comes next. */
    double
    next_time() const;

    /** Whether the step to next_time() ends the run. */
    bool
    is_last_step() const;

    /** A step has to end at @p target (s), this one or, so that none is short,
     * the next: something happens there. Until the step is accepted. */
    void
    aim_at(const double target)
    {
      extra_target = target;
    }

    /** The step to next_time() converged in @p n_iterations. */
    void
    accept(const unsigned int n_iterations);

    /** Whether the sizes follow the error of the steps. */
    bool
    follows_error() const
    {
      return tolerated_error > 0;
    }

    /** The step to next_time() has converged, with the @p error (m), and the
     * body has @p crossed so many cells in it. Returns whether that is
     * tolerated: not, if a smaller step may be tried, an error above 'Tolerated
     * error', nor that it moves by more than a cell, as it may have gone
     * through what it should have met. */
    bool
    tolerates(const double error, const double crossed);

    /** Whether the step to next_time() has more than the error tolerated. */
    bool
    exceeds_error() const
    {
      return follows_error() && error > tolerated_error;
    }

    /** The parameters, by path, that a resumed run may set anew. */
    static std::vector<std::string>
    changeable_parameters();

    /** Whether the step to next_time() may be tried with half its size. */
    bool
    can_be_cut() const;

    /** The step to next_time() failed because of @p reason. Throws if the step
     * is already the smallest allowed. */
    void
    reject(const std::string &reason);

    /** Whether the time just reached is one to write output at. */
    bool
    output_due() const;

    /** Whether next_time() is one to write output at. */
    bool
    next_output_due() const;

    double       time      = 0;
    unsigned int step      = 0;
    double       last_size = 0; ///< of the last step that was accepted
    unsigned int n_cuts    = 0;
    double       step_size = 1;
    /** Of the step to next_time(), see tolerates(). */
    double error = 0, cells_crossed = 0;
    /** In dynamics, looked for in each step: whether it begins with a search
     * for its acceleration. */
    bool starts_anew = false;

    double
    end_time() const
    {
      return end;
    }

    /** Continue where @p saved was, with the parameters of this object. The
     * step size is the last one of @p saved, unless the parameters ask for
     * another at the start than they did then. */
    void
    resume(const LoadStepping &saved);

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &time &step &last_size &n_cuts &step_size &reached_output
        &first_step_size &output_interval;
    }

  private:
    /** The size (s) with which a step like one of size @p size, which has the
     * error above, would have most of what is tolerated. */
    double
    tolerated_size(const double size) const;

    /** The next time that has to be hit. */
    double
    next_target() const;

    double       first_step_size = 1;
    double       end             = 1;
    double       smallest        = 0;
    double       largest         = 1;
    double       growth          = 1;
    double       tolerated_error = 0; ///< (m); 0: any
    unsigned int easy_iterations = 5;
    double       output_interval = 0;
    unsigned int reached_output  = 0;
    /** See aim_at(); not saved, as it is looked for in each step. */
    double extra_target = std::numeric_limits<double>::infinity();
  };
} // namespace isochor

#endif
