/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_test_simple_shear_h
#define isochor_test_simple_shear_h

#include <isochor/base/expression.h>
#include <isochor/boundary_condition/boundary_condition.h>

#include <memory>

namespace isochor
{
  /** Shears all active nodes: u_x = γ(t) y. */
  template <int dim>
  class SimpleShear : public BoundaryCondition<dim>, public ConstrainsNodes<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Shear", "", Patterns::Anything());
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      if (!prm.get("Shear").empty())
        shear = std::make_unique<Expression<dim>>(prm.get("Shear"), "Shear");
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      if (!shear)
        return;
      const double increment = (*shear)(Point<dim>(), step.time) -
                               (*shear)(Point<dim>(), step.old_time);
      for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
        for (unsigned int a = 0; a < dim; ++a)
          constraints.constrain(
            node * step.n_components + a,
            // the shear does not change the node's y
            a == 0 ?
              increment *
                step.grid.geometry().vertices()[step.nodes.vertex(node)][1] :
              0.);
    }

  private:
    std::unique_ptr<Expression<dim>> shear;
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, SimpleShear, "Shear")
} // namespace isochor

#endif
