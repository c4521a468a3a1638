/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of BackgroundGrid that make its mesh, and the next one.
#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/grid_tools.h>

#include <isochor/grid/background_grid.h>
#include <isochor/grid/mesh_reader.h>
#include <isochor/grid/structured_grid.h>

#include <algorithm>
#include <array>
#include <set>

namespace isochor
{
  namespace
  {
    const std::array<std::string, 6> side_names = {
      {"left", "right", "bottom", "top", "front", "back"}};
  } // namespace



  template <int dim>
  CoarseGrid<dim>
  BackgroundGrid<dim>::make_coarse_grid()
  {
    if (parameters.coarse_type == "gmsh")
      {
        Triangulation<dim> mesh;
        const MeshGroups   groups = read_mesh<dim>(parameters.file,
                                                 "Grid/File",
                                                 mesh,
                                                 MeshCells::hypercubes);
        names                     = groups.faces;
        group_names               = groups.cells;
        return coarse_grid(mesh);
      }
    for (unsigned int side = 0; side < 2 * dim; ++side)
      names[side_names[side]] = side;
    return coarse_lattice<dim>(parameters.subdivisions,
                               [this](const Point<dim> &unit) {
                                 return parameters.coarse_type == "box" ?
                                          place_in_box(unit) :
                                          place_in_trapezoid(unit);
                               });
  }



  template <int dim>
  std::unique_ptr<Triangulation<dim>>
  BackgroundGrid<dim>::change(const std::vector<Leaf<dim>>    &leaves,
                              const std::vector<unsigned int> &owners,
                              const double                     time)
  {
    std::vector<unsigned int> new_leaves;
    for (const Leaf<dim> &leaf : forest->leaves())
      new_leaves.push_back(find_leaf<dim>(leaves, leaf.tree, leaf.corner));
    new_cells.clear();
    if (cached_geometry)
      for (unsigned int cell = 0; cell < cached_geometry->n_cells(); ++cell)
        new_cells.push_back(new_leaves[forest->leaf_of_cell(cell)]);
    const SimplexMesh<dim> mesh = forest->set_leaves(leaves, owners);
    for (unsigned int &cell : new_cells)
      cell = forest->first_cell(cell);
    std::vector<CellData<dim>> cells;
    cells.reserve(mesh.cells.size());
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        cells.emplace_back(dim + 1);
        std::copy(mesh.cells[c].begin(),
                  mesh.cells[c].end(),
                  cells.back().vertices.begin());
        cells.back().material_id = forest->material_of_cell(c);
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

    auto tria_with_mesh = new_triangulation();
    tria_with_mesh->signals.create.connect([this, &tria_with_mesh]() {
      for (const auto &cell : tria_with_mesh->active_cell_iterators())
        cell->set_subdomain_id(
          forest->leaf_owner(forest->leaf_of_cell(cell->active_cell_index())));
    });
    tria_with_mesh->create_triangulation(mesh.vertices, cells, boundary);
    tria_with_mesh.swap(tria);
    read_mesh_data();
    if (is_moving())
      set_vertices(vertices_at_time(time));
    return tria_with_mesh;
  }



  template <int dim>
  void
  BackgroundGrid<dim>::read_mesh_data()
  {
    ++n_meshes;
    reference_vertices = tria->get_vertices();
    if (cached_geometry)
      cached_geometry->replace(*tria);
    else
      cached_geometry = std::make_unique<SimplexGeometry<dim>>(*tria);
    assign_owners();
    collect_boundary();
  }



  template <int dim>
  Point<dim>
  BackgroundGrid<dim>::place_in_box(const Point<dim> &unit) const
  {
    Point<dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = parameters.lower[d] +
                 unit[d] * (parameters.upper[d] - parameters.lower[d]);
    return place;
  }



  template <int dim>
  Point<dim>
  BackgroundGrid<dim>::place_in_trapezoid(const Point<dim> &unit) const
  {
    const auto    &c = parameters.corners;
    const double   s = unit[0], t = unit[1];
    const Point<2> in_plane =
      (1 - s) * (1 - t) * c[0] + s * (1 - t) * Tensor<1, 2>(c[1]) +
      s * t * Tensor<1, 2>(c[2]) + (1 - s) * t * Tensor<1, 2>(c[3]);
    Point<dim> place;
    place[0] = in_plane[0];
    place[1] = in_plane[1];
    if (dim == 3)
      place[dim - 1] = unit[dim - 1] * parameters.depth;
    return place;
  }



  template <int dim>
  void
  BackgroundGrid<dim>::create_structured()
  {
    const StructuredGrid<dim> lattice(parameters.subdivisions,
                                      parameters.offset);
    const auto vertices = lattice.vertices([this](const Point<dim> &unit) {
      return parameters.type == "box" ? place_in_box(unit) :
                                        place_in_trapezoid(unit);
    });
    tria->create_triangulation(vertices,
                               lattice.cells(vertices, parameters.diagonals),
                               SubCellData());

    for (unsigned int side = 0; side < 2 * dim; ++side)
      names[side_names[side]] = side;
    for (const auto &cell : tria->active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          for (unsigned int side = 0; side < 2 * dim; ++side)
            {
              bool on_side = true;
              for (const unsigned int v : cell->face(f)->vertex_indices())
                on_side = on_side &&
                          lattice.on_side(cell->face(f)->vertex_index(v), side);
              if (on_side)
                cell->face(f)->set_boundary_id(side);
            }
  }



  template <int dim>
  void
  BackgroundGrid<dim>::read_gmsh()
  {
    const MeshGroups groups =
      read_mesh<dim>(parameters.file, "Grid/File", *tria);
    names       = groups.faces;
    group_names = groups.cells;
  }



  template CoarseGrid<2>
  BackgroundGrid<2>::make_coarse_grid();
  template std::unique_ptr<Triangulation<2>>
  BackgroundGrid<2>::change(const std::vector<Leaf<2>> &,
                            const std::vector<unsigned int> &,
                            const double);
  template void
  BackgroundGrid<2>::read_mesh_data();
  template void
  BackgroundGrid<2>::create_structured();
  template void
  BackgroundGrid<2>::read_gmsh();
  template CoarseGrid<3>
  BackgroundGrid<3>::make_coarse_grid();
  template std::unique_ptr<Triangulation<3>>
  BackgroundGrid<3>::change(const std::vector<Leaf<3>> &,
                            const std::vector<unsigned int> &,
                            const double);
  template void
  BackgroundGrid<3>::read_mesh_data();
  template void
  BackgroundGrid<3>::create_structured();
  template void
  BackgroundGrid<3>::read_gmsh();
} // namespace isochor
