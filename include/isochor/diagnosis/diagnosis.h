/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_diagnosis_h
#define isochor_diagnosis_h

#include <isochor/base/explanation.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/base/warnings.h>
#include <isochor/cut_cells/discrete_extension.h>
#include <isochor/linear_solver/sparse_system.h>
#include <isochor/postprocess/postprocessor.h>
#include <isochor/scene/scene.h>
#include <isochor/transfer/grid_reset.h>

#include <string>
#include <vector>

namespace isochor
{
  /** How much softer a body without inertia has become. */
  struct Softening
  {
    /** By which the displacement per load has grown where a body flows. */
    static constexpr double large_growth = 10;

    /** Steps up to now, one after the other, whose displacement per time, and
     * per change of the loads, was larger by so much than in the stiffest step
     * of the same loading. */
    unsigned int n_steps = 0;
    double       since   = -1; ///< when they began
    double       way     = 0;  ///< of all of them, in cells
    double       growth  = -1; ///< of the last one
    std::string  measure = ""; ///< "load" or "time"
  };

  /** What a diagnosis may look at when a step has converged; all of it belongs
   * to others. */
  template <int dim>
  struct ConvergedStep
  {
    const Scene<dim>      &scene;
    const StepResult<dim> &result;
    /** What was prescribed, at last. */
    const NodalConstraints &constraints;
    /** What is tied, and from points_moved() on what ties carry. */
    const DiscreteExtension<dim> &ties;
    bool                          is_last; ///< it ends the run
    /** How many negative pivots of displacements the matrix has, below 0 if
     * that isn't known. */
    long n_unstable_modes;
    /** How an iterative solver has failed in this step, empty if none has. */
    const std::string &failure_of_iterations;
    /** Once the points have moved, in the u-p form: by point, in the order of
     * step.points, θ^e - p/K. */
    const std::vector<double> &volume_excess;
    /** Once the points have moved, without inertia. */
    const Softening &softening;
  };

  /**
   * Interface of what looks at a scene, or at its results, and warns. It reads
   * and writes nothing but warnings: results are the same without it. To add
   * one, write `source/diagnosis/<name>.cc` with a class that overrides the
   * moments at which it looks, and ends with ISOCHOR_REGISTER_DIAGNOSIS, which
   * has the longer text of its warning.
   */
  template <int dim>
  class Diagnosis
  {
  public:
    virtual ~Diagnosis() = default;

    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}

    /** The parameters @p prm have been read. */
    virtual void
    scene_read(const ParameterHandler & /*prm*/,
               const Scene<dim> & /*scene*/,
               const GridReset<dim> & /*reset*/)
    {}

    /** The first step of a run that isn't resumed has its @p matrix, the
     * first one that is assembled. Collective. */
    virtual void
    step_set_up(const Scene<dim> & /*scene*/,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/)
    {}

    /** The grid has been reset, and the equations have these @p elements.
     * @p is_kept: the grid isn't reset before each step. Collective. */
    virtual void
    grid_reset(const Scene<dim> & /*scene*/,
               const StepContext<dim> & /*step*/,
               const ElementNodes & /*elements*/,
               const bool /*is_kept*/)
    {}

    /** A step, or another try at it, begins with what is prescribed by
     * @p constraints. Collective. */
    virtual void
    step_started(const Scene<dim> & /*scene*/,
                 const StepContext<dim> & /*step*/,
                 const NodalConstraints & /*constraints*/)
    {}

    /** The step has converged, the points haven't moved yet. Collective. */
    virtual void
    step_converged(const ConvergedStep<dim> & /*step*/)
    {}

    /** The points have moved. Collective. */
    virtual void
    points_moved(const ConvergedStep<dim> & /*step*/)
    {}

    /** Conditions, the grid and post-processors have followed. Collective. */
    virtual void
    step_ended(const ConvergedStep<dim> & /*step*/)
    {}

    /** A step has failed that can't be cut back further: a hint that goes into
     * the error, or nothing. */
    virtual std::string
    run_failed() const
    {
      return "";
    }

    /** The run has ended: a line for the terminal, or nothing. */
    virtual std::string
    run_ended() const
    {
      return "";
    }

    /** What a checkpoint has to hold, without blanks at the ends. */
    virtual std::string
    save_state() const
    {
      return "";
    }
    virtual void
    load_state(const std::string & /*state*/)
    {}

    std::string name;               ///< as it is registered
    Warnings   *warnings = nullptr; ///< where it warns

  protected:
    /** Warn. @p what stands for what is in angle brackets in the name. */
    void
    warn(const std::string &text, const std::string &what = "") const
    {
      warnings->add(what.empty() ?
                      name :
                      name.substr(0, name.find('<')) + "<" + what + ">",
                    text);
    }
  };
} // namespace isochor

/** Register the class template @p Class, the Diagnosis of the warning @p name.
 * The other arguments are those of Explanation. */
#define ISOCHOR_REGISTER_DIAGNOSIS(Class, name, is_essential, when, remedy) \
  ISOCHOR_REGISTER_FOR_DIMENSION(Diagnosis, Class, name)                    \
  ISOCHOR_EXPLAIN(Class, name, is_essential, when, remedy)

#endif
