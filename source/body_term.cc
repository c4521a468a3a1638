/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/body_term.h>

namespace isochor
{
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
    for (const unsigned int cell : points.cell)
      for (const unsigned int vertex : grid.geometry().vertex_indices(cell))
        vertices.push_back(vertex);
  }



  template <int dim>
  void
  BodyTerm<dim>::collect_elements(const StepContext<dim> &step,
                                  ElementNodes           &elements)
  {
    for (const unsigned int cell : points.cell)
      {
        std::array<unsigned int, dim + 1> nodes;
        for (unsigned int v = 0; v <= dim; ++v)
          nodes[v] = step.nodes.node(grid.geometry().vertex_indices(cell)[v]);
        elements.add(nodes.begin(), nodes.end());
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
    if (step.mixed())
      return assemble_cells<dim + 1>(
        step, unknowns, pending, first_element, with_matrix, system);
    else
      return assemble_cells<dim>(
        step, unknowns, pending, first_element, with_matrix, system);
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
    const MixedKernel<dim>     &kernel   = step.kernel;
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const double *const         values   = unknowns.begin();
    const auto shape = [this](const unsigned int q, const unsigned int I) {
      return points.shape[q][I];
    };

    Element<dim, n_components, dim + 1> element;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      {
        const unsigned int cell = points.cell[k];
        element.gradient        = geometry.gradients(cell);
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const double *const nodal =
              values +
              step.nodes.node(geometry.vertex_indices(cell)[v]) * n_components;
            for (unsigned int a = 0; a < dim; ++a)
              element.increment[v][a] = nodal[a];
            if (element.mixed)
              element.pressure[v] = nodal[n_components - 1];
          }

        const unsigned int begin = points.cell_start[k],
                           end   = points.cell_start[k + 1];
        const EvaluationStatus status =
          kernel.evaluate(element, points, begin, end, shape, with_matrix);
        if (status != EvaluationStatus::success)
          return status;
        if constexpr (n_components == dim + 1)
          if (kernel.ppp_coefficient > 0)
            {
              double volume_over_G = 0;
              for (unsigned int q = begin; q < end; ++q)
                volume_over_G +=
                  points.weight[q] /
                  kernel.materials[points.material[q]]->shear_modulus();
              kernel.add_pressure_projection(element,
                                             volume_over_G,
                                             with_matrix);
            }
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
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      {
        const auto &gradients = grid.geometry().gradients(points.cell[k]);
        const auto &vertices  = grid.geometry().vertex_indices(points.cell[k]);
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const double              V = points.weight[q];
            const MaterialModel<dim> &material =
              *step.kernel.materials[points.material[q]];
            // in the u form the rounding of J is multiplied by K
            double modulus = material.shear_modulus();
            if (!step.mixed())
              modulus += 0.1 / material.inverse_bulk_modulus();
            for (unsigned int I = 0; I <= dim; ++I)
              {
                const unsigned int entry =
                  step.nodes.node(vertices[I]) * step.n_components;
                for (unsigned int a = 0; a < dim; ++a)
                  scale.local_element(entry + a) +=
                    V * modulus * gradients[I].norm();
                if (step.mixed())
                  scale.local_element(entry + dim) += V * points.shape[q][I];
              }
          }
      }
  }



  template class BodyTerm<2>;
  template class BodyTerm<3>;
} // namespace isochor
