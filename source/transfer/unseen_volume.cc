/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_model/plastic_strain.h>
#include <isochor/material_points/domain_relaxation.h>
#include <isochor/transfer/unseen_volume.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  UnseenVolume<dim>::start(const StepContext<dim> &step)
  {
    unseen.assign(step.points.weight.size(), 0.);
    plastic_strain = entries_of_plastic_strain<dim>(step.kernel.materials);
  }



  template <int dim>
  void
  UnseenVolume<dim>::set(const StepContext<dim>                      &step,
                         const unsigned int                           q,
                         const double                                 excess,
                         const typename MixedKernel<dim>::PointState &state,
                         const double *const                          history)
  {
    AssertIndexRange(q, unseen.size());
    const unsigned int i     = step.points.material[q];
    const unsigned int entry = plastic_strain[i];
    if (entry == numbers::invalid_unsigned_int)
      return; // it remembers everything
    const auto         &material = *step.kernel.materials[i];
    const double *const before =
      step.points.history.data() + q * std::size_t(step.points.n_history);
    const double memory =
      kept_shear_strain(material.shear_modulus(),
                        state.J * deviator(state.cauchy_stress).norm(),
                        history[entry] - before[entry]);
    // of the volume, whatever the measure of its change
    const double relative =
      material.volumetric_measure() == VolumetricMeasure::logarithmic ?
        std::expm1(excess) :
        excess;
    unseen[q] = (1 - memory) * relative;
  }



  template <int dim>
  double
  UnseenVolume<dim>::measure(const PointArrays<dim> &points,
                             const unsigned int      q)
  {
    // what passes between domains is what they have, whatever they integrate
    return points.domain.empty() ? points.measure(q) :
                                   points.volume[q] * points.thickness(q);
  }



  template <int dim>
  template <typename Value>
  void
  UnseenVolume<dim>::sum_to_nodes(const StepContext<dim> &step,
                                  const Value            &value,
                                  NodalField             &sums) const
  {
    step.nodes.initialize(sums, 1);
    const PointArrays<dim> &points = step.points;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto   stencil  = points.stencil(step.grid.geometry(), k, q);
          const double weighted = value(q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            sums.local_element(step.nodes.node(stencil.vertex[I])) +=
              stencil.shape[I] * weighted;
        }
    sums.compress(VectorOperation::add);
  }



  template <int dim>
  double
  UnseenVolume<dim>::mean_at(const StepContext<dim> &step,
                             const unsigned int      k,
                             const unsigned int      q) const
  {
    AssertIndexRange(k, step.points.cell.size());
    AssertIndexRange(q, step.points.n_points());
    const auto stencil = step.points.stencil(step.grid.geometry(), k, q);
    double     sum     = 0;
    for (unsigned int I = 0; I < stencil.n_nodes; ++I)
      sum += stencil.shape[I] *
             mean.local_element(step.nodes.node(stencil.vertex[I]));
    return sum;
  }



  template <int dim>
  void
  UnseenVolume<dim>::leave_out_seen(const StepContext<dim> &step)
  {
    // means of hat functions don't have the moments of what they are taken of:
    // Chebyshev's iteration, the eigenvalues of P1 being 1/(dim + 2) to 1. The
    // last pass leaves nothing in the sum over all points.
    constexpr unsigned int  n_passes = 6;
    constexpr double        smallest = 1. / (dim + 2);
    const PointArrays<dim> &arrays   = step.points;
    sum_to_nodes(
      step, [&](const unsigned int q) { return measure(arrays, q); }, weight);
    for (unsigned int pass = 0; pass <= n_passes; ++pass)
      {
        const double root = pass == n_passes ?
                              1. :
                              std::cos(numbers::PI * (pass + 0.5) / n_passes) *
                                  (1 - smallest) / 2 +
                                (1 + smallest) / 2;
        sum_to_nodes(
          step,
          [&](const unsigned int q) { return measure(arrays, q) * unseen[q]; },
          mean);
        divide_by_weight(step);
        for (unsigned int k = 0; k < arrays.cell.size(); ++k)
          for (unsigned int q = arrays.cell_start[k];
               q < arrays.cell_start[k + 1];
               ++q)
            unseen[q] -= mean_at(step, k, q) / root;
      }
  }



  template <int dim>
  void
  UnseenVolume<dim>::apply(const StepContext<dim> &step,
                           const bool              grid_is_reset,
                           MaterialPoints<dim>    &points,
                           PointArrays<dim>       &of_step)
  {
    Assert(step.mixed(), ExcMessage("There are no pressures."));
    const auto &materials = step.kernel.materials;
    if (std::none_of(materials.begin(), materials.end(), [](const auto &m) {
          return m->dissipates();
        }))
      return; // all remember everything
    leave_out_seen(step);
    const PointLayout  &l = points.layout();
    std::vector<double> mass;
    if (l.dynamic)
      points.for_each([&](const unsigned int /*k*/,
                          const unsigned int /*q*/,
                          Point<dim> & /*location*/,
                          ArrayView<double> properties) {
        mass.push_back(properties[l.mass]);
      });
    points.for_each([&](const unsigned int /*k*/,
                        const unsigned int q,
                        Point<dim> & /*location*/,
                        ArrayView<double> properties) {
      const auto &material =
        *materials[static_cast<unsigned int>(properties[l.material])];
      if (material.dissipates() && 1 + unseen[q] > 0)
        {
          fill_shape(1 + unseen[q], material, l, properties);
          if (l.with_domains)
            of_step.weight[q] *= 1 + unseen[q];
        }
    });
    // the functions of a grid that is kept are those of the domains as they are
    if (grid_is_reset)
      DomainRelaxation<dim>(points, step.grid, materials).relax();
    if (l.dynamic)
      keep_momentum(step, mass, points);
  }



  template <int dim>
  void
  UnseenVolume<dim>::keep_momentum(const StepContext<dim>    &step,
                                   const std::vector<double> &mass,
                                   MaterialPoints<dim>       &points)
  {
    const PointLayout    &l = points.layout();
    std::vector<double *> state(mass.size());
    points.for_each(
      [&](const unsigned int /*k*/,
          const unsigned int q,
          Point<dim> & /*location*/,
          ArrayView<double> properties) { state[q] = properties.data(); });
    sum_to_nodes(
      step, [&](const unsigned int q) { return state[q][l.mass]; }, weight);
    const PointArrays<dim> &arrays = step.points;
    for (const unsigned int field : l.vectors_by_mass())
      for (unsigned int d = field; d < field + dim; ++d)
        {
          sum_to_nodes(
            step,
            [&](const unsigned int q) {
              return (mass[q] - state[q][l.mass]) * state[q][d];
            },
            mean);
          divide_by_weight(step);
          for (unsigned int k = 0; k < arrays.cell.size(); ++k)
            for (unsigned int q = arrays.cell_start[k];
                 q < arrays.cell_start[k + 1];
                 ++q)
              state[q][d] += mean_at(step, k, q);
        }
  }



  template <int dim>
  void
  UnseenVolume<dim>::divide_by_weight(const StepContext<dim> &step)
  {
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      if (weight.local_element(node) > 0)
        mean.local_element(node) /= weight.local_element(node);
    mean.update_ghost_values();
  }



  template <int dim>
  void
  UnseenVolume<dim>::fill_shape(const double              factor,
                                const MaterialModel<dim> &material,
                                const PointLayout        &l,
                                const ArrayView<double>  &properties)
  {
    Assert(factor > 0, ExcInternalError());
    if (l.with_domains)
      {
        properties[l.volume] *= factor;
        properties[l.mass] *= factor;
        double &gain = properties[l.volume_gain];
        gain         = (1 + gain) * factor - 1;
      }
    for (unsigned int i = 0; i < dim * dim; ++i)
      properties[l.F + i] *= std::pow(factor, -1. / dim);
    material.scale_elastic_volume(1 / factor, &properties[l.history]);
  }



  template class UnseenVolume<2>;
  template class UnseenVolume<3>;
} // namespace isochor
