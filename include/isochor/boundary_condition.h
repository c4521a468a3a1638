/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_boundary_condition_h
#define isochor_boundary_condition_h

#include <isochor/equation_term.h>
#include <isochor/plugin_registry.h>

namespace isochor
{
  /**
   * Interface of the boundary conditions and loads. To add one, write
   * `source/boundary_condition/<name>.cc` with the class and its registration.
   * Its parameters live in the subsection "Boundary conditions"; a condition
   * whose parameters are left empty does nothing.
   */
  template <int dim>
  class BoundaryCondition : public EquationTerm<dim>
  {
  public:
    virtual void
    parse_parameters(ParameterHandler &prm) = 0;

    /** Look up boundary names and the like; once, after the grid is made. */
    virtual void
    initialize(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** Prescribe increments of nodal unknowns over the step. */
    virtual void
    constrain(const StepContext<dim> & /*step*/,
              NodalConstraints & /*constraints*/) const
    {}

    /** Add the dead loads at the end of the step (N) from this rank's cells,
     * entry n_components * node + component. */
    virtual void
    add_external_force(const StepContext<dim> & /*step*/,
                       NodalField & /*force*/) const
    {}
  };
} // namespace isochor

#endif
