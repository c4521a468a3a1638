/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/grid_layers.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  SimplexMesh<dim>
  layers_of_mesh(const Triangulation<dim>      &triangulation,
                 const std::vector<Point<dim>> &vertices,
                 const unsigned int             n_layers)
  {
    AssertDimension(vertices.size(), triangulation.n_vertices());
    AssertDimension(triangulation.n_levels(), 1);
    SimplexMesh<dim> mesh;
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        const unsigned int shift = layer * vertices.size();
        mesh.vertices.insert(mesh.vertices.end(),
                             vertices.begin(),
                             vertices.end());
        for (const auto &cell : triangulation.active_cell_iterators())
          {
            mesh.cells.emplace_back();
            for (unsigned int v = 0; v <= dim; ++v)
              mesh.cells.back()[v] = cell->vertex_index(v) + shift;
            for (const unsigned int f : cell->face_indices())
              if (cell->at_boundary(f))
                {
                  const auto face = cell->face(f);
                  mesh.boundary.push_back({{}, face->boundary_id()});
                  for (unsigned int v = 0; v < dim; ++v)
                    mesh.boundary.back().vertices[v] =
                      face->vertex_index(v) + shift;
                }
          }
      }
    return mesh;
  }



  template <int dim>
  CoarseGrid<dim>
  layers_of_coarse_grid(const CoarseGrid<dim> &coarse,
                        const unsigned int     n_layers)
  {
    Assert(n_layers > 0, ExcInternalError());
    CoarseGrid<dim> layers;
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        layers.vertices.insert(layers.vertices.end(),
                               coarse.vertices.begin(),
                               coarse.vertices.end());
        for (auto cell : coarse.cells)
          {
            for (unsigned int &vertex : cell)
              vertex += layer * coarse.vertices.size();
            layers.cells.push_back(cell);
          }
        layers.boundary_ids.insert(layers.boundary_ids.end(),
                                   coarse.boundary_ids.begin(),
                                   coarse.boundary_ids.end());
        layers.material_ids.insert(layers.material_ids.end(),
                                   coarse.material_ids.begin(),
                                   coarse.material_ids.end());
      }
    return layers;
  }



  template <int dim>
  void
  create_triangulation(
    const SimplexMesh<dim> &mesh,
    const std::function<types::material_id(const unsigned int)>
                       &material_of_cell,
    Triangulation<dim> &triangulation)
  {
    Assert(!mesh.cells.empty(), ExcInternalError());
    std::vector<CellData<dim>> cells;
    cells.reserve(mesh.cells.size());
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        cells.emplace_back(dim + 1);
        std::copy(mesh.cells[c].begin(),
                  mesh.cells[c].end(),
                  cells.back().vertices.begin());
        cells.back().material_id = material_of_cell(c);
      }
    SubCellData boundary;
    for (const auto &face : mesh.boundary)
      if constexpr (dim == 2)
        {
          boundary.boundary_lines.emplace_back(2);
          auto &line = boundary.boundary_lines.back();
          std::copy(face.vertices.begin(),
                    face.vertices.end(),
                    line.vertices.begin());
          line.boundary_id = face.id;
        }
      else
        {
          boundary.boundary_quads.emplace_back(3);
          auto &triangle = boundary.boundary_quads.back();
          std::copy(face.vertices.begin(),
                    face.vertices.end(),
                    triangle.vertices.begin());
          triangle.boundary_id = face.id;
        }
    triangulation.create_triangulation(mesh.vertices, cells, boundary);
  }



  template SimplexMesh<2>
  layers_of_mesh(const Triangulation<2> &,
                 const std::vector<Point<2>> &,
                 const unsigned int);
  template SimplexMesh<3>
  layers_of_mesh(const Triangulation<3> &,
                 const std::vector<Point<3>> &,
                 const unsigned int);
  template CoarseGrid<2>
  layers_of_coarse_grid(const CoarseGrid<2> &, const unsigned int);
  template CoarseGrid<3>
  layers_of_coarse_grid(const CoarseGrid<3> &, const unsigned int);
  template void
  create_triangulation(
    const SimplexMesh<2> &,
    const std::function<types::material_id(const unsigned int)> &,
    Triangulation<2> &);
  template void
  create_triangulation(
    const SimplexMesh<3> &,
    const std::function<types::material_id(const unsigned int)> &,
    Triangulation<3> &);
} // namespace isochor
