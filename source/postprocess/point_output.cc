/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/postprocess/field_output.h>
#include <isochor/postprocess/point_fields.h>
#include <isochor/postprocess/postprocessor.h>

namespace isochor
{
  /**
   * The material points as files for ParaView, at the output times: where they
   * are and all they carry.
   */
  template <int dim>
  class PointOutput : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Write material points",
                        "true",
                        Patterns::Bool(),
                        "Whether the material points are written at the output "
                        "times, as points.pvd and what it lists; in a section "
                        "'Postprocess: name' as points-name.pvd.");
      prm.declare_entry("Output times per points",
                        "1",
                        Patterns::Integer(1),
                        "Write the material points at every second, third, ... "
                        "output time only, and at the end.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      enabled = prm.get_bool("Write material points");
      series  = OutputSeries("points",
                            this->instance,
                            prm.get_integer("Output times per points"));
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics & /*statistics*/) override
    {
      if (!enabled || !result.time.output_due() ||
          !series.takes_next(result.time.finished()))
        return;
      FieldPatches<0, dim> patches =
        point_fields(result.points, result.step.kernel);
      series.write(patches,
                   result.time.time,
                   result.output_directory,
                   result.step.grid.communicator());
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
    OutputSeries series{"points"};
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor,
                                 PointOutput,
                                 "Write material points")
} // namespace isochor
