/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_layers_h
#define isochor_grid_layers_h

#include <isochor/grid/conforming_closure.h>

#include <functional>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The disjoint union of @p n_layers copies of the one-level mesh
   * @p triangulation with vertices at @p vertices: cell c and vertex v of it
   * are c + l n_cells and v + l n_vertices of layer l. Faces on the boundary
   * keep their ids. */
  template <int dim>
  SimplexMesh<dim>
  layers_of_mesh(const Triangulation<dim>      &triangulation,
                 const std::vector<Point<dim>> &vertices,
                 const unsigned int             n_layers);

  /** The disjoint union of @p n_layers copies of @p coarse: tree t of it is
   * t + l n_trees of layer l. */
  template <int dim>
  CoarseGrid<dim>
  layers_of_coarse_grid(const CoarseGrid<dim> &coarse,
                        const unsigned int     n_layers);

  /** Let the empty @p triangulation become @p mesh, with the cells' material
   * ids @p material_of_cell. Cells and vertices keep their numbers. */
  template <int dim>
  void
  create_triangulation(
    const SimplexMesh<dim> &mesh,
    const std::function<types::material_id(const unsigned int)>
                       &material_of_cell,
    Triangulation<dim> &triangulation);
} // namespace isochor

#endif
