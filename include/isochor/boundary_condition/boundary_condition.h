/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_boundary_condition_h
#define isochor_boundary_condition_h

#include <isochor/base/named_plugin.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/base/statistics.h>
#include <isochor/boundary_condition/condition_roles.h>
#include <isochor/equations/equation_term.h>
#include <isochor/material_points/body_shape.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * Interface of the boundary conditions and loads. To add one, write
   * `source/boundary_condition/<name>.cc` with the class and its registration.
   * What it does beyond loads are roles of their own, which it has as further
   * base classes, see condition_roles.h: to constrain nodes, to have unknowns,
   * to act by what it assembles.
   * Its parameters live in the subsection "Boundary conditions"; a condition
   * whose parameters are left empty does nothing.
   */
  template <int dim>
  class BoundaryCondition : public EquationTerm<dim>, public NamedPlugin
  {
  public:
    BoundaryCondition()
      : NamedPlugin("Boundary conditions")
    {}

    /** For those that have none. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** Look up boundary names and the like, after the grid is made; and again
     * when it has been replaced, unless grid_changed() does something else. */
    virtual void
    initialize(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** The grid has been replaced (BackgroundGrid::change()): cells and
     * vertices have other numbers. @p at_start: there was no step yet. By
     * default initialize() is called once more. Collective. */
    virtual void
    grid_changed(const BackgroundGrid<dim> &grid, const bool /*at_start*/)
    {
      initialize(grid);
    }

    /** For conditions on the body: where it is at t = 0, and its points, which
     * are set up anew before touch_vertices() is called. Both outlive this
     * object. Once, before initialize(). */
    virtual void
    set_body(const BodyShape<dim> & /*shape*/,
             const PointArrays<dim> & /*points*/)
    {}

    /** The first step is set up: what it acts on, in lines for the terminal, if
     * the parameters alone don't say it. The same on all ranks. */
    virtual std::string
    describe() const
    {
      return {};
    }

    /** The first step is set up. @throws ExcMessage for what can't be meant.
     * Collective. */
    virtual void
    check_scene(const StepContext<dim> & /*step*/) const
    {}

    /** Add the dead loads at the end of the step (N) from this rank's cells,
     * entry n_components * node + component. */
    virtual void
    add_external_force(const StepContext<dim> & /*step*/,
                       NodalField & /*force*/) const
    {}

    /** The part of the dead loads that acts on all mass alike (m/s²), at
     * @p time. The stabilisation of the pressure leaves out what is in
     * equilibrium with it. */
    virtual Tensor<1, dim>
    body_acceleration(const double /*time*/) const
    {
      return {};
    }

    /** The step has converged: set columns of the statistics. Collective. */
    virtual void
    evaluate(const StepContext<dim> & /*step*/,
             const NodalField & /*unknowns*/,
             const MixedSystem<dim> & /*system*/,
             const NodalConstraints & /*constraints*/,
             Statistics & /*statistics*/) const
    {}

    /** The step has converged: follow the body. Collective. */
    virtual void
    advance(const StepContext<dim> & /*step*/, const NodalField & /*unknowns*/)
    {}

    /** What has to survive a restart, the same text on all ranks. Collective.
     */
    virtual std::string
    save_state() const
    {
      return {};
    }
    /** Called on all ranks, after initialize(). */
    virtual void
    load_state(const std::string & /*state*/)
    {}
  };



  /** What the @p conditions prescribe goes to @p constraints. */
  template <int dim>
  void
  constrain_nodes(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    const StepContext<dim>                                     &step,
    NodalConstraints                                           &constraints)
  {
    for (const auto &condition : conditions)
      if (const auto *const role =
            dynamic_cast<const ConstrainsNodes<dim> *>(condition.get()))
        {
          constraints.source = condition->name;
          role->constrain(step, constraints);
        }
  }
} // namespace isochor

#endif
