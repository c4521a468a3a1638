/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/expression.h>
#include <isochor/boundary_condition/boundary_condition.h>

namespace isochor
{
  /** Gravity: f_I = Σ_p N_I m_p g(t). */
  template <int dim>
  class Gravity : public BoundaryCondition<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Gravity",
                        "",
                        Patterns::Anything(),
                        "Acceleration of gravity (m/s^2), formulas in t: "
                        "'g_x, g_y(, g_z)'. As in all formulas, angles of "
                        "sin, cos and tan are in radians: '9.81*sin(0.349)' "
                        "for 20 degrees. Empty: none.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string name = this->parameter("Gravity");
      if (prm.get("Gravity").empty())
        return;
      for (const auto &item : split_formulas(prm.get("Gravity"), name))
        gravity.emplace_back(item, name, FormulaVariables::time);
      AssertThrow(gravity.size() == dim,
                  ExcMessage("The parameter <" + name + "> needs " +
                             std::to_string(dim) + " components."));
    }

    void
    check_scene(const StepContext<dim> &step) const override
    {
      double mass = 0;
      for (unsigned int q = 0; q < step.points.n_points(); ++q)
        mass = std::max<double>(mass, step.points.mass[q]);
      AssertThrow(gravity.empty() ||
                    Utilities::MPI::max(mass, step.grid.communicator()) > 0,
                  ExcMessage("The parameter <" + this->parameter("Gravity") +
                             "> has no effect, as <Material/Density> is 0. "
                             "Give it a density (kg/m^3)."));
    }

    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override
    {
      if (gravity.empty())
        return;
      const Tensor<1, dim> g = body_acceleration(step.time);
      AssertThrow(!step.kernel.axisymmetric || g[0] == 0.,
                  ExcMessage("The first component of <" +
                             this->parameter("Gravity") +
                             "> must be 0 with <Formulation/Geometry = "
                             "axisymmetric>: gravity has to act along the "
                             "axis."));
      const auto &points = step.points;
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const auto stencil = points.stencil(step.grid.geometry(), k, q);
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              for (unsigned int a = 0; a < dim; ++a)
                force.local_element(
                  step.nodes.node(stencil.vertex[I]) * step.n_components + a) +=
                  stencil.shape[I] * points.mass[q] * g[a];
          }
    }

    Tensor<1, dim>
    body_acceleration(const double time) const override
    {
      Tensor<1, dim> g;
      for (unsigned int a = 0; a < gravity.size(); ++a)
        g[a] = gravity[a](Point<dim>(), time);
      return g;
    }

  private:
    std::vector<Expression<dim>> gravity;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, Gravity, "Gravity")
} // namespace isochor
