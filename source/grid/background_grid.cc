/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <isochor/grid/background_grid.h>
#include <isochor/grid/coordinate_bisection.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/grid/vertex_owners.h>

#include <algorithm>
#include <set>

namespace isochor
{
  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const MPI_Comm comm)
    : comm(comm)
    , tria(new_triangulation())
    , p1_mapping(FE_SimplexP<dim>(1))
  {}



  template <int dim>
  std::unique_ptr<typename BackgroundGrid<dim>::SharedTriangulation>
  BackgroundGrid<dim>::new_triangulation() const
  {
    return std::make_unique<SharedTriangulation>(
      comm,
      Triangulation<dim>::none,
      false,
      SharedTriangulation::partition_custom_signal);
  }



  template <int dim>
  void
  BackgroundGrid<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Grid");
    GridSource<dim>::declare_sources(prm);
    ShapeFunctions<dim>::declare_functions(prm);
    GridStretch<dim>::declare_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  void
  BackgroundGrid<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Grid");
    grid_source = GridSource<dim>::create(prm.get("Type"), prm);
    functions   = ShapeFunctions<dim>::create(prm);
    stretch.parse_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  void
  BackgroundGrid<dim>::create()
  {
    if (grid_source->is_adaptive())
      {
        forest = std::make_unique<AdaptiveGrid<dim>>(
          grid_source->coarse_cells(groups));
        const auto leaves = forest->leaves();
        change(leaves,
               partition_leaves(std::vector<double>(leaves.size(), 1.),
                                Utilities::MPI::n_mpi_processes(comm)),
               0.);
        return;
      }
    groups = grid_source->make_mesh(*tria);
    read_mesh_data();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks > 1)
      set_owners(
        equal_parts(places_of_cells(reference_vertices, *cached_geometry),
                    n_ranks));
    if (is_moving())
      set_vertices(vertices_at_time(0.));
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
  BackgroundGrid<dim>::SharedTriangulation::set_owners(
    const std::vector<unsigned int> &owners)
  {
    for (const auto &cell : this->active_cell_iterators())
      cell->set_subdomain_id(owners[cell->active_cell_index()]);
    this->update_number_cache();
  }



  template <int dim>
  void
  BackgroundGrid<dim>::set_owners(const std::vector<unsigned int> &owners)
  {
    AssertThrow(!is_adaptive(), ExcInternalError());
    AssertDimension(owners.size(), cached_geometry->n_cells());
    ++n_meshes;
    tria->set_owners(owners);
    cached_geometry->set_owners(owners);
    assign_owners();
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
    functions->set_grid(*grid_source, *cached_geometry);
    assign_owners();
    collect_boundary();
  }



  template <int dim>
  void
  BackgroundGrid<dim>::assign_owners()
  {
    vertex_owners = owners_of_vertices(*cached_geometry);
  }



  template <int dim>
  void
  BackgroundGrid<dim>::collect_boundary()
  {
    faces.clear();
    for (const auto &cell : tria->active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          {
            std::set<unsigned int> on_face;
            for (const unsigned int v : cell->face(f)->vertex_indices())
              on_face.insert(cell->face(f)->vertex_index(v));
            for (const unsigned int v : cell->vertex_indices())
              if (on_face.count(cell->vertex_index(v)) == 0)
                faces.push_back(
                  {cell->active_cell_index(), v, cell->face(f)->boundary_id()});
          }
  }



  template <int dim>
  bool
  BackgroundGrid<dim>::is_moving() const
  {
    return stretch.is_moving();
  }



  template <int dim>
  void
  BackgroundGrid<dim>::check_motion(Warnings &warnings) const
  {
    stretch.check_planes(reference_vertices, warnings);
  }



  template <int dim>
  std::vector<Point<dim>>
  BackgroundGrid<dim>::vertices_at_time(const double time) const
  {
    std::vector<Point<dim>> positions = reference_vertices;
    if (is_moving())
      for (auto &position : positions)
        position = stretch.place(position, time);
    return positions;
  }



  template <int dim>
  void
  BackgroundGrid<dim>::set_vertices(const std::vector<Point<dim>> &positions)
  {
    // deal.II offers write access to vertices only through cells
    for (const auto &cell : tria->active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        cell->vertex(v) = positions[cell->vertex_index(v)];
    cached_geometry->set_vertices(positions);
  }



  template <int dim>
  types::boundary_id
  BackgroundGrid<dim>::boundary_id(const std::string &name,
                                   const std::string &parameter) const
  {
    const auto found = groups.faces.find(name);
    if (found == groups.faces.end())
      {
        std::string known;
        for (const auto &entry : groups.faces)
          known += (known.empty() ? "" : ", ") + entry.first;
        AssertThrow(false,
                    ExcMessage("The parameter <" + parameter +
                               "> names the boundary <" + name +
                               ">, which the grid does not have. " +
                               (known.empty() ?
                                  "No physical group of sides has a name in "
                                  "<Grid/File>." :
                                  "It has: " + known + ".")));
      }
    return found->second;
  }



  template <int dim>
  const std::map<std::string, types::material_id> &
  BackgroundGrid<dim>::group_ids() const
  {
    return groups.cells;
  }



  template <int dim>
  std::string
  BackgroundGrid<dim>::boundary_crossed(const unsigned int cell,
                                        const Point<dim>  &x) const
  {
    const SimplexGeometry<dim> &geometry = *cached_geometry;
    const Point<dim>            start    = cell_centroid(geometry, cell);

    // the first face that the line from there meets: where the barycentric
    // coordinate of the opposite vertex vanishes and the others don't exceed 1
    constexpr double   tolerance = 1e-6;
    double             first     = 1 + tolerance;
    types::boundary_id id        = numbers::invalid_boundary_id;
    for (const BoundaryFace &face : faces)
      {
        const double a =
          geometry.barycentric(face.cell, start)[face.opposite_vertex];
        const double b =
          geometry.barycentric(face.cell, x)[face.opposite_vertex];
        if (!(a >= 0 && b < a))
          continue;
        const double s = a / (a - b);
        const auto   lambda =
          geometry.barycentric(face.cell, Point<dim>(start + s * (x - start)));
        if (s<first && * std::min_element(lambda.begin(), lambda.end())> -
            tolerance)
          {
            first = s;
            id    = face.id;
          }
      }
    for (const auto &name : groups.faces)
      if (name.second == id)
        return name.first;
    return "a boundary without a name";
  }



  template <int dim>
  const std::map<std::string, types::boundary_id> &
  BackgroundGrid<dim>::boundary_names() const
  {
    return groups.faces;
  }



  template <int dim>
  const std::vector<BoundaryFace> &
  BackgroundGrid<dim>::boundary_faces() const
  {
    return faces;
  }



  template <int dim>
  const parallel::shared::Triangulation<dim> &
  BackgroundGrid<dim>::triangulation() const
  {
    return *tria;
  }



  template <int dim>
  const SimplexGeometry<dim> &
  BackgroundGrid<dim>::geometry() const
  {
    return *cached_geometry;
  }



  template <int dim>
  const Mapping<dim> &
  BackgroundGrid<dim>::mapping() const
  {
    return p1_mapping;
  }



  template <int dim>
  MPI_Comm
  BackgroundGrid<dim>::communicator() const
  {
    return comm;
  }



  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace isochor
