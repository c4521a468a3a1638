/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/equations/invariants.h>
#include <isochor/equations/mixed_system.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  MixedSystem<dim>::MixedSystem(const ActiveNodes<dim> &nodes)
    : nodes(nodes)
    , layout(nodes, system)
  {}



  template <int dim>
  bool
  MixedSystem<dim>::reinit(const bool              nodes_changed,
                           const unsigned int      n_components_,
                           const ElementNodes     &elements_,
                           const NodalConstraints &constraints,
                           const bool              symmetric)
  {
    AssertDimension(constraints.constrained.size(),
                    nodes.n_local() * n_components_);
    Assert(invariants::is_compressed(elements_.start, elements_.node.size()),
           ExcInternalError());
    Assert(std::all_of(elements_.node.begin(),
                       elements_.node.end(),
                       [&](const unsigned int node) {
                         return node < nodes.n_local();
                       }),
           ExcMessage("An element has a node that is not active."));
    Assert(is_same_on_all_ranks(symmetric, nodes.grid.communicator()),
           ExcInternalError());
    const MPI_Comm comm    = nodes.grid.communicator();
    const bool     changed = nodes_changed || n_components != n_components_ ||
                         system.symmetric != symmetric ||
                         !(elements == elements_) || !fits(constraints);
    if (Utilities::MPI::max(static_cast<unsigned int>(changed), comm) == 0)
      {
        tied.update(constraints.followers);
        if (any_equations)
          constraint_forces.reinit(constraints, n_components, true);
        return false;
      }

    n_components     = n_components_;
    elements         = elements_;
    constrained      = constraints.constrained;
    system.comm      = comm;
    system.dim       = dim;
    system.symmetric = symmetric;
    ++system.pattern_id;
    nodes.initialize(residual, n_components);
    nodes.initialize(lifting, n_components);

    tied.reinit(elements, constraints.followers, n_components, nodes.n_local());
    const int kind = !constraints.equations.empty() ? 2 : tied.empty() ? 0 : 1;
    const int kind_of_any = Utilities::MPI::max(kind, comm);
    any_followers         = kind_of_any > 0;
    any_equations         = kind_of_any > 1;
    constraint_forces.reinit(constraints, n_components, any_equations);
    if (any_equations)
      nodes.initialize(reactions, n_components);
    layout.reinit(n_components,
                  constrained,
                  elements,
                  tied.empty() ? elements : tied.extended());
    return true;
  }



  template <int dim>
  void
  MixedSystem<dim>::start_assembly(const bool with_matrix)
  {
    Assert(invariants::fits(residual, nodes, n_components), ExcOtherNodes());
    AssertDimension(system.row_start.size(), system.global_equation.size() + 1);
    residual = 0.;
    residual.zero_out_ghost_values();
    lifting = 0.;
    lifting.zero_out_ghost_values();
    if (with_matrix)
      system.values.assign(system.column.size(), 0.);
  }



  template <int dim>
  void
  MixedSystem<dim>::add_element(const unsigned int e,
                                const double      *element_residual,
                                const double      *element_matrix,
                                const NodalField  &pending)
  {
    AssertIndexRange(e, elements.size());
    Assert(element_residual != nullptr, ExcInternalError());
    const unsigned int *const node = elements.node.data() + elements.start[e];
    const unsigned int n_nodes     = elements.start[e + 1] - elements.start[e];

    double *const nodal_residual = residual.begin();
    for (unsigned int I = 0; I < n_nodes; ++I)
      for (unsigned int a = 0; a < n_components; ++a)
        nodal_residual[node[I] * n_components + a] +=
          element_residual[I * n_components + a];
    if (element_matrix == nullptr)
      return;

    if (layout.is_constrained(e))
      add_lifting(node, n_nodes, element_matrix, pending);
    add_matrix(e, element_matrix);
  }



  template <int dim>
  void
  MixedSystem<dim>::add_matrix(const unsigned int e,
                               const double      *element_matrix)
  {
    AssertIndexRange(e, elements.size());
    Assert(element_matrix != nullptr, ExcInternalError());
    AssertDimension(system.values.size(), system.column.size());
    const unsigned int *node    = elements.node.data() + elements.start[e];
    unsigned int        n_nodes = elements.start[e + 1] - elements.start[e];
    if (tied.touches(e))
      {
        element_matrix =
          tied.eliminate(e, n_nodes, element_matrix, system.symmetric);
        const ElementNodes &extended = tied.extended();
        node                         = extended.node.data() + extended.start[e];
        n_nodes = extended.start[e + 1] - extended.start[e];
      }
    layout.add(e, node, n_nodes, element_matrix);
  }



  template <int dim>
  void
  MixedSystem<dim>::add_lifting(const unsigned int *const node,
                                const unsigned int        n_nodes,
                                const double *const       matrix,
                                const NodalField         &pending)
  {
    Assert(invariants::fits(pending, nodes, n_components), ExcOtherNodes());
    const unsigned int n_dofs = n_nodes * n_components;
    for (unsigned int s = 0; s < n_dofs; ++s)
      {
        const unsigned int entry =
          node[s / n_components] * n_components + s % n_components;
        const double value = pending.local_element(entry);
        if (layout.has_equation(entry) || value == 0.)
          continue;
        for (unsigned int r = 0; r < n_dofs; ++r)
          lifting.local_element(node[r / n_components] * n_components +
                                r % n_components) +=
            value * (system.symmetric && s < r ? matrix[s * n_dofs + r] :
                                                 matrix[r * n_dofs + s]);
      }
  }



  template <int dim>
  void
  MixedSystem<dim>::finish_assembly(const NodalField &external_force)
  {
    Assert(invariants::fits(external_force, nodes, n_components),
           ExcOtherNodes());
    residual.compress(VectorOperation::add);
    lifting.compress(VectorOperation::add);
    residual.add(-1., external_force);
    if (any_equations)
      {
        reactions = residual;
        reactions.zero_out_ghost_values();
        constraint_forces.find(nodes.n_owned(), reactions);
      }
    if (!any_followers)
      return;
    tied.hand_on(nodes.n_owned(), residual, true);
    residual.compress(VectorOperation::add);
    tied.hand_on(nodes.n_owned(), lifting, false);
    lifting.compress(VectorOperation::add);
  }



  template <int dim>
  void
  MixedSystem<dim>::shape(TrilinosWrappers::MPI::Vector &vector) const
  {
    // all ranks or none: the equations of one may have changed alone
    const bool fits = vector.size() == system.n_equations &&
                      vector.locally_owned_elements() == system.locally_owned;
    if (Utilities::MPI::min(fits ? 1 : 0, system.comm) == 0)
      vector.reinit(system.locally_owned, system.comm);
  }



  template <int dim>
  void
  MixedSystem<dim>::right_hand_side(TrilinosWrappers::MPI::Vector &rhs) const
  {
    Assert(invariants::fits(residual, nodes, n_components), ExcOtherNodes());
    shape(rhs);
    double *const values = rhs.begin();
    unsigned int  next   = 0;
    for (unsigned int i = 0; i < nodes.n_owned() * n_components; ++i)
      if (layout.has_equation(i))
        values[next++] = -residual.local_element(i) - lifting.local_element(i);
  }



  template <int dim>
  void
  MixedSystem<dim>::to_nodes(const TrilinosWrappers::MPI::Vector &solution,
                             NodalField                          &field) const
  {
    Assert(invariants::fits(field, nodes, n_components), ExcOtherNodes());
    AssertDimension(solution.size(), system.n_equations);
    field.zero_out_ghost_values();
    const double *const values = solution.begin();
    unsigned int        next   = 0;
    for (unsigned int i = 0; i < nodes.n_owned() * n_components; ++i)
      if (layout.has_equation(i))
        field.local_element(i) = values[next++];
    field.update_ghost_values();
    const Followers &followers = tied.followers();
    for (unsigned int k = 0; k < followers.size(); ++k)
      field.local_element(followers.entry[k]) +=
        followers.sum(k, [&](const unsigned int entry) {
          return layout.has_equation(entry) ? field.local_element(entry) : 0.;
        });
  }



  template <int dim>
  void
  MixedSystem<dim>::interpolate_followers(NodalField &field) const
  {
    Assert(invariants::fits(field, nodes, n_components), ExcOtherNodes());
    const Followers &followers = tied.followers();
    for (unsigned int k = 0; k < followers.size(); ++k)
      if (followers.value[k] == 0.)
        field.local_element(followers.entry[k]) =
          followers.sum(k, [&](const unsigned int entry) {
            return field.local_element(entry);
          });
  }



  template class MixedSystem<2>;
  template class MixedSystem<3>;
} // namespace isochor
