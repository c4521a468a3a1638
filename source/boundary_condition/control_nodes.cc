/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/keep_each_once.h>
#include <isochor/boundary_condition/control_nodes.h>
#include <isochor/boundary_condition/periodic_vertices.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  std::vector<ControlNode<dim>>
  control_nodes(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    std::vector<ControlNode<dim>> all;
    for (const auto *const condition :
         with_role<const HasControlNodes<dim>>(conditions))
      for (const auto &node : condition->control_nodes())
        all.push_back(node);
    return all;
  }



  template <int dim>
  void
  number_control_nodes(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    unsigned int n = 0;
    for (auto *const condition : with_role<HasControlNodes<dim>>(conditions))
      {
        condition->set_first_control_node(n);
        n += condition->control_nodes().size();
      }
  }



  template <int dim>
  void
  share_held_vertices(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    if (control_nodes(conditions).empty())
      return;
    std::vector<unsigned int> held;
    for (const auto *const condition :
         with_role<const ConstrainsNodes<dim>>(conditions))
      for (const unsigned int vertex : condition->held_vertices())
        held.push_back(vertex);
    std::sort(held.begin(), held.end());
    for (auto *const condition : with_role<HasPeriods>(conditions))
      condition->set_held_vertices(held);
  }



  template <int dim>
  void
  touch_masters(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    ActiveNodes<dim>                                           &nodes,
    const MPI_Comm                                              comm,
    std::vector<unsigned int>                                  &touched)
  {
    // what one condition adds may need more by another one
    bool has_grown = true;
    while (has_grown)
      {
        const std::size_t before = touched.size();
        for (auto *const condition :
             with_role<HasControlNodes<dim>>(conditions))
          condition->touch_masters(nodes, touched);
        if (touched.size() > before)
          keep_each_once(touched);
        has_grown =
          Utilities::MPI::max(touched.size() != before ? 1 : 0, comm) != 0;
      }
  }



  template std::vector<ControlNode<2>>
  control_nodes(const std::vector<std::unique_ptr<BoundaryCondition<2>>> &);
  template void
  number_control_nodes(
    const std::vector<std::unique_ptr<BoundaryCondition<2>>> &);
  template void
  share_held_vertices(
    const std::vector<std::unique_ptr<BoundaryCondition<2>>> &);
  template void
  touch_masters(const std::vector<std::unique_ptr<BoundaryCondition<2>>> &,
                ActiveNodes<2> &,
                const MPI_Comm,
                std::vector<unsigned int> &);
  template std::vector<ControlNode<3>>
  control_nodes(const std::vector<std::unique_ptr<BoundaryCondition<3>>> &);
  template void
  number_control_nodes(
    const std::vector<std::unique_ptr<BoundaryCondition<3>>> &);
  template void
  share_held_vertices(
    const std::vector<std::unique_ptr<BoundaryCondition<3>>> &);
  template void
  touch_masters(const std::vector<std::unique_ptr<BoundaryCondition<3>>> &,
                ActiveNodes<3> &,
                const MPI_Comm,
                std::vector<unsigned int> &);
} // namespace isochor
