/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/equations/invariants.h>
#include <isochor/equations/mixed_system.h>

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
  MixedSystem<dim>::MixedSystem(const ActiveNodes<dim> &nodes)
    : nodes(nodes)
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
    const FreeEntries free_entries = number_free_entries();
    describe_equations(free_entries);
    order_nodes(free_entries);
    collect_neighbours();
    build_rows();
    find_blocks();
    for (auto *list : {&neighbour, &neighbour_offset})
      std::vector<unsigned int>().swap(*list); // needed no more
    return true;
  }



  template <int dim>
  std::vector<std::pair<types::global_dof_index, unsigned int>>
  MixedSystem<dim>::number_free_entries()
  {
    AssertDimension(constrained.size(), nodes.n_local() * n_components);
    const unsigned int n_owned = nodes.n_owned() * n_components;
    const unsigned int n_local = nodes.n_local() * n_components;

    // free unknowns of the owned nodes, one after the other over the ranks
    const auto is_free = [this](const unsigned int entry) {
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
  MixedSystem<dim>::describe_equations(const FreeEntries &sorted)
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
    for (unsigned int eq = 0; eq < n; ++eq)
      {
        const unsigned int entry     = sorted[eq].second;
        const unsigned int component = entry % n_components;
        equations[entry]             = eq;
        system.global_equation[eq]   = sorted[eq].first;
        system.component[eq]         = component;
        system.field[eq] = component < dim ? SparseSystem::Field::displacement :
                                             SparseSystem::Field::pressure;
        const Point<dim> x = nodes.position(entry / n_components);
        for (unsigned int d = 0; d < dim; ++d)
          system.position[eq * dim + d] = x[d];
        if (const ControlNode<dim> *control =
              nodes.control_node(entry / n_components))
          {
            system.rotation_arm.resize(n, 0.); // displacements
            system.rotation_arm[eq] = control->rotation_arm;
          }
      }
  }



  template <int dim>
  void
  MixedSystem<dim>::order_nodes(const FreeEntries &sorted)
  {
    AssertDimension(sorted.size(), system.global_equation.size());
    node_first_free.assign(nodes.n_local() + 1, 0);
    nodes_in_order.clear();
    node_order.assign(nodes.n_local(), invalid);
    for (unsigned int eq = 0; eq < sorted.size(); ++eq)
      {
        const unsigned int node = sorted[eq].second / n_components;
        ++node_first_free[node + 1];
        if (node_order[node] == invalid)
          {
            node_order[node] = nodes_in_order.size();
            nodes_in_order.push_back(node);
          }
        system.node[eq] = node_order[node];
      }
    std::partial_sum(node_first_free.begin(),
                     node_first_free.end(),
                     node_first_free.begin());
  }



  template <int dim>
  void
  MixedSystem<dim>::collect_neighbours()
  {
    const ElementNodes &elements = all_elements();
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
  MixedSystem<dim>::build_rows()
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
  MixedSystem<dim>::find_blocks()
  {
    const ElementNodes &elements = all_elements();
    std::size_t         n_blocks = 0;
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
        const unsigned int n = elements.start[e + 1] - elements.start[e];
        const unsigned int n_own =
          this->elements.start[e + 1] - this->elements.start[e];
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
    AssertDimension(equations.size(), nodes.n_local() * n_components);
    shape(rhs);
    double *const values = rhs.begin();
    unsigned int  next   = 0;
    for (unsigned int i = 0; i < nodes.n_owned() * n_components; ++i)
      if (equations[i] != invalid)
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
      if (equations[i] != invalid)
        field.local_element(i) = values[next++];
    field.update_ghost_values();
    const Followers &followers = tied.followers();
    for (unsigned int k = 0; k < followers.size(); ++k)
      field.local_element(followers.entry[k]) +=
        followers.sum(k, [&](const unsigned int entry) {
          return equations[entry] == invalid ? 0. : field.local_element(entry);
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
