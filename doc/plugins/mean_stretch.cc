/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/postprocess/postprocessor.h>

namespace isochor
{
  /** The mean of F_xx and F_yy over the body, as columns of the statistics. */
  template <int dim>
  class MeanStretch : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Mean stretch",
                        "false",
                        Patterns::Bool(),
                        "Whether the statistics show the mean of F_xx and "
                        "F_yy.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      is_wanted = prm.get_bool("Mean stretch");
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      if (!is_wanted)
        return;
      const PointLayout    &layout = result.points.layout();
      std::array<double, 3> sums{}; // V_0, V_0 F_xx, V_0 F_yy
      for (const auto &point : result.points.handler())
        {
          const auto   properties = point.get_properties();
          const double V_0        = properties[layout.volume];
          const auto   F = deformation_gradient<dim>(properties.data(), layout);
          sums[0] += V_0;
          sums[1] += V_0 * F[0][0];
          sums[2] += V_0 * F[1][1];
        }
      sum_over_ranks(sums, result.step.grid.communicator());
      statistics.set("Mean stretch x", sums[1] / sums[0]);
      statistics.set("Mean stretch y", sums[2] / sums[0]);
    }

  private:
    bool is_wanted = false;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, MeanStretch, "Mean stretch")
} // namespace isochor
