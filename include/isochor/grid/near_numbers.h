/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_near_numbers_h
#define isochor_near_numbers_h

#include <deal.II/grid/tria.h>

namespace isochor
{
  using namespace dealii;

  /**
   * Make the empty @p numbered of the vertices and simplices of @p mesh, with
   * their boundary and material ids, numbered so that neighbours have numbers
   * that are near to each other: vertices in the order of Cuthill & McKee
   * (Proc. 24th ACM Nat. Conf. (1969) 157-172), cells by their lowest vertices.
   * What neighbours have in common is then still in the cache when a loop over
   * the cells comes to the next one. gmsh's numbers jump through the mesh:
   * adding the elements to the matrix took four times as long with them.
   */
  template <int dim>
  void
  copy_with_near_numbers(const Triangulation<dim> &mesh,
                         Triangulation<dim>       &numbered);
} // namespace isochor

#endif
