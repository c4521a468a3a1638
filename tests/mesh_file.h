/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_mesh_file_h
#define isochor_tests_mesh_file_h

// Meshes that tests make themselves, as files of gmsh.

#include <isochor/grid/structured_grid.h>

#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "scene.h"

namespace isochor
{
  namespace test
  {
    /** Write @p cells with @p vertices to the file @p name. @p is_on_side tells
     * whether a vertex is on a side; @p sides are their names. Returns the
     * settings of a scene with this mesh. Collective. */
    template <int dim>
    std::string
    write_mesh(const std::string                                  &name,
               const std::vector<dealii::Point<dim>>              &vertices,
               const std::vector<CellData<dim>>                   &cells,
               const std::vector<std::string>                     &sides,
               const std::function<bool(const unsigned int vertex,
                                        const unsigned int side)> &is_on_side)
    {
      std::ostringstream elements;
      unsigned int       n_elements = 0;
      const unsigned int body       = sides.size() + 1;
      const auto         add        = [&](const unsigned int               type,
                           const unsigned int               id,
                           const std::vector<unsigned int> &corners) {
        elements << ++n_elements << ' ' << type << " 2 " << id << ' ' << id;
        for (const unsigned int v : corners)
          elements << ' ' << v + 1;
        elements << '\n';
      };
      for (const auto &cell : cells)
        {
          add(dim == 2 ? 2 : 4, body, cell.vertices);
          for (unsigned int left_out = 0; left_out <= dim; ++left_out)
            for (unsigned int side = 0; side < sides.size(); ++side)
              {
                std::vector<unsigned int> face = cell.vertices;
                face.erase(face.begin() + left_out);
                if (std::all_of(face.begin(),
                                face.end(),
                                [&](const unsigned int v) {
                                  return is_on_side(v, side);
                                }))
                  add(dim == 2 ? 1 : 2, side + 1, face);
              }
        }
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        {
          std::ofstream out(name);
          out.precision(17);
          out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
              << body << '\n';
          for (unsigned int side = 0; side < sides.size(); ++side)
            out << dim - 1 << ' ' << side + 1 << " \"" << sides[side] << "\"\n";
          out << dim << ' ' << body << " \"body\"\n$EndPhysicalNames\n$Nodes\n"
              << vertices.size() << '\n';
          for (unsigned int v = 0; v < vertices.size(); ++v)
            out << v + 1 << ' ' << vertices[v] << (dim == 2 ? " 0\n" : "\n");
          out << "$EndNodes\n$Elements\n"
              << n_elements << '\n'
              << elements.str() << "$EndElements\n";
        }
      MPI_Barrier(MPI_COMM_WORLD);
      return "Grid/Type = gmsh\nGrid/File = " + name + '\n';
    }

    /** The image by @p place of a unit box, which must not turn it inside out;
     * its sides are called x0, x1, y0, ... */
    template <int dim>
    std::string
    write_image_of_box(
      const std::string               &name,
      const std::vector<unsigned int> &subdivisions,
      const std::function<dealii::Point<dim>(const dealii::Point<dim> &)>
        &place)
    {
      const StructuredGrid<dim> grid(subdivisions, {});
      const auto                vertices = grid.vertices(place);
      std::vector<std::string>  sides;
      for (unsigned int d = 0; d < dim; ++d)
        for (const std::string end : {"0", "1"})
          sides.push_back("xyz"[d] + end);
      return write_mesh<dim>(name,
                             vertices,
                             grid.cells(vertices, "/"),
                             sides,
                             [&grid](const unsigned int v,
                                     const unsigned int side) {
                               return grid.on_side(v, side);
                             });
    }
  } // namespace test
} // namespace isochor

#endif
