/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/field_output.h>
#include <isochor/postprocessor.h>

#include <algorithm>

namespace isochor
{
  /**
   * The cells of the grid that hold material, as files for ParaView, at the
   * output times: where they are during the step that ends there, with the
   * nodal solution of that step.
   */
  template <int dim>
  class GridOutput : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Write grid",
                        "true",
                        Patterns::Bool(),
                        "Whether the cells with material and the nodal "
                        "solution are written at the output times, as grid.pvd "
                        "and what it lists.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      enabled = prm.get_bool("Write grid");
    }

    void
    evaluate_nodes(const StepResult<dim> &result,
                   Statistics & /*statistics*/) override
    {
      if (!enabled || !result.time.next_output_due())
        return;
      const StepContext<dim>     &step     = result.step;
      const SimplexGeometry<dim> &geometry = step.grid.geometry();

      FieldPatches<dim, dim> patches;
      const unsigned int     displacement =
        patches.add_vector("displacement_increment");
      const unsigned int pressure =
        step.mixed() ? patches.add_scalar("pressure") : 0;
      patches.reserve(step.points.cell.size());
      std::array<Point<dim>, dim + 1> corners;
      for (unsigned int k = 0; k < step.points.cell.size(); ++k)
        {
          const auto &vertices = geometry.vertex_indices(step.points.cell[k]);
          if (std::any_of(vertices.begin(),
                          vertices.end(),
                          [&step](const unsigned int v) {
                            return step.nodes.node(v) ==
                                   numbers::invalid_unsigned_int;
                          }))
            continue; // the points' domains miss a node of the cell
          for (unsigned int v = 0; v <= dim; ++v)
            corners[v] = step.points.corner(geometry, k, v);
          auto &patch = patches.add_patch(
            ArrayView<const Point<dim>>(corners.data(), dim + 1));
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const unsigned int first =
                step.nodes.node(vertices[v]) * step.n_components;
              for (unsigned int a = 0; a < dim; ++a)
                patch.data(displacement + a, v) =
                  result.unknowns.local_element(first + a);
              if (step.mixed())
                patch.data(pressure, v) =
                  result.unknowns.local_element(first + dim);
            }
        }
      series.write(patches,
                   step.time,
                   result.output_directory,
                   step.grid.communicator());
    }

    std::string
    save_state() const override
    {
      return series.save_state();
    }

    void
    load_state(const std::string &state) override
    {
      series.load_state(state);
    }

  private:
    bool         enabled = true;
    OutputSeries series{"grid"};
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, GridOutput, "Write grid")
} // namespace isochor
