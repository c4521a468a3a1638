/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_points/mean_state.h>

namespace isochor
{
  template <int dim>
  void
  mean_state(const double                                           *first,
             const double                                           *second,
             const Tensor<2, dim>                                   &F,
             const PointLayout                                      &l,
             const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials,
             std::vector<double>                                    &properties)
  {
    // shares of masses and of current volumes
    const double mass = first[l.mass] + second[l.mass],
                 m    = mass > 0 ? second[l.mass] / mass : 0.5;
    const auto volume = [&](const double *values) {
      return values[l.volume] *
             determinant(deformation_gradient<dim>(values, l));
    };
    const double v = volume(second) / (volume(first) + volume(second));
    const auto   mean =
      [&](const unsigned int begin, const unsigned int n, const double share) {
        for (unsigned int i = begin; i < begin + n; ++i)
          properties[i] = (1 - share) * first[i] + share * second[i];
      };
    properties.assign(first, first + l.n_properties);
    properties[l.volume] = first[l.volume] + second[l.volume];
    properties[l.mass]   = mass;
    mean(l.displacement, dim, m);
    mean(l.pressure, 1, v);
    if (l.mixed())
      {
        const auto at_start = [&](const double *values) {
          return values[l.volume] / (1 + values[l.volume_gain]);
        };
        properties[l.volume_gain] =
          properties[l.volume] / (at_start(first) + at_start(second)) - 1;
      }
    mean(l.stress, n_symmetric_components<dim>, v);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        properties[l.F + i * dim + j] = F[i][j];
    if (l.dynamic)
      {
        mean(l.velocity, dim, m);
        mean(l.acceleration, dim, m);
      }
    if (l.with_excess)
      mean(l.excess, dim, m);
    if (l.n_history > 0)
      {
        const MaterialModel<dim> &material =
          *materials[static_cast<unsigned int>(first[l.material])];
        std::vector<double> a(first + l.history,
                              first + l.history + l.n_history),
          b(second + l.history, second + l.history + l.n_history);
        material.to_mean_values(a.data());
        material.to_mean_values(b.data());
        for (unsigned int i = 0; i < l.n_history; ++i)
          a[i] = (1 - v) * a[i] + v * b[i];
        material.from_mean_values(a.data());
        std::copy(a.begin(), a.end(), properties.begin() + l.history);
      }
    // the smaller of the sizes that are asked for; 0: none
    if (!l.with_cell_size)
      return;
    double &size = properties[l.cell_size];
    if (size == 0 || (second[l.cell_size] > 0 && second[l.cell_size] < size))
      size = second[l.cell_size];
  }



  template void
  mean_state(const double *,
             const double *,
             const Tensor<2, 2> &,
             const PointLayout &,
             const std::vector<std::unique_ptr<MaterialModel<2>>> &,
             std::vector<double> &);
  template void
  mean_state(const double *,
             const double *,
             const Tensor<2, 3> &,
             const PointLayout &,
             const std::vector<std::unique_ptr<MaterialModel<3>>> &,
             std::vector<double> &);
} // namespace isochor
