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
   * The material points as files for ParaView, at the output times, with all
   * they carry: as points, and, if they have any, as their subdomains.
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
      prm.declare_entry("Write subdomains",
                        "true",
                        Patterns::Bool(),
                        "Whether the subdomains of the material points, if the "
                        "quadrature has them (CPDI), are written as triangles "
                        "or tetrahedra at the same times as the points, as "
                        "subdomains.pvd or subdomains-name.pvd: the body as a "
                        "mesh. Each corner has its displacement; all other "
                        "fields, von_mises_stress and mean_stress among them, "
                        "are constant within a subdomain.");
      prm.declare_entry("Output times per points",
                        "1",
                        Patterns::Integer(1),
                        "Write the material points and their subdomains at "
                        "every second, third, ... output time only, and at the "
                        "end.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const unsigned int interval = prm.get_integer("Output times per points");
      writes_points               = prm.get_bool("Write material points");
      writes_subdomains           = prm.get_bool("Write subdomains");
      points     = OutputSeries("points", this->instance, interval);
      subdomains = OutputSeries("subdomains", this->instance, interval);
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics & /*statistics*/) override
    {
      if (!result.time.output_due())
        return;
      if (writes_points)
        write<0>(result, points);
      if (writes_subdomains && result.points.layout().with_domains)
        write<dim>(result, subdomains);
    }

    std::string
    save_state() const override
    {
      return points.save_state() + separator + subdomains.save_state();
    }

    void
    load_state(const std::string &state) override
    {
      const auto end = state.find(separator);
      points.load_state(state.substr(0, end));
      if (end != std::string::npos)
        subdomains.load_state(state.substr(end + 1));
    }

  private:
    template <int patch_dim>
    static void
    write(const StepResult<dim> &result, OutputSeries &series)
    {
      if (!series.takes_next(result.time.finished()))
        return;
      auto patches = point_fields<patch_dim>(result.points, result.step.kernel);
      series.write(patches,
                   result.time.time,
                   result.output_directory,
                   result.step.grid.communicator());
    }

    static constexpr char separator = '|';

    bool         writes_points = true, writes_subdomains = true;
    OutputSeries points{"points"}, subdomains{"subdomains"};
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor,
                                 PointOutput,
                                 "Write material points")
} // namespace isochor
