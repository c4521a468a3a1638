/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/boundary_condition/boundary_condition.h>

#include <algorithm>

namespace isochor
{
  /**
   * In a body of revolution, nodes on the axis stay there: u_r = 0. Nothing
   * else is special about them, since no point lies on the axis.
   */
  template <int dim>
  class AxisOfSymmetry : public BoundaryCondition<dim>,
                         public ConstrainsNodes<dim>
  {
  public:
    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      double largest = 0;
      for (const Point<dim> &vertex : grid.geometry().vertices())
        largest = std::max(largest, vertex[0]);
      rounding = 1e-12 * largest;
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      if (!step.kernel.axisymmetric)
        return;
      const auto &vertices = step.grid.geometry().vertices();
      for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
        if (!step.nodes.control_node(node) &&
            vertices[step.nodes.vertex(node)][0] <= rounding)
          constraints.constrain(node * step.n_components, 0.);
    }

  private:
    double rounding = 0; ///< of r on the axis (m)
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 AxisOfSymmetry,
                                 "Axis of symmetry")
} // namespace isochor
