/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/body_term.h>
#include <isochor/equations/invariants.h>
#include <isochor/equations/nodal_unknowns.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace isochor
{
  namespace
  {
    /** Set the pressures that @p element has started the step with, if that
     * takes the mean of pressures. */
    template <int dim, int n_components, std::size_t max_nodes>
    void
    gather_start(const StepContext<dim>                &step,
                 const unsigned int                     n_nodes,
                 const unsigned int *const              vertices,
                 Element<dim, n_components, max_nodes> &element)
    {
      element.start_weight = 0;
      if (!element.mixed || step.unknowns_at_start == nullptr)
        return;
      element.start_weight = 1 - step.end_weight;
      const NodalUnknowns<dim> at_start(step, *step.unknowns_at_start);
      for (unsigned int I = 0; I < n_nodes; ++I)
        element.pressure_at_start[I] = at_start.pressure(vertices[I]);
    }
  } // namespace



  template <int dim>
  BodyTerm<dim>::BodyTerm(const BackgroundGrid<dim> &grid,
                          const PointArrays<dim>    &points)
    : grid(grid)
    , points(points)
  {}



  template <int dim>
  void
  BodyTerm<dim>::touch_vertices(std::vector<unsigned int> &vertices)
  {
    const auto touch = [&](const unsigned int cell) {
      for (const unsigned int vertex : grid.geometry().vertex_indices(cell))
        vertices.push_back(vertex);
    };
    if (points.has_stencils())
      {
        vertices.insert(vertices.end(),
                        points.stencil_vertex.begin(),
                        points.stencil_vertex.end());
        for (const auto &cell : points.overlapped_cells)
          touch(cell.cell);
      }
    else
      for (const unsigned int cell : points.cell)
        touch(cell);
  }



  template <int dim>
  void
  BodyTerm<dim>::collect_elements(const StepContext<dim> &step,
                                  ElementNodes           &elements)
  {
    Assert(invariants::is_consistent(step.points),
           ExcMessage("The arrays are of different points."));
    std::vector<unsigned int> nodes;
    const auto                add = [&](const unsigned int *const vertices,
                         const unsigned int        n_nodes) {
      nodes.clear();
      for (unsigned int I = 0; I < n_nodes; ++I)
        nodes.push_back(step.nodes.node(vertices[I]));
      elements.add(nodes.begin(), nodes.end());
    };
    if (points.has_stencils())
      {
        for (unsigned int q = 0; q < points.n_points(); ++q)
          add(points.stencil_vertex.data() + points.stencil_start[q],
              points.stencil_start[q + 1] - points.stencil_start[q]);
        for (const auto &cell : points.overlapped_cells)
          add(grid.geometry().vertex_indices(cell.cell).data(), dim + 1);
      }
    else
      {
        // arrays that grow by themselves take up to twice the memory
        const std::size_t n = points.cell.size();
        elements.start.reserve(elements.start.size() + n);
        elements.node.reserve(elements.node.size() + n * (dim + 1));
        for (const unsigned int cell : points.cell)
          add(grid.geometry().vertex_indices(cell).data(), dim + 1);
      }
  }



  template <int dim>
  EvaluationStatus
  BodyTerm<dim>::assemble(const StepContext<dim> &step,
                          const NodalField       &unknowns,
                          const NodalField       &pending,
                          const unsigned int      first_element,
                          const bool              with_matrix,
                          MixedSystem<dim>       &system)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(invariants::fits(pending, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(invariants::is_consistent(step.points),
           ExcMessage("The arrays are of different points."));
    Assert(std::all_of(points.material.begin(),
                       points.material.end(),
                       [&](const unsigned int m) {
                         return m < step.kernel.materials.size();
                       }),
           ExcMessage("A point has no material."));
    if (!points.has_stencils())
      return step.mixed() ?
               assemble_cells<dim + 1>(
                 step, unknowns, pending, first_element, with_matrix, system) :
               assemble_cells<dim>(
                 step, unknowns, pending, first_element, with_matrix, system);

    if (step.mixed() && step.kernel.stabilisation.projects_pressures())
      assemble_overlapped_cells(step,
                                unknowns,
                                pending,
                                first_element + points.n_points(),
                                with_matrix,
                                system);
    // corners of domains in cells of P1, or in other elements: short arrays are
    // faster to work on
    constexpr unsigned int few  = (dim + 1) * (dim + 1),
                           many = (dim + 1) * ShapeFunctions<dim>::max_nodes;
    const auto assemble_points  = [&](auto n_components, auto max_nodes) {
      return assemble_domains<n_components(), max_nodes()>(
        step, unknowns, pending, first_element, with_matrix, system);
    };
    constexpr std::integral_constant<int, dim>           u;
    constexpr std::integral_constant<int, dim + 1>       u_p;
    constexpr std::integral_constant<unsigned int, few>  as_few;
    constexpr std::integral_constant<unsigned int, many> as_many;
    const unsigned int n_nodes = points.most_nodes();
    if (n_nodes <= few)
      return step.mixed() ? assemble_points(u_p, as_few) :
                            assemble_points(u, as_few);
    AssertThrow(n_nodes <= many, ExcInternalError());
    return step.mixed() ? assemble_points(u_p, as_many) :
                          assemble_points(u, as_many);
  }



  template <int dim>
  template <int n_components, unsigned int max_nodes>
  EvaluationStatus
  BodyTerm<dim>::assemble_domains(const StepContext<dim> &step,
                                  const NodalField       &unknowns,
                                  const NodalField       &pending,
                                  const unsigned int      first_element,
                                  const bool              with_matrix,
                                  MixedSystem<dim>       &system) const
  {
    Assert(points.has_stencils(), ExcInternalError());
    const NodalUnknowns<dim>              nodal(step, unknowns);
    Element<dim, n_components, max_nodes> element;
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        const auto stencil = points.stencil(grid.geometry(), 0, q);
        Assert(invariants::is_partition_of_unity<dim>(stencil),
               ExcMessage("The functions at a point don't add up to one."));
        AssertIndexRange(stencil.n_nodes, max_nodes + 1);
        element.n_nodes = stencil.n_nodes;
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          element.gradient[I] = stencil.gradient[I];
        nodal.gather(stencil.n_nodes, stencil.vertex, element);
        gather_start(step, stencil.n_nodes, stencil.vertex, element);
        const EvaluationStatus status =
          step.kernel.has_constant_gradients() ?
            step.kernel.evaluate(
              element,
              points,
              q,
              q + 1,
              [&](const unsigned int, const unsigned int I) {
                return stencil.shape[I];
              },
              with_matrix) :
            step.kernel.evaluate_points(
              element,
              points,
              q,
              q + 1,
              [&](const unsigned int) { return stencil; },
              with_matrix);
        if (status != EvaluationStatus::success)
          return status;
        system.add_element(first_element + q,
                           element.residual.data(),
                           with_matrix ? element.matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  void
  BodyTerm<dim>::assemble_overlapped_cells(const StepContext<dim> &step,
                                           const NodalField       &unknowns,
                                           const NodalField       &pending,
                                           const unsigned int first_element,
                                           const bool         with_matrix,
                                           MixedSystem<dim>  &system) const
  {
    Assert(step.mixed(), ExcMessage("Only pressures are stabilised."));
    const NodalUnknowns<dim>       nodal(step, unknowns);
    Element<dim, dim + 1, dim + 1> element;
    element.matrix.fill(0.);
    for (unsigned int k = 0; k < points.overlapped_cells.size(); ++k)
      {
        const OverlappedCell<dim> &cell = points.overlapped_cells[k];
        const auto &vertices = grid.geometry().vertex_indices(cell.cell);
        nodal.gather(dim + 1, vertices.data(), element);
        element.residual.fill(0.);
        if (with_matrix)
          element.matrix.fill(0.);
        step.kernel.stabilisation.add_projection(element,
                                                 cell.compliance,
                                                 cell.corners,
                                                 with_matrix,
                                                 step.kernel.upper_blocks_only);
        system.add_element(first_element + k,
                           element.residual.data(),
                           with_matrix ? element.matrix.data() : nullptr,
                           pending);
      }
  }



  template <int dim>
  template <int n_components>
  EvaluationStatus
  BodyTerm<dim>::assemble_cells(const StepContext<dim> &step,
                                const NodalField       &unknowns,
                                const NodalField       &pending,
                                const unsigned int      first_element,
                                const bool              with_matrix,
                                MixedSystem<dim>       &system) const
  {
    Assert(!points.has_stencils(), ExcInternalError());
    AssertDimension(n_components, static_cast<int>(step.n_components));
    const MixedKernel<dim>     &kernel   = step.kernel;
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const NodalUnknowns<dim>    nodal(step, unknowns);
    const auto shape = [this](const unsigned int q, const unsigned int I) {
      return points.shape[q][I];
    };

    Element<dim, n_components, dim + 1> element;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      {
        const unsigned int cell = points.cell[k];
        element.gradient        = points.gradients(geometry, k);
        nodal.gather(dim + 1, geometry.vertex_indices(cell).data(), element);
        gather_start(step,
                     dim + 1,
                     geometry.vertex_indices(cell).data(),
                     element);

        const unsigned int begin = points.cell_start[k],
                           end   = points.cell_start[k + 1];
        const EvaluationStatus status =
          kernel.has_constant_gradients() ?
            kernel.evaluate(element, points, begin, end, shape, with_matrix) :
            kernel.evaluate_points(
              element,
              points,
              begin,
              end,
              [&](const unsigned int q) {
                return points.stencil(geometry, k, q);
              },
              with_matrix);
        if (status != EvaluationStatus::success)
          return status;
        if constexpr (n_components == dim + 1)
          if (kernel.stabilisation.projects_pressures())
            kernel.stabilisation.add_projection(element,
                                                element.compliance,
                                                points.corners(geometry, k),
                                                with_matrix,
                                                kernel.upper_blocks_only);
        system.add_element(first_element + k,
                           element.residual.data(),
                           with_matrix ? element.matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  void
  BodyTerm<dim>::add_unit_residual(const StepContext<dim> &step,
                                   NodalField             &scale) const
  {
    Assert(invariants::fits(scale, step.nodes, step.n_components),
           ExcOtherNodes());
    // in the u form the rounding of J is multiplied by K
    std::vector<double> modulus;
    for (const auto &material : step.kernel.materials)
      modulus.push_back(
        material->shear_modulus() +
        (step.mixed() ? 0. : 0.1 / material->inverse_bulk_modulus()));

    // points of a cell share its nodes, unless each has a stencil of its own
    double              force_at_nodes = 0;
    std::vector<double> hoop_force, volume;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto   stencil = points.stencil(grid.geometry(), k, q);
          const double V       = points.measure(q);
          const double force   = V * modulus[points.material[q]];
          if (q == points.cell_start[k] || points.has_stencils())
            {
              force_at_nodes = 0;
              hoop_force.assign(stencil.n_nodes, 0.);
              volume.assign(stencil.n_nodes, 0.);
            }
          force_at_nodes += force;
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              if (step.kernel.axisymmetric)
                hoop_force[I] += force * stencil.shape[I] / points.radius[q];
              volume[I] += V * std::abs(stencil.shape[I]);
            }
          if (q + 1 < points.cell_start[k + 1] && !points.has_stencils())
            continue;
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const unsigned int entry =
                step.nodes.node(stencil.vertex[I]) * step.n_components;
              const double gradient = stencil.gradient[I].norm();
              for (unsigned int a = 0; a < dim; ++a)
                scale.local_element(entry + a) += force_at_nodes * gradient;
              scale.local_element(entry) += hoop_force[I];
              if (step.mixed())
                scale.local_element(entry + dim) += volume[I];
            }
        }
  }



  template class BodyTerm<2>;
  template class BodyTerm<3>;
} // namespace isochor
