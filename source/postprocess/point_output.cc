/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/field_output.h>
#include <isochor/postprocessor.h>
#include <isochor/tensor_tools.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  /**
   * The material points as files for ParaView, at the output times: where they
   * are and all they carry. Values that a point's material doesn't have, as the
   * history of another one, are NaN.
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
                        "times, as points.pvd and what it lists.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      enabled = prm.get_bool("Write material points");
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics & /*statistics*/) override
    {
      if (!enabled || !result.time.output_due())
        return;
      FieldPatches<0, dim> patches;
      const Rows           rows    = declare_fields(patches, result);
      const auto          &handler = result.points.handler();
      patches.reserve(handler.n_locally_owned_particles());
      for (const auto &particle : handler)
        {
          const Point<dim> &x = particle.get_location();
          auto &patch = patches.add_patch(ArrayView<const Point<dim>>(&x, 1));
          patch.data(rows.id, 0) = particle.get_id();
          copy_point(particle.get_properties().data(),
                     result.points.layout(),
                     rows,
                     patch.data);
        }
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
    /** The rows of the fields in a patch. */
    struct Rows
    {
      unsigned int id, material, displacement, F, J, stress, pressure, volume,
        velocity, acceleration;
      /** First of the history, number of names, and for each material the row
       * of each history variable. */
      unsigned int                           first_history, n_history;
      std::vector<std::vector<unsigned int>> history;
    };

    static Rows
    declare_fields(FieldPatches<0, dim> &patches, const StepResult<dim> &result)
    {
      Rows rows{};
      rows.id           = patches.add_scalar("id");
      rows.material     = patches.add_scalar("material_id");
      rows.displacement = patches.add_vector("displacement");
      rows.F            = patches.add_tensor("deformation_gradient");
      rows.J            = patches.add_scalar("J");
      for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
        {
          const unsigned int row =
            patches.add_scalar("cauchy_stress_" + symmetric_component_name(i));
          if (i == 0)
            rows.stress = row;
        }
      rows.pressure = patches.add_scalar("pressure");
      rows.volume   = patches.add_scalar("volume");
      if (result.points.layout().dynamic)
        {
          rows.velocity     = patches.add_vector("velocity");
          rows.acceleration = patches.add_vector("acceleration");
        }
      declare_history(patches, result.step.kernel, rows);
      return rows;
    }

    /** One field for each name; materials may share it. */
    static void
    declare_history(FieldPatches<0, dim>   &patches,
                    const MixedKernel<dim> &kernel,
                    Rows                   &rows)
    {
      std::vector<std::string>  names;
      std::vector<unsigned int> row_of_name;
      for (const auto &material : kernel.materials)
        {
          rows.history.emplace_back();
          for (const std::string &name : material->history_names())
            {
              const auto known = std::find(names.begin(), names.end(), name);
              const unsigned int index = known - names.begin();
              if (known == names.end())
                {
                  names.push_back(name);
                  row_of_name.push_back(patches.add_scalar(name));
                }
              rows.history.back().push_back(row_of_name[index]);
            }
        }
      rows.n_history     = names.size();
      rows.first_history = names.empty() ? 0 : row_of_name[0];
    }

    static void
    copy_point(const double      *properties,
               const PointLayout &layout,
               const Rows        &rows,
               Table<2, float>   &data)
    {
      const auto copy = [&](const unsigned int row,
                            const unsigned int first,
                            const unsigned int n) {
        for (unsigned int i = 0; i < n; ++i)
          data(row + i, 0) = properties[first + i];
      };
      copy(rows.material, layout.material, 1);
      copy(rows.displacement, layout.displacement, dim);
      copy(rows.stress, layout.stress, n_symmetric_components<dim>);
      copy(rows.pressure, layout.pressure, 1);
      if (layout.dynamic)
        {
          copy(rows.velocity, layout.velocity, dim);
          copy(rows.acceleration, layout.acceleration, dim);
        }

      const Tensor<2, dim> F = deformation_gradient<dim>(properties, layout);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          data(rows.F + 3 * i + j, 0) =
            (i < dim && j < dim) ? F[i][j] : (i == j ? 1. : 0.);
      const double J       = determinant(F);
      data(rows.J, 0)      = J;
      data(rows.volume, 0) = J * properties[layout.volume];

      for (unsigned int i = 0; i < rows.n_history; ++i)
        data(rows.first_history + i, 0) =
          std::numeric_limits<float>::quiet_NaN();
      const auto &history =
        rows.history[static_cast<unsigned int>(properties[layout.material])];
      for (unsigned int i = 0; i < history.size(); ++i)
        data(history[i], 0) = properties[layout.history + i];
    }

    bool         enabled = true;
    OutputSeries series{"points"};
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor,
                                 PointOutput,
                                 "Write material points")
} // namespace isochor
