/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_mesh_h
#define isochor_surface_mesh_h

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Segments in the plane or triangles in space, in any order and
   * orientation. */
  template <int dim>
  struct SurfaceMesh
  {
    std::vector<Point<dim>>                    vertices;
    std::vector<std::array<unsigned int, dim>> facets;
  };

  /**
   * Read a surface: in 3D an STL file, text or binary (`.stl`); or a gmsh file,
   * text of format 2 or 4.1 (`.msh`): the boundary of its triangles (2D) or
   * tetrahedra (3D) or, if it has none, its lines (2D) or triangles (3D).
   * Vertices at the same place are one. @p parameter says in messages where the
   * name comes from.
   * @throws ExcMessage for files that are missing, have another format, or hold
   * no surface.
   */
  template <int dim>
  SurfaceMesh<dim>
  read_surface_mesh(const std::string &file_name, const std::string &parameter);
} // namespace isochor

#endif
