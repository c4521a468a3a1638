/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/thickness.h>
#include <isochor/boundary_condition/surface_forces.h>
#include <isochor/equations/nodal_unknowns.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  SurfaceForces<dim>::find_shear_moduli(const StepContext<dim> &step) const
  {
    const auto &materials = step.kernel.materials;
    if (!conditions.prescribe_displacements())
      return;
    if (materials.size() == 1)
      {
        for (unsigned int b = 0; b < points.size(); ++b)
          points.set_shear_modulus(b, materials.front()->shear_modulus());
        return;
      }
    // Σ_p N_I V_p and Σ_p N_I V_p G_p at the nodes
    NodalField sums;
    step.nodes.initialize(sums, 2);
    for (unsigned int k = 0; k < step.points.cell.size(); ++k)
      for (unsigned int q = step.points.cell_start[k];
           q < step.points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = step.points.stencil(step.grid.geometry(), k, q);
          const double G = materials[step.points.material[q]]->shear_modulus();
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const double       V = stencil.shape[I] * step.points.volume[q];
              const unsigned int node = step.nodes.node(stencil.vertex[I]);
              sums.local_element(2 * node) += V;
              sums.local_element(2 * node + 1) += V * G;
            }
        }
    sums.compress(VectorOperation::add);
    sums.update_ghost_values();
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        if (points.is_on_domain(b))
          continue;
        const auto stencil = points.stencil(b);
        double     V = 0, VG = 0;
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          {
            const unsigned int node = step.nodes.node(stencil.vertex[I]);
            V += sums.local_element(2 * node);
            VG += sums.local_element(2 * node + 1);
          }
        points.set_shear_modulus(b, VG / V);
      }
  }



  template <int dim>
  EvaluationStatus
  SurfaceForces<dim>::evaluate_point(const StepContext<dim> &step,
                                     const NodalField       &unknowns,
                                     const unsigned int      b,
                                     const bool              with_matrix,
                                     PointElement           &element) const
  {
    element.reinit(points.stencil(b).n_nodes * step.n_components, with_matrix);
    if (condition_at(b).is_fixed())
      add_penalty(step, unknowns, b, with_matrix, element);
    return condition_at(b).pressure.empty() ?
             EvaluationStatus::success :
             add_pressure(step, unknowns, b, with_matrix, element);
  }



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
  double
  SurfaceForces<dim>::stiffness(const StepContext<dim> &step,
                                const unsigned int      b) const
  {
    const double G =
      points.is_on_domain(b) ?
        step.kernel.materials[points.material(b)]->shear_modulus() :
        points.shear_modulus(b);
    return conditions.penalty(step.has_inertia) * G / points.size_of_cells(b) *
           area(step, b);
  }



  template <int dim>
  Tensor<1, dim>
  SurfaceForces<dim>::displacement(const StepContext<dim> &step,
                                   const NodalField       &unknowns,
                                   const unsigned int      b) const
  {
    return points.displacement(b) +
           NodalUnknowns<dim>(step, unknowns).increment_at(points.stencil(b));
  }



  template <int dim>
  Tensor<1, dim>
  SurfaceForces<dim>::penalty_force(const StepContext<dim> &step,
                                    const NodalField       &unknowns,
                                    const unsigned int      b) const
  {
    const auto          &prescribed = condition_at(b).displacement;
    const Tensor<1, dim> u          = displacement(step, unknowns, b);
    const double         k          = stiffness(step, b);
    Tensor<1, dim>       force;
    for (unsigned int a = 0; a < dim; ++a)
      if (!prescribed[a].empty())
        force[a] = -k * (u[a] - target(step, b, a) -
                         correction.value(points.surface(b),
                                          a,
                                          points.reference_location(b),
                                          step.time));
    return force;
  }



  template <int dim>
  std::pair<double, double>
  SurfaceForces<dim>::initial_motion(const unsigned int b,
                                     const unsigned int a) const
  {
    const auto      &u  = condition_at(b).displacement[a].front();
    const Point<dim> X  = points.reference_location(b);
    const double     dt = trial.end - trial.start;
    if (dt == 0)
      return {0., 0.};
    std::array<double, n_motion_places> places;
    for (unsigned int k = 0; k < n_motion_places; ++k)
      places[k] = u(X, trial.start + k * dt / (n_motion_places - 1));
    return trial.smooth.of(motion_of_step(places, dt));
  }



  template <int dim>
  void
  SurfaceForces<dim>::append_motion(const double         time,
                                    std::vector<double> &values) const
  {
    for (unsigned int b = 0; b < points.size(); ++b)
      for (const auto &displacement : condition_at(b).displacement)
        if (!displacement.empty())
          values.push_back(
            displacement.front()(points.reference_location(b), time));
  }



  template <int dim>
  double
  SurfaceForces<dim>::target(const StepContext<dim> &step,
                             const unsigned int      b,
                             const unsigned int      a) const
  {
    const auto u = [&](const double time) {
      return condition_at(b).displacement[a].front()(
        points.reference_location(b), time);
    };
    if (trial.size == 0)
      return u(step.time);
    // a displacement at t = 0 comes with the first step
    const double start = trial.start > 0 ? u(trial.start) : 0.;
    const auto [V, A]  = initial_motion(b, a);
    return start + trial.size * (V + trial.size / 2 * A);
  }



  template <int dim>
  bool
  SurfaceForces<dim>::move_body(const StepContext<dim> &step) const
  {
    for (unsigned int b = 0; b < points.size(); ++b)
      for (unsigned int a = 0; a < dim; ++a)
        if (!condition_at(b).displacement[a].empty() && moves(step, b, a))
          return true;
    return false;
  }



  template <int dim>
  bool
  SurfaceForces<dim>::starts_suddenly(const StepContext<dim> &step,
                                      const NodalField       &velocity) const
  {
    for (unsigned int b = 0; b < points.size(); ++b)
      for (unsigned int a = 0; a < dim; ++a)
        {
          if (condition_at(b).displacement[a].empty())
            continue;
          const double V     = initial_motion(b, a).first;
          const auto   nodes = points.stencil(b);
          double       v     = 0;
          for (unsigned int I = 0; I < nodes.n_nodes; ++I)
            v += nodes.shape[I] * velocity.local_element(
                                    step.nodes.node(nodes.vertex[I]) * dim + a);
          if (std::abs(V - v) > 1e-8 * std::max(std::abs(V), std::abs(v)))
            return true;
        }
    return false;
  }



  template <int dim>
  void
  SurfaceForces<dim>::add_penalty(const StepContext<dim> &step,
                                  const NodalField       &unknowns,
                                  const unsigned int      b,
                                  const bool              with_matrix,
                                  PointElement           &element) const
  {
    const Tensor<1, dim> force = penalty_force(step, unknowns, b);
    const auto           nodes = points.stencil(b);
    const double *const  N     = nodes.shape;
    const unsigned int   nc = step.n_components, n_dofs = nodes.n_nodes * nc;
    for (unsigned int I = 0; I < nodes.n_nodes; ++I)
      for (unsigned int a = 0; a < dim; ++a)
        element.residual[I * nc + a] -= N[I] * force[a];
    if (!with_matrix)
      return;
    const double k = stiffness(step, b);
    for (unsigned int I = 0; I < nodes.n_nodes; ++I)
      for (unsigned int J = 0; J < nodes.n_nodes; ++J)
        for (unsigned int a = 0; a < dim; ++a)
          if (!condition_at(b).displacement[a].empty())
            element.matrix[(I * nc + a) * n_dofs + J * nc + a] +=
              k * N[I] * N[J];
  }



  template <int dim>
  EvaluationStatus
  SurfaceForces<dim>::add_pressure(const StepContext<dim> &step,
                                   const NodalField       &unknowns,
                                   const unsigned int      b,
                                   const bool              with_matrix,
                                   PointElement           &element) const
  {
    const double p =
      condition_at(b).pressure.front()(points.reference_location(b), step.time);
    const auto           nodes = points.stencil(b);
    const double *const  N     = nodes.shape;
    const Tensor<2, dim> F_increment =
      NodalUnknowns<dim>(step, unknowns).deformation_at(nodes);
    // Nanson: a = det F F^{-T} A_0
    const Tensor<2, dim> F = F_increment * points.F(b);
    if (!(determinant(F) > 0) || !(determinant(F_increment) > 0))
      return EvaluationStatus::inverted_point;
    Tensor<1, dim> a = determinant(F) * (points.reference_area(b) * invert(F));
    // a ring of the radius at the end of the step
    const double radius =
      step.kernel.axisymmetric ?
        (points.reference_location(b) + displacement(step, unknowns, b))[0] :
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
    element.reinit(n_nodes * step.n_components, false);
    add_pressure(step, unknowns, b, false, element);
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



  template <int dim>
  void
  SurfaceForces<dim>::add_unit_residual(const StepContext<dim> &step,
                                        NodalField             &scale) const
  {
    // of u and ū, as far as points have moved, a few units of the last digit
    // remain in their difference: a tenth of 1e-14
    constexpr double rounding = 0.1;
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        if (!condition_at(b).is_fixed())
          continue;
        const auto   nodes = points.stencil(b);
        const double k     = stiffness(step, b);
        for (unsigned int a = 0; a < dim; ++a)
          if (!condition_at(b).displacement[a].empty())
            for (unsigned int I = 0; I < nodes.n_nodes; ++I)
              scale.local_element(
                step.nodes.node(nodes.vertex[I]) * step.n_components + a) +=
                rounding * k * nodes.shape[I] *
                std::max(std::abs(points.displacement(b)[a]),
                         std::abs(target(step, b, a)));
      }
  }



  template class SurfaceForces<2>;
  template class SurfaceForces<3>;
} // namespace isochor
