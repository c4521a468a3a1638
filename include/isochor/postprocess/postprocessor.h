/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_postprocessor_h
#define isochor_postprocessor_h

#include <isochor/base/named_plugin.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/base/statistics.h>
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/equations/equation_term.h>
#include <isochor/nonlinear_solver/load_stepping.h>
#include <isochor/nonlinear_solver/newton_solver.h>

#include <memory>
#include <vector>

namespace isochor
{
  /** What is known at the end of a step. */
  template <int dim>
  struct StepResult
  {
    const StepContext<dim> &step;
    /** Displacement increments and pressure at the active nodes, ghosts
     * updated. */
    const NodalField &unknowns;
    /** Residual at the active nodes: the reaction where constrained. */
    const MixedSystem<dim>    &system;
    const MaterialPoints<dim> &points;
    const LoadStepping        &time;
    const NewtonReport        &newton;
    const std::string         &output_directory;
    /** What loads and moves the body. */
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions;
    /** What prescribed motions that jump have done in the moment in which the
     * step begins (J), this rank's part. */
    const double work_of_jump = 0;
    /** The unknowns at the start of the step that its first forces were those
     * of; null in statics and where forces are carried. */
    const NodalField *start = nullptr;
    /** What the stabilisation stores in dynamics (J), of all ranks. */
    const double subscale_energy = 0;
  };

  /**
   * Interface of what looks at the results. To add one, write
   * `source/postprocess/<name>.cc` with the class and its registration. Its
   * parameters live in the subsection "Postprocess".
   */
  template <int dim>
  class Postprocessor : public NamedPlugin
  {
  public:
    Postprocessor()
      : NamedPlugin("Postprocess")
    {}
    virtual ~Postprocessor() = default;

    /** For those that have none. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** The parameters, by path, that a resumed run may set anew. */
    static std::vector<std::string>
    changeable_parameters()
    {
      return {"Postprocess/", "Postprocess: "};
    }

    /** Once, after the grid is made and the points are seeded. */
    virtual void
    initialize(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** The grid has been replaced (BackgroundGrid::change()): cells and
     * vertices have other numbers. */
    virtual void
    grid_changed(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** The cells have got other owners (BackgroundGrid::set_owners()), with the
     * numbers that they had, and so have the vertices: bring what is kept by
     * rank to where it belongs now. Collective. */
    virtual void
    owners_changed(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** The first step is set up. @throws ExcMessage for what can't be meant.
     * Collective. */
    virtual void
    check_scene(const StepContext<dim> & /*step*/) const
    {}

    /** The step has converged; the nodes still hold the solution and the
     * points are where they were at its start. Collective. */
    virtual void
    evaluate_nodes(const StepResult<dim> & /*result*/,
                   Statistics & /*statistics*/)
    {}

    /** The points have moved; the nodal values are gone, the grid is back in
     * place. Collective. */
    virtual void
    evaluate_points(const StepResult<dim> & /*result*/,
                    Statistics & /*statistics*/)
    {}

    /** What has to survive a restart, as text. */
    virtual std::string
    save_state() const
    {
      return {};
    }
    virtual void
    load_state(const std::string & /*state*/)
    {}
  };
} // namespace isochor

#endif
