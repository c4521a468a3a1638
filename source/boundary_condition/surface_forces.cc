/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/thickness.h>
#include <isochor/boundary_condition/surface_forces.h>
#include <isochor/equations/nodal_unknowns.h>

namespace isochor
{
  template <int dim>
  double
  SurfaceForces<dim>::area(const StepContext<dim> &step,
                           const unsigned int      b) const
  {
    return thickness(step.kernel.axisymmetric,
                     points.reference_location(b)[0]) *
           points.reference_area(b).norm();
  }



  template <int dim>
  EvaluationStatus
  SurfaceForces<dim>::evaluate_point(const StepContext<dim> &step,
                                     const NodalField       &unknowns,
                                     const unsigned int      b,
                                     const bool              with_matrix,
                                     PointElement           &element) const
  {
    const double p =
      condition_at(b).pressure.front()(points.reference_location(b), step.time);
    const auto               nodes = points.stencil(b);
    const double *const      N     = nodes.shape;
    const NodalUnknowns<dim> nodal(step, unknowns);
    const Tensor<2, dim>     F_increment = nodal.deformation_at(nodes);
    element.reinit(nodes.n_nodes * step.n_components, with_matrix);
    // Nanson: a = det F F^{-T} A_0
    const Tensor<2, dim> F = F_increment * points.F(b);
    if (!(determinant(F) > 0) || !(determinant(F_increment) > 0))
      return EvaluationStatus::inverted_point;
    Tensor<1, dim> a = determinant(F) * (points.reference_area(b) * invert(F));
    // a ring of the radius at the end of the step
    const double radius =
      step.kernel.axisymmetric ?
        (points.reference_location(b) + points.displacement(b) +
         nodal.increment_at(nodes))[0] :
        0.;
    a *= thickness(step.kernel.axisymmetric, radius);

    const unsigned int nc = step.n_components, n_dofs = nodes.n_nodes * nc;
    for (unsigned int I = 0; I < nodes.n_nodes; ++I)
      for (unsigned int d = 0; d < dim; ++d)
        element.residual[I * nc + d] += p * N[I] * a[d];
    if (!with_matrix)
      return EvaluationStatus::success;
    // δa = (∇·δu) a - (∇δu)^T a
    const Tensor<2, dim> inverse = invert(F_increment);
    for (unsigned int J = 0; J < nodes.n_nodes; ++J)
      {
        const Tensor<1, dim> g = nodes.gradient[J] * inverse;
        for (unsigned int I = 0; I < nodes.n_nodes; ++I)
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e < dim; ++e)
              element.matrix[(I * nc + d) * n_dofs + J * nc + e] +=
                p * N[I] * (g[e] * a[d] - g[d] * a[e]);
        for (unsigned int I = 0; I < nodes.n_nodes && radius > 0; ++I)
          for (unsigned int d = 0; d < dim; ++d)
            element.matrix[(I * nc + d) * n_dofs + J * nc] +=
              p * N[I] * a[d] * N[J] / radius;
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  Tensor<1, dim>
  SurfaceForces<dim>::dead_load(const StepContext<dim> &step,
                                const unsigned int      b) const
  {
    const auto    &traction = condition_at(b).traction;
    Tensor<1, dim> force;
    if (traction.empty())
      return force;
    const double     A = area(step, b);
    const Point<dim> X = points.reference_location(b);
    for (unsigned int a = 0; a < dim; ++a)
      force[a] = A * traction[a](X, step.time);
    return force;
  }



  template <int dim>
  Tensor<1, dim>
  SurfaceForces<dim>::load(const StepContext<dim> &step,
                           const NodalField       &unknowns,
                           const unsigned int      b) const
  {
    Tensor<1, dim> force = dead_load(step, b);
    if (condition_at(b).pressure.empty())
      return force;
    const unsigned int n_nodes = points.stencil(b).n_nodes;
    PointElement       element;
    evaluate_point(step, unknowns, b, false, element);
    for (unsigned int I = 0; I < n_nodes; ++I)
      for (unsigned int a = 0; a < dim; ++a)
        force[a] -= element.residual[I * step.n_components + a];
    return force;
  }



  template <int dim>
  void
  SurfaceForces<dim>::add_dead_loads(const StepContext<dim> &step,
                                     NodalField             &force) const
  {
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        if (condition_at(b).traction.empty())
          continue;
        const Tensor<1, dim> at_point = dead_load(step, b);
        const auto           nodes    = points.stencil(b);
        for (unsigned int I = 0; I < nodes.n_nodes; ++I)
          for (unsigned int a = 0; a < dim; ++a)
            force.local_element(
              step.nodes.node(nodes.vertex[I]) * step.n_components + a) +=
              nodes.shape[I] * at_point[a];
      }
  }



  template class SurfaceForces<2>;
  template class SurfaceForces<3>;
} // namespace isochor
