/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mesh_reader_h
#define isochor_mesh_reader_h

#include <deal.II/grid/tria.h>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The names of the physical groups of a gmsh mesh and the ids that its
   * faces (boundary_id) and cells (material_id) carry. */
  struct MeshGroups
  {
    std::map<std::string, types::boundary_id> faces;
    std::map<std::string, types::material_id> cells;
  };

  /**
   * Whether the cells with @p id belong to one of the groups @p wanted; true if
   * none is. @p ids are the groups of their mesh.
   * @throws ExcMessage for a name of <Material points/Physical groups> that the
   * mesh doesn't have.
   */
  bool
  in_groups(const types::material_id                         id,
            const std::vector<std::string>                  &wanted,
            const std::map<std::string, types::material_id> &ids);

  /** Put @p file, of gmsh, behind the line @p title; false if there is none. */
  bool
  find_gmsh_section(std::istream &file, const std::string &title);

  /** The version of the format of a gmsh @p file, 2 or 4.1. @p subject starts
   * messages: "The mesh file ... ".
   * @throws ExcMessage for other formats and binary files. */
  double
  check_gmsh_format(std::istream &file, const std::string &subject);

  /** What a mesh must consist of: triangles or tetrahedra, or quadrilaterals
   * or hexahedra. */
  enum class MeshCells
  {
    simplices,
    hypercubes
  };

  /**
   * Read a gmsh .msh file (text, format 2 or 4.1, triangles in 2D, tetrahedra
   * in 3D, or what @p cells says, of first order) into the empty @p tria. Each
   * rank reads it.
   * @p parameter says in messages where the name comes from.
   * @throws ExcMessage if the file is missing, binary, of another version, of
   * second order, or holds no cells or others than @p cells.
   */
  template <int dim>
  MeshGroups
  read_mesh(const std::string  &file_name,
            const std::string  &parameter,
            Triangulation<dim> &tria,
            const MeshCells     cells = MeshCells::simplices);
} // namespace isochor

#endif
