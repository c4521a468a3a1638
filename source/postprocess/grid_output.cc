/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/postprocess/field_output.h>
#include <isochor/postprocess/grid_fields.h>
#include <isochor/postprocess/postprocessor.h>

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
                        "and what it lists; in a section 'Postprocess: name' "
                        "as grid-name.pvd.");
      prm.declare_entry("Output times per grid",
                        "1",
                        Patterns::Integer(1),
                        "Write the grid at every second, third, ... output "
                        "time only, and at the end.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      enabled = prm.get_bool("Write grid");
      series  = OutputSeries("grid",
                            this->instance,
                            prm.get_integer("Output times per grid"));
    }

    void
    evaluate_nodes(const StepResult<dim> &result,
                   Statistics & /*statistics*/) override
    {
      if (!enabled || !result.time.next_output_due() ||
          !series.takes_next(result.time.next_time() >= result.time.end_time()))
        return;
      const StepContext<dim> &step    = result.step;
      FieldPatches<dim, dim>  patches = grid_fields(step, result.unknowns);
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
