/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/thickness.h>
#include <isochor/material_model/tensor_tools.h>
#include <isochor/material_points/point_domain.h>
#include <isochor/postprocess/point_fields.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  namespace
  {
    /** The rows of the fields in a patch. */
    struct Rows
    {
      unsigned int id, material, displacement, F, J, stress, mean_stress,
        von_mises, pressure, volume, velocity, acceleration, body;
      /** First of the history, number of names, and for each material the row
       * of each history variable. */
      unsigned int                           first_history, n_history;
      std::vector<std::vector<unsigned int>> history;
    };



    /** One field for each name; materials may share it. */
    template <int patch_dim, int dim>
    void
    declare_history(FieldPatches<patch_dim, dim> &patches,
                    const MixedKernel<dim>       &kernel,
                    Rows                         &rows)
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



    template <int patch_dim, int dim>
    Rows
    declare_fields(FieldPatches<patch_dim, dim> &patches,
                   const MaterialPoints<dim>    &points,
                   const MixedKernel<dim>       &kernel)
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
      rows.mean_stress = patches.add_scalar("mean_stress");
      rows.von_mises   = patches.add_scalar("von_mises_stress");
      rows.pressure    = patches.add_scalar("pressure");
      rows.volume      = patches.add_scalar("volume");
      if (points.layout().dynamic)
        {
          rows.velocity     = patches.add_vector("velocity");
          rows.acceleration = patches.add_vector("acceleration");
        }
      if (points.bodies().size() > 1)
        rows.body = patches.add_scalar("body");
      declare_history(patches, kernel, rows);
      return rows;
    }



    template <int dim>
    void
    copy_point(const double      *properties,
               const PointLayout &layout,
               const double       hoop,
               const double       thickness,
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
      const auto stress = load_symmetric<dim>(properties + layout.stress);
      data(rows.mean_stress, 0) = trace(stress) / 3;
      data(rows.von_mises, 0)   = std::sqrt(1.5) * deviator(stress).norm();
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
            (i < dim && j < dim) ? F[i][j] : (i == j ? hoop : 0.);
      const double J       = determinant(F) * hoop;
      data(rows.J, 0)      = J;
      data(rows.volume, 0) = J * properties[layout.volume] * thickness;

      for (unsigned int i = 0; i < rows.n_history; ++i)
        data(rows.first_history + i, 0) =
          std::numeric_limits<float>::quiet_NaN();
      const auto &history =
        rows.history[static_cast<unsigned int>(properties[layout.material])];
      for (unsigned int i = 0; i < history.size(); ++i)
        data(history[i], 0) = properties[layout.history + i];
    }
  } // namespace



  template <int patch_dim, int dim>
  FieldPatches<patch_dim, dim>
  point_fields(const MaterialPoints<dim> &points,
               const MixedKernel<dim>    &kernel)
  {
    static_assert(patch_dim == 0 || patch_dim == dim);
    Assert(patch_dim == 0 || points.layout().with_domains,
           ExcMessage("Points of this quadrature have no subdomains."));
    FieldPatches<patch_dim, dim> patches;
    const Rows                   rows = declare_fields(patches, points, kernel);
    const auto                  &handler = points.handler();
    std::vector<PointDomain<dim>> domains;
    if constexpr (patch_dim > 0)
      domains = point_domains(points);
    patches.reserve(handler.n_locally_owned_particles());
    for (const auto &particle : handler)
      {
        const Point<dim>           &x = particle.get_location();
        ArrayView<const Point<dim>> vertices(&x, 1);
        const PointDomain<dim>     *domain = nullptr;
        if constexpr (patch_dim > 0)
          {
            domain   = &domains[patches.n_patches()];
            vertices = {domain->current.data(), domain->current.size()};
          }
        auto &data       = patches.add_patch(vertices).data;
        data(rows.id, 0) = particle.get_id();
        if (points.bodies().size() > 1)
          data(rows.body, 0) = points.body_of(particle);
        const double *const properties = particle.get_properties().data();
        const double        hoop =
          kernel.hoop_stretch(properties + points.layout().history);
        copy_point<dim>(properties,
                        points.layout(),
                        hoop,
                        thickness(kernel.axisymmetric, x[0] / hoop),
                        rows,
                        data);
        for (unsigned int v = 1; v <= patch_dim; ++v)
          for (unsigned int row = 0; row < data.size(0); ++row)
            data(row, v) = data(row, 0);
        for (unsigned int v = 0; domain != nullptr && v <= dim; ++v)
          for (unsigned int d = 0; d < dim; ++d)
            data(rows.displacement + d, v) =
              domain->current[v][d] - domain->reference[v][d];
      }
    return patches;
  }



  template FieldPatches<0, 2>
  point_fields<0>(const MaterialPoints<2> &, const MixedKernel<2> &);
  template FieldPatches<2, 2>
  point_fields<2>(const MaterialPoints<2> &, const MixedKernel<2> &);
  template FieldPatches<0, 3>
  point_fields<0>(const MaterialPoints<3> &, const MixedKernel<3> &);
  template FieldPatches<3, 3>
  point_fields<3>(const MaterialPoints<3> &, const MixedKernel<3> &);
} // namespace isochor
