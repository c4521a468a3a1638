/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of MixedSystem that add up matrix and residual.
#include <isochor/equations/invariants.h>
#include <isochor/equations/mixed_system.h>

#include <algorithm>

namespace isochor
{
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
  MixedSystem<dim>::add_block(const unsigned int row_node,
                              const unsigned int column_node,
                              const unsigned int offset,
                              const double      *block,
                              const unsigned int row_stride,
                              const unsigned int column_stride)
  {
    AssertIndexRange(row_node, nodes.n_local());
    AssertIndexRange(column_node, nodes.n_local());
    const unsigned int *const row_of =
      equations.data() + row_node * n_components;
    const unsigned int *const column_of =
      equations.data() + column_node * n_components;
    // of the columns of a symmetric matrix left of the diagonal none is stored
    const bool   triangle  = system.symmetric && row_node == column_node;
    unsigned int n_skipped = 0;
    for (unsigned int a = 0; a < n_components; ++a)
      {
        if (row_of[a] == numbers::invalid_unsigned_int)
          continue;
        double *value = system.values.data() + system.row_start[row_of[a]] +
                        offset - n_skipped;
        for (unsigned int b = 0; b < n_components; ++b)
          if (column_of[b] != numbers::invalid_unsigned_int)
            {
              if (!triangle || b >= a)
                *value += block[a * row_stride + b * column_stride];
              ++value;
            }
        n_skipped += system.symmetric;
      }
  }



  /** The equations of a node follow one another, so that its rows do. */
  template <int dim>
  template <unsigned int nc>
  void
  MixedSystem<dim>::add_free_element(const unsigned int  e,
                                     const unsigned int *node,
                                     const unsigned int  n_nodes,
                                     const double       *matrix)
  {
    AssertDimension(nc, n_components);
    AssertIndexRange(e + 1, block_start.size());
    const unsigned int        n_dofs = n_nodes * nc;
    const unsigned int       *offset = block_offset.data() + block_start[e];
    const std::size_t *const  start  = system.row_start.data();
    const unsigned int *const first  = equations.data();
    double *const             values = system.values.data();
    for (unsigned int I = 0; I < n_nodes; ++I)
      {
        const unsigned int row_I = first[node[I] * nc];
        if (!system.symmetric)
          {
            for (unsigned int J = 0; J < n_nodes; ++J, ++offset)
              for (unsigned int a = 0; a < nc; ++a)
                {
                  double *const       row = values + start[row_I + a] + *offset;
                  const double *const part =
                    matrix + (I * nc + a) * n_dofs + J * nc;
                  for (unsigned int b = 0; b < nc; ++b)
                    row[b] += part[b];
                }
            continue;
          }
        // the upper triangle: row a begins a entries later than the first
        for (unsigned int a = 0; a < nc; ++a)
          {
            double *const       row  = values + start[row_I + a] + *offset - a;
            const double *const part = matrix + (I * nc + a) * n_dofs + I * nc;
            for (unsigned int b = a; b < nc; ++b)
              row[b] += part[b];
          }
        ++offset;
        for (unsigned int J = I + 1; J < n_nodes; ++J, ++offset)
          {
            const double *const      part  = matrix + I * nc * n_dofs + J * nc;
            const unsigned int       row_J = first[node[J] * nc];
            const bool               swapped = row_J < row_I;
            const std::size_t *const row_start =
              start + (swapped ? row_J : row_I);
            for (unsigned int a = 0; a < nc; ++a)
              {
                double *const row = values + row_start[a] + *offset - a;
                if (swapped)
                  for (unsigned int b = 0; b < nc; ++b)
                    row[b] += part[b * n_dofs + a];
                else
                  for (unsigned int b = 0; b < nc; ++b)
                    row[b] += part[a * n_dofs + b];
              }
          }
      }
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

    if (element_is_constrained[e])
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
    if (!element_is_constrained[e])
      {
        if (n_components == dim)
          add_free_element<dim>(e, node, n_nodes, element_matrix);
        else
          add_free_element<dim + 1>(e, node, n_nodes, element_matrix);
        return;
      }
    const unsigned int n_dofs = n_nodes * n_components;

    const unsigned int *offset = block_offset.data() + block_start[e];
    for (unsigned int I = 0; I < n_nodes; ++I)
      for (unsigned int J = (system.symmetric ? I : 0); J < n_nodes; ++J)
        {
          const double *const block =
            element_matrix + (I * n_dofs + J) * n_components;
          if (system.symmetric && node_order[node[J]] < node_order[node[I]])
            add_block(node[J], node[I], *offset++, block, 1, n_dofs);
          else
            add_block(node[I], node[J], *offset++, block, n_dofs, 1);
        }
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
        if (equations[entry] != numbers::invalid_unsigned_int || value == 0.)
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



  template void
  MixedSystem<2>::start_assembly(const bool);
  template void
  MixedSystem<2>::add_element(const unsigned int,
                              const double *,
                              const double *,
                              const NodalField &);
  template void
  MixedSystem<2>::add_matrix(const unsigned int, const double *);
  template void
  MixedSystem<2>::finish_assembly(const NodalField &);
  template void
  MixedSystem<3>::start_assembly(const bool);
  template void
  MixedSystem<3>::add_element(const unsigned int,
                              const double *,
                              const double *,
                              const NodalField &);
  template void
  MixedSystem<3>::add_matrix(const unsigned int, const double *);
  template void
  MixedSystem<3>::finish_assembly(const NodalField &);
} // namespace isochor
