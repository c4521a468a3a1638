/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/transfer/volume_offset.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** The part of its elastic shear strain that a point remembers through a
     * step; @p stress_n is its Cauchy stress at the start. */
    template <int dim>
    double
    memory_of_step(const MaterialModel<dim>                    &material,
                   const Kinematics<dim>                       &increment,
                   const SymmetricTensor<2, 3>                 &stress_n,
                   const typename MixedKernel<dim>::PointState &state)
    {
      Assert(increment.hoop_increment > 0, ExcInternalError());
      if (!material.dissipates())
        return 1;
      Tensor<2, 3> F               = unit_symmetric_tensor<3>(), l;
      F[2][2]                      = increment.hoop_increment;
      l[2][2]                      = 1 - 1 / increment.hoop_increment;
      const Tensor<2, dim> inverse = invert(increment.F_increment);
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          {
            F[a][b] = increment.F_increment[a][b];
            l[a][b] = (a == b ? 1 : 0) - inverse[a][b];
          }
      // the stress at the start, carried along, and that at the end
      const SymmetricTensor<2, 3> before = state.J *
                                           std::pow(determinant(F), -5. / 3) *
                                           deviator(symmetrize(
                                             F * Tensor<2, 3>(stress_n) *
                                             transpose(F))),
                                  after =
                                    state.J * deviator(state.cauchy_stress);
      const double two_G   = 2 * material.shear_modulus(),
                   elastic = after.norm() / two_G,
                   plastic =
                     (deviator(symmetrize(l)) - (after - before) / two_G)
                       .norm();
      return plastic > 0 ? elastic / (elastic + plastic) : 1;
    }
  } // namespace



  template <int dim>
  void
  VolumeOffset<dim>::start(const StepContext<dim> &step)
  {
    unseen.assign(step.points.weight.size(), 0.);
  }



  template <int dim>
  void
  VolumeOffset<dim>::set(const StepContext<dim>                      &step,
                         const unsigned int                           q,
                         const double                                 excess,
                         const Kinematics<dim>                       &increment,
                         const typename MixedKernel<dim>::PointState &state,
                         const PointLayout                           &layout,
                         const ArrayView<double> &properties)
  {
    AssertIndexRange(q, unseen.size());
    unseen[q]      = excess;
    double &memory = properties[layout.memory()];
    memory =
      (step.grid_is_kept ? memory : 1.) *
      memory_of_step<dim>(*step.kernel.materials[step.points.material[q]],
                          increment,
                          load_symmetric<dim>(&properties[layout.stress]),
                          state);
  }



  template <int dim>
  template <typename Value>
  void
  VolumeOffset<dim>::sum_to_nodes(const StepContext<dim> &step,
                                  const Value            &value,
                                  NodalField             &sums) const
  {
    step.nodes.initialize(sums, 1);
    const PointArrays<dim> &points = step.points;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto   stencil  = points.stencil(step.grid.geometry(), k, q);
          const double weighted = points.measure(q) * value(q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            sums.local_element(step.nodes.node(stencil.vertex[I])) +=
              stencil.shape[I] * weighted;
        }
    sums.compress(VectorOperation::add);
  }



  template <int dim>
  double
  VolumeOffset<dim>::mean_at(const StepContext<dim> &step,
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
  VolumeOffset<dim>::apply(const StepContext<dim> &step,
                           MaterialPoints<dim>    &points)
  {
    Assert(step.mixed(), ExcMessage("There are no pressures."));
    const auto &materials = step.kernel.materials;
    if (std::none_of(materials.begin(), materials.end(), [](const auto &m) {
          return m->dissipates();
        }))
      return; // all remember everything
    // means of hat functions don't have the moments of what they are taken of:
    // Chebyshev's iteration, the eigenvalues of P1 being 1/(dim + 2) to 1
    constexpr unsigned int  n_passes = 6;
    constexpr double        smallest = 1. / (dim + 2);
    const PointArrays<dim> &arrays   = step.points;
    sum_to_nodes(
      step, [](const unsigned int) { return 1.; }, weight);
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      {
        const double root =
          std::cos(numbers::PI * (pass + 0.5) / n_passes) * (1 - smallest) / 2 +
          (1 + smallest) / 2;
        sum_to_nodes(
          step, [&](const unsigned int q) { return unseen[q]; }, mean);
        for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
          if (weight.local_element(node) > 0)
            mean.local_element(node) /= weight.local_element(node);
        mean.update_ghost_values();
        for (unsigned int k = 0; k < arrays.n_occupied_cells; ++k)
          for (unsigned int q = arrays.cell_start[k];
               q < arrays.cell_start[k + 1];
               ++q)
            unseen[q] -= mean_at(step, k, q) / root;
      }
    const PointLayout &l = points.layout();
    points.for_each([&](const unsigned int /*k*/,
                        const unsigned int q,
                        Point<dim> & /*location*/,
                        ArrayView<double> properties) {
      properties[l.volume_offset] += (1 - properties[l.memory()]) * unseen[q];
    });
  }



  template class VolumeOffset<2>;
  template class VolumeOffset<3>;
} // namespace isochor
