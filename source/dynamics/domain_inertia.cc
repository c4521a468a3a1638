/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/domain_inertia.h>

namespace isochor
{
  template <int dim>
  void
  DomainInertia<dim>::find(const StepContext<dim> &step)
  {
    const PointArrays<dim> &points = step.points;
    step.nodes.initialize(diagonal, 1);
    inertia.clear();
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        // of a simplex: the second moment of its corners over (d + 1) (d + 2)
        SymmetricTensor<2, dim> C;
        for (const Tensor<1, dim> &corner : points.domain[q])
          {
            const Tensor<1, dim> r = points.F[q] * corner;
            C += symmetrize(outer_product(r, r));
          }
        C *= points.mass[q] / ((dim + 1) * (dim + 2));
        inertia.push_back(C);
        const auto stencil = points.stencil(step.grid.geometry(), 0, q);
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          diagonal.local_element(step.nodes.node(stencil.vertex[I])) +=
            stencil.gradient[I] * (C * stencil.gradient[I]);
      }
    diagonal.compress(VectorOperation::add);
  }



  template <int dim>
  void
  DomainInertia<dim>::add_product(const StepContext<dim> &step,
                                  const NodalField       &field,
                                  NodalField             &result) const
  {
    const double *const x = field.begin();
    double *const       y = result.begin();
    for (unsigned int q = 0; q < inertia.size(); ++q)
      {
        const auto stencil = step.points.stencil(step.grid.geometry(), 0, q);
        Tensor<2, dim> gradient;
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          {
            const double *const nodal =
              x + step.nodes.node(stencil.vertex[I]) * dim;
            for (unsigned int a = 0; a < dim; ++a)
              gradient[a] += nodal[a] * stencil.gradient[I];
          }
        const SymmetricTensor<2, dim> force = symmetrize(
          Tensor<2, dim>(symmetrize(gradient)) * Tensor<2, dim>(inertia[q]));
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          {
            double *const nodal = y + step.nodes.node(stencil.vertex[I]) * dim;
            for (unsigned int a = 0; a < dim; ++a)
              nodal[a] += (force * stencil.gradient[I])[a];
          }
      }
  }



  template class DomainInertia<2>;
  template class DomainInertia<3>;
} // namespace isochor
