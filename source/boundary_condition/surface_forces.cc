/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/base/rounding.h>
#include <isochor/base/thickness.h>
#include <isochor/boundary_condition/surface_forces.h>
#include <isochor/equations/invariants.h>
#include <isochor/equations/nodal_unknowns.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isochor
{
  namespace
  {
    /** The entry of the first unknown of node @p I of a place. */
    template <int dim, typename Place>
    unsigned int
    first_entry(const StepContext<dim> &step,
                const Place            &at,
                const unsigned int      I)
    {
      return step.nodes.node(at.vertex[I]) * step.n_components;
    }
  } // namespace



  template <int dim>
  void
  SurfaceForces<dim>::collect_elements(const StepContext<dim> &step,
                                       ElementNodes           &elements) const
  {
    std::vector<unsigned int> nodes;
    for (unsigned int b = 0; b < n_places(); ++b)
      if (!load_at(b).pressure.empty())
        {
          const Place at = place(b);
          nodes.clear();
          for (unsigned int I = 0; I < at.n_nodes; ++I)
            nodes.push_back(step.nodes.node(at.vertex[I]));
          elements.add(nodes.begin(), nodes.end());
        }
  }



  template <int dim>
  EvaluationStatus
  SurfaceForces<dim>::assemble(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const NodalField       &pending,
                               const unsigned int      first_element,
                               const bool              with_matrix,
                               MixedSystem<dim>       &system) const
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(invariants::fits(pending, step.nodes, step.n_components),
           ExcOtherNodes());
    Element      element;
    unsigned int e = first_element;
    for (unsigned int b = 0; b < n_places(); ++b)
      if (!load_at(b).pressure.empty())
        {
          const EvaluationStatus status = evaluate_pressure(
            step, unknowns, b, place(b), with_matrix, element);
          if (status != EvaluationStatus::success)
            return status;
          system.add_element(e++,
                             element.residual.data(),
                             with_matrix ? element.matrix.data() : nullptr,
                             pending);
        }
    return EvaluationStatus::success;
  }



  template <int dim>
  EvaluationStatus
  SurfaceForces<dim>::evaluate_pressure(const StepContext<dim> &step,
                                        const NodalField       &unknowns,
                                        const unsigned int      b,
                                        const Place            &at,
                                        const bool              with_matrix,
                                        Element                &element) const
  {
    AssertIndexRange(b, n_places());
    Assert(at.n_nodes > 0, ExcInternalError());
    const unsigned int nc = step.n_components, n_dofs = at.n_nodes * nc;
    element.residual.assign(n_dofs, 0.);
    if (with_matrix)
      element.matrix.assign(n_dofs * n_dofs, 0.);
    const double               p = load_at(b).pressure.front()(at.X, step.time);
    const std::vector<double> &N = at.shape;
    const NodalUnknowns<dim>   nodal(step, unknowns);
    const Tensor<2, dim>       F_increment = nodal.deformation_at(at);
    const Tensor<2, dim>       F           = F_increment * at.F;
    if (!(determinant(F) > 0) || !(determinant(F_increment) > 0))
      return EvaluationStatus::inverted_point;
    // Nanson: a = det F F^{-T} A_0
    const Tensor<1, dim> in_plane = determinant(F) * (at.area * invert(F));
    // a ring of the radius at the end of the step
    const bool           axisymmetric = step.kernel.axisymmetric;
    const Tensor<1, dim> a =
      thickness(axisymmetric,
                (at.X + at.displacement + nodal.increment_at(at))[0]) *
      in_plane;

    for (unsigned int I = 0; I < at.n_nodes; ++I)
      for (unsigned int d = 0; d < dim; ++d)
        element.residual[I * nc + d] += p * N[I] * a[d];
    if (!with_matrix)
      return EvaluationStatus::success;
    // δa = (∇·δu) a - (∇δu)^T a
    const Tensor<2, dim> inverse = invert(F_increment);
    for (unsigned int J = 0; J < at.n_nodes; ++J)
      {
        const Tensor<1, dim> g = at.gradient[J] * inverse;
        for (unsigned int I = 0; I < at.n_nodes; ++I)
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e < dim; ++e)
              element.matrix[(I * nc + d) * n_dofs + J * nc + e] +=
                p * N[I] * (g[e] * a[d] - g[d] * a[e]);
        for (unsigned int I = 0; I < at.n_nodes && axisymmetric; ++I)
          for (unsigned int d = 0; d < dim; ++d)
            element.matrix[(I * nc + d) * n_dofs + J * nc] +=
              p * N[I] * in_plane[d] * thickness(true, N[J]);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  Tensor<1, dim>
  SurfaceForces<dim>::dead_load(const StepContext<dim> &step,
                                const unsigned int      b,
                                const Place            &at) const
  {
    AssertIndexRange(b, n_places());
    const auto    &traction = load_at(b).traction;
    Tensor<1, dim> force;
    if (traction.empty())
      return force;
    const double A =
      thickness(step.kernel.axisymmetric, at.X[0]) * at.area.norm();
    for (unsigned int a = 0; a < dim; ++a)
      force[a] = A * traction[a](at.X, step.time);
    return force;
  }



  template <int dim>
  Tensor<1, dim>
  SurfaceForces<dim>::force_at(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const unsigned int      b,
                               const Place            &at) const
  {
    Tensor<1, dim> force = dead_load(step, b, at);
    if (load_at(b).pressure.empty())
      return force;
    Element element;
    evaluate_pressure(step, unknowns, b, at, false, element);
    for (unsigned int I = 0; I < at.n_nodes; ++I)
      for (unsigned int a = 0; a < dim; ++a)
        force[a] -= element.residual[I * step.n_components + a];
    return force;
  }



  template <int dim>
  void
  SurfaceForces<dim>::add_dead_loads(const StepContext<dim> &step,
                                     NodalField             &force) const
  {
    Assert(invariants::fits(force, step.nodes, step.n_components),
           ExcOtherNodes());
    for (unsigned int b = 0; b < n_places(); ++b)
      if (!load_at(b).traction.empty())
        {
          const Place          at   = place(b);
          const Tensor<1, dim> load = dead_load(step, b, at);
          for (unsigned int I = 0; I < at.n_nodes; ++I)
            for (unsigned int a = 0; a < dim; ++a)
              force.local_element(first_entry(step, at, I) + a) +=
                at.shape[I] * load[a];
        }
  }



  template <int dim>
  void
  SurfaceForces<dim>::add_pressures(const StepContext<dim> &step,
                                    const NodalField       &unknowns,
                                    NodalField             &force) const
  {
    Assert(invariants::fits(force, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    Element element;
    for (unsigned int b = 0; b < n_places(); ++b)
      if (!load_at(b).pressure.empty())
        {
          const Place at = place(b);
          // what can't be evaluated stops assemble(), too
          if (evaluate_pressure(step, unknowns, b, at, false, element) !=
              EvaluationStatus::success)
            return;
          for (unsigned int I = 0; I < at.n_nodes; ++I)
            for (unsigned int a = 0; a < dim; ++a)
              force.local_element(first_entry(step, at, I) + a) -=
                element.residual[I * step.n_components + a];
        }
  }



  template <int dim>
  unsigned int
  SurfaceForces<dim>::surface_at(const Surfaces    &surfaces,
                                 const unsigned int b) const
  {
    return std::find(surfaces.begin(), surfaces.end(), &load_at(b)) -
           surfaces.begin();
  }



  template <int dim>
  void
  SurfaceForces<dim>::evaluate(const Surfaces         &surfaces,
                               const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const NodalConstraints &constraints,
                               Statistics             &statistics) const
  {
    AssertDimension(constraints.constrained.size(),
                    step.nodes.n_local() * step.n_components);
    // by surface and component: the force; what of it is on supports, and all
    std::vector<std::array<double, 3 * dim>> sums(surfaces.size());
    for (unsigned int b = 0; b < n_places(); ++b)
      {
        const Place          at   = place(b);
        const Tensor<1, dim> load = force_at(step, unknowns, b, at);
        auto                &sum  = sums[surface_at(surfaces, b)];
        for (unsigned int a = 0; a < dim; ++a)
          {
            sum[a] += load[a];
            for (unsigned int I = 0; I < at.n_nodes; ++I)
              {
                const double part = std::abs(at.shape[I] * load[a]);
                if (constraints.constrained[first_entry(step, at, I) + a] ==
                    NodalConstraints::prescribed)
                  sum[dim + a] += part;
                sum[2 * dim + a] += part;
              }
          }
      }
    for (auto &sum : sums)
      sum_over_ranks(sum, step.grid.communicator());
    // normals of faces along an axis have some
    constexpr double nearly_all = 0.99;
    on_supports.clear();
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      {
        const double load =
          std::accumulate(sums[s].begin() + 2 * dim, sums[s].end(), 0.);
        statistics.set_owner(surfaces[s]->owner);
        for (unsigned int a = 0; a < dim; ++a)
          {
            double force = 0; // a surface may have several loads
            for (unsigned int other = 0; other < surfaces.size(); ++other)
              if (surfaces[other]->surface == surfaces[s]->surface &&
                  surfaces[other]->owner == surfaces[s]->owner)
                force += sums[other][a];
            statistics.set(std::string("Load ") + "xyz"[a] + " on " +
                             surfaces[s]->surface + " (N)",
                           force);
            if (sums[s][2 * dim + a] > rounding::accumulated * load &&
                sums[s][dim + a] > nearly_all * sums[s][2 * dim + a])
              on_supports.push_back(
                {surfaces[s]->surface, surfaces[s]->parameter, a});
          }
      }
  }



  template class SurfaceForces<2>;
  template class SurfaceForces<3>;
} // namespace isochor
