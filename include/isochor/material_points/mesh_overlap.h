/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mesh_overlap_h
#define isochor_mesh_overlap_h

#include <isochor/grid/simplex_geometry.h>

#include <vector>

namespace isochor
{
  /** What find_overlap() has found. */
  template <int dim>
  struct MeshOverlap
  {
    unsigned int n_faces       = 0; ///< on the boundary of the cells asked for
    unsigned int n_overlapping = 0; ///< of these, where cells overlap
    Point<dim>   place;             ///< in two cells, if there is one
  };

  /**
   * Whether cells of a mesh overlap, of those for which @p is_in is not 0.
   *
   * Where they do, the overlap ends at faces that have no neighbour (also if
   * cells are there twice). So it is enough to look whether places at these
   * faces, a little inside of their cell, lie in another cell, too: near the
   * vertices and the middle of each face. Cells that only touch are not found,
   * nor overlaps of less than some hundredths of a cell.
   */
  template <int dim>
  MeshOverlap<dim>
  find_overlap(const SimplexGeometry<dim>       &geometry,
               const std::vector<unsigned char> &is_in);
} // namespace isochor

#endif
