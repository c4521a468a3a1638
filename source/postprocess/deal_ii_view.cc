/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>

#include <isochor/equations/invariants.h>
#include <isochor/postprocess/deal_ii_view.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  DealIIView<dim>::DealIIView(const StepContext<dim> &step,
                              const NodalField       &unknowns)
    : n_components(step.n_components)
    , mapping_collection(step.grid.mapping())
    , dofs(step.grid.triangulation())
  {
    elements.push_back(FESystem<dim>(FE_SimplexP<dim>(1), n_components));
    elements.push_back(
      FE_Nothing<dim>(ReferenceCells::get_simplex<dim>(), n_components));
    mark_cells(step);
    dofs.distribute_dofs(elements);
    copy_values(step, unknowns);
  }



  template <int dim>
  void
  DealIIView<dim>::mark_cells(const StepContext<dim> &step)
  {
    std::vector<bool> holds_material(step.grid.geometry().n_cells(), false);
    for (const unsigned int cell : step.points.cell)
      {
        const auto &vertices = step.grid.geometry().vertex_indices(cell);
        // the points' domains may miss a node of the cell
        holds_material[cell] =
          std::all_of(vertices.begin(), vertices.end(), [&](const auto v) {
            return step.nodes.node(v) != numbers::invalid_unsigned_int;
          });
      }
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        cell->set_active_fe_index(
          holds_material[cell->active_cell_index()] ? 0 : 1);
  }



  template <int dim>
  void
  DealIIView<dim>::copy_values(const StepContext<dim> &step,
                               const NodalField       &unknowns)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    // all: tools may go over all cells that a rank knows
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    values.reinit(dofs.locally_owned_dofs(),
                  relevant,
                  step.grid.communicator());
    // every rank knows the values at the vertices of its own cells
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned() && cell->active_fe_index() == 0)
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const unsigned int node =
              step.nodes.node(cell->vertex_index(v)) * n_components;
            for (unsigned int a = 0; a < n_components; ++a)
              {
                const auto dof = cell->vertex_dof_index(v, a, 0);
                if (values.in_local_range(dof))
                  values(dof) = unknowns.local_element(node + a);
              }
          }
    values.update_ghost_values();
  }



  template <int dim>
  std::vector<std::string>
  DealIIView<dim>::component_names() const
  {
    std::vector<std::string> names(dim, "displacement_increment");
    if (n_components == dim + 1)
      names.emplace_back("pressure");
    return names;
  }



  template <int dim>
  std::vector<DataComponentInterpretation::DataComponentInterpretation>
  DealIIView<dim>::component_interpretation() const
  {
    std::vector<DataComponentInterpretation::DataComponentInterpretation>
      interpretation(n_components,
                     DataComponentInterpretation::component_is_scalar);
    std::fill_n(interpretation.begin(),
                dim,
                DataComponentInterpretation::component_is_part_of_vector);
    return interpretation;
  }



  template class DealIIView<2>;
  template class DealIIView<3>;
} // namespace isochor
