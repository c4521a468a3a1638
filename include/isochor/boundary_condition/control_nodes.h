/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_control_nodes_h
#define isochor_control_nodes_h

#include <isochor/boundary_condition/boundary_condition.h>

#include <memory>
#include <vector>

// The control nodes of all conditions of a scene: unknowns that are at no node
// of the grid, which nodes follow (HasControlNodes).
namespace isochor
{
  template <int dim>
  std::vector<ControlNode<dim>>
  control_nodes(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions);

  /** Let each of the @p conditions know the number of its first one. */
  template <int dim>
  void
  number_control_nodes(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions);

  /** If there are any, tell the @p conditions with periods what vertices the
   * others hold. */
  template <int dim>
  void
  share_held_vertices(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions);

  /** Add the vertices that followers among @p nodes need to the @p touched
   * ones. Collective. */
  template <int dim>
  void
  touch_masters(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
    ActiveNodes<dim>                                           &nodes,
    const MPI_Comm                                              comm,
    std::vector<unsigned int>                                  &touched);
} // namespace isochor

#endif
