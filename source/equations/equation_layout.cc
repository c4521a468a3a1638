/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/equations/equation_layout.h>
#include <isochor/equations/nodal_constraints.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace isochor
{
  namespace
  {
    constexpr unsigned int invalid = numbers::invalid_unsigned_int;
  }



  template <int dim>
  EquationLayout<dim>::EquationLayout(const ActiveNodes<dim> &nodes,
                                      SparseSystem           &system)
    : nodes(nodes)
    , system(system)
  {}



  template <int dim>
  void
  EquationLayout<dim>::reinit(const unsigned int                n_components_,
                              const std::vector<unsigned char> &constrained,
                              const ElementNodes               &elements,
                              const ElementNodes               &extended)
  {
    n_components                   = n_components_;
    const FreeEntries free_entries = number_free_entries(constrained);
    describe_equations(free_entries);
    collect_neighbours(extended);
    build_rows();
    find_blocks(elements, extended);
    for (auto *list : {&neighbour, &neighbour_offset})
      std::vector<unsigned int>().swap(*list); // needed no more
  }



  template <int dim>
  std::vector<std::pair<types::global_dof_index, unsigned int>>
  EquationLayout<dim>::number_free_entries(
    const std::vector<unsigned char> &constrained)
  {
    AssertDimension(constrained.size(), nodes.n_local() * n_components);
    const unsigned int n_owned = nodes.n_owned() * n_components;
    const unsigned int n_local = nodes.n_local() * n_components;

    // free unknowns of the owned nodes, one after the other over the ranks
    const auto is_free = [&](const unsigned int entry) {
      return constrained[entry] == NodalConstraints::is_free;
    };
    types::global_dof_index n_owned_free = 0;
    for (unsigned int i = 0; i < n_owned; ++i)
      n_owned_free += is_free(i);
    const auto offset_and_sum =
      exclusive_and_total_sum(n_owned_free, system.comm);
    system.n_equations   = offset_and_sum.second;
    system.locally_owned = IndexSet(system.n_equations);
    system.locally_owned.add_range(offset_and_sum.first,
                                   offset_and_sum.first + n_owned_free);

    // a field of doubles carries the numbers to the ghosts, exactly
    NodalField global;
    nodes.initialize(global, n_components);
    types::global_dof_index next = offset_and_sum.first;
    for (unsigned int i = 0; i < n_owned; ++i)
      global.local_element(i) = is_free(i) ? next++ : -1.;
    global.update_ghost_values();

    FreeEntries sorted;
    for (unsigned int i = 0; i < n_local; ++i)
      if (global.local_element(i) >= 0)
        sorted.emplace_back(global.local_element(i), i);
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }



  template <int dim>
  void
  EquationLayout<dim>::describe_equations(const FreeEntries &sorted)
  {
    Assert(std::is_sorted(sorted.begin(), sorted.end()), ExcInternalError());
    equations.assign(nodes.n_local() * n_components, invalid);
    const unsigned int n = sorted.size();
    system.global_equation.resize(n);
    system.field.resize(n);
    system.node.resize(n);
    system.component.resize(n);
    system.position.resize(n * dim);
    system.rotation_arm.clear();
    node_first_free.assign(nodes.n_local() + 1, 0);
    nodes_in_order.clear();
    node_order.assign(nodes.n_local(), invalid);
    for (unsigned int eq = 0; eq < n; ++eq)
      {
        const unsigned int entry     = sorted[eq].second;
        const unsigned int component = entry % n_components;
        const unsigned int node      = entry / n_components;
        ++node_first_free[node + 1];
        if (node_order[node] == invalid)
          {
            node_order[node] = nodes_in_order.size();
            nodes_in_order.push_back(node);
          }
        system.node[eq]            = node_order[node];
        equations[entry]           = eq;
        system.global_equation[eq] = sorted[eq].first;
        system.component[eq]       = component;
        system.field[eq] = component < dim ? SparseSystem::Field::displacement :
                                             SparseSystem::Field::pressure;
        const Point<dim> x = nodes.position(node);
        for (unsigned int d = 0; d < dim; ++d)
          system.position[eq * dim + d] = x[d];
        if (const ControlNode<dim> *control = nodes.control_node(node))
          {
            system.rotation_arm.resize(n, 0.); // displacements
            system.rotation_arm[eq] = control->rotation_arm;
          }
      }
    std::partial_sum(node_first_free.begin(),
                     node_first_free.end(),
                     node_first_free.begin());
  }



  template <int dim>
  void
  EquationLayout<dim>::collect_neighbours(const ElementNodes &elements)
  {
    // elements of each node
    std::vector<std::size_t> element_start(nodes.n_local() + 1, 0);
    for (const unsigned int node : elements.node)
      ++element_start[node + 1];
    std::partial_sum(element_start.begin(),
                     element_start.end(),
                     element_start.begin());
    std::vector<unsigned int> element_of(elements.node.size());
    {
      std::vector<std::size_t> next(element_start.begin(),
                                    element_start.end() - 1);
      for (unsigned int e = 0; e < elements.size(); ++e)
        for (std::size_t i = elements.start[e]; i < elements.start[e + 1]; ++i)
          element_of[next[elements.node[i]]++] = e;
    }

    neighbour_start.assign(1, 0);
    neighbour.clear();
    neighbour_offset.clear();
    std::vector<unsigned int> seen_by(nodes.n_local(), invalid);
    for (unsigned int order = 0; order < nodes_in_order.size(); ++order)
      {
        const unsigned int node = nodes_in_order[order];
        for (std::size_t k = element_start[node]; k < element_start[node + 1];
             ++k)
          for (std::size_t i = elements.start[element_of[k]];
               i < elements.start[element_of[k] + 1];
               ++i)
            {
              const unsigned int other = node_order[elements.node[i]];
              if (other == invalid || seen_by[other] == order ||
                  (system.symmetric && other < order))
                continue;
              seen_by[other] = order;
              neighbour.push_back(other);
            }
        if (seen_by[order] != order) // a node that no local element touches
          neighbour.push_back(order);
        std::sort(neighbour.begin() + neighbour_start.back(), neighbour.end());
        unsigned int offset = 0;
        for (std::size_t i = neighbour_start.back(); i < neighbour.size(); ++i)
          {
            neighbour_offset.push_back(offset);
            offset += n_free(nodes_in_order[neighbour[i]]);
          }
        neighbour_start.push_back(neighbour.size());
      }
  }



  template <int dim>
  void
  EquationLayout<dim>::build_rows()
  {
    // room for all at once: arrays that grow by themselves take up to twice of
    // what they hold
    std::size_t n_entries = 0;
    for (unsigned int order = 0; order < nodes_in_order.size(); ++order)
      {
        const std::size_t n = n_free(nodes_in_order[order]);
        for (std::size_t k = neighbour_start[order];
             k < neighbour_start[order + 1];
             ++k)
          n_entries += n * n_free(nodes_in_order[neighbour[k]]);
        if (system.symmetric)
          n_entries -= n * (n - 1) / 2;
      }
    AssertThrow(n_entries <
                  static_cast<std::size_t>(std::numeric_limits<int>::max()),
                ExcMessage("The matrix of one rank exceeds 2^31 entries: use "
                           "more ranks."));
    std::vector<double>().swap(system.values);
    std::vector<unsigned int>().swap(system.column);
    system.column.reserve(n_entries);
    system.row_start.clear();
    system.row_start.reserve(system.field.size() + 1);
    system.row_start.push_back(0);
    for (unsigned int order = 0; order < nodes_in_order.size(); ++order)
      {
        const unsigned int node = nodes_in_order[order];
        for (unsigned int a = 0; a < n_components; ++a)
          {
            const unsigned int row = equations[node * n_components + a];
            if (row == invalid)
              continue;
            for (std::size_t k = neighbour_start[order];
                 k < neighbour_start[order + 1];
                 ++k)
              for (unsigned int b = 0; b < n_components; ++b)
                {
                  const unsigned int column =
                    equations[nodes_in_order[neighbour[k]] * n_components + b];
                  if (column != invalid && (!system.symmetric || column >= row))
                    system.column.push_back(column);
                }
            system.row_start.push_back(system.column.size());
          }
      }
    AssertDimension(system.column.size(), n_entries);
  }



  template <int dim>
  void
  EquationLayout<dim>::find_blocks(const ElementNodes &own,
                                   const ElementNodes &elements)
  {
    std::size_t n_blocks = 0;
    for (unsigned int e = 0; e < elements.size(); ++e)
      {
        const std::size_t n = elements.start[e + 1] - elements.start[e];
        n_blocks += system.symmetric ? n * (n + 1) / 2 : n * n;
      }
    std::vector<unsigned int>().swap(block_offset);
    block_offset.reserve(n_blocks);
    block_start.assign(1, 0);
    block_start.reserve(elements.size() + 1);
    element_is_constrained.assign(elements.size(), 0);
    for (unsigned int e = 0; e < elements.size(); ++e)
      {
        const unsigned int *const node =
          elements.node.data() + elements.start[e];
        const unsigned int n     = elements.start[e + 1] - elements.start[e];
        const unsigned int n_own = own.start[e + 1] - own.start[e];
        for (unsigned int I = 0; I < n; ++I)
          {
            if (I < n_own && n_free(node[I]) < n_components)
              element_is_constrained[e] = 1;
            for (unsigned int J = (system.symmetric ? I : 0); J < n; ++J)
              {
                unsigned int row    = node_order[node[I]],
                             column = node_order[node[J]];
                if (system.symmetric && column < row)
                  std::swap(row, column);
                if (row == invalid || column == invalid)
                  {
                    block_offset.push_back(0); // no entries
                    continue;
                  }
                const auto begin = neighbour.begin() + neighbour_start[row];
                const auto end   = neighbour.begin() + neighbour_start[row + 1];
                const std::size_t k =
                  std::lower_bound(begin, end, column) - neighbour.begin();
                block_offset.push_back(neighbour_offset[k]);
              }
          }
        block_start.push_back(block_offset.size());
      }
  }



  template <int dim>
  void
  EquationLayout<dim>::add_block(const unsigned int row_node,
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
  EquationLayout<dim>::add_free_element(const unsigned int  e,
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
  EquationLayout<dim>::add(const unsigned int        e,
                           const unsigned int *const node,
                           const unsigned int        n_nodes,
                           const double *const       matrix)
  {
    AssertIndexRange(e, element_is_constrained.size());
    AssertDimension(system.values.size(), system.column.size());
    if (!element_is_constrained[e])
      {
        if (n_components == dim)
          add_free_element<dim>(e, node, n_nodes, matrix);
        else
          add_free_element<dim + 1>(e, node, n_nodes, matrix);
        return;
      }
    const unsigned int n_dofs = n_nodes * n_components;

    const unsigned int *offset = block_offset.data() + block_start[e];
    for (unsigned int I = 0; I < n_nodes; ++I)
      for (unsigned int J = (system.symmetric ? I : 0); J < n_nodes; ++J)
        {
          const double *const block = matrix + (I * n_dofs + J) * n_components;
          if (system.symmetric && node_order[node[J]] < node_order[node[I]])
            add_block(node[J], node[I], *offset++, block, 1, n_dofs);
          else
            add_block(node[I], node[J], *offset++, block, n_dofs, 1);
        }
  }



  template class EquationLayout<2>;
  template class EquationLayout<3>;
} // namespace isochor
