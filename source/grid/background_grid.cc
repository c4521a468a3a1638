/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <isochor/base/rounding.h>
#include <isochor/grid/background_grid.h>
#include <isochor/grid/coordinate_bisection.h>
#include <isochor/grid/grid_layers.h>
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
    read_mesh_data(1);
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
    const unsigned int        n_layers_now = cached_geometry ? n_layers() : 1;
    std::vector<unsigned int> new_leaves;
    for (const Leaf<dim> &leaf : forest->leaves())
      new_leaves.push_back(find_leaf<dim>(leaves, leaf.tree, leaf.corner));
    new_cells.clear();
    if (cached_geometry)
      for (unsigned int cell = 0; cell < cached_geometry->n_cells(); ++cell)
        new_cells.push_back(new_leaves[forest->leaf_of_cell(cell)]);
    auto old = mesh_leaves(leaves, owners, n_layers_now, time);
    for (unsigned int &cell : new_cells)
      cell = forest->first_cell(cell);
    return old;
  }



  template <int dim>
  std::unique_ptr<Triangulation<dim>>
  BackgroundGrid<dim>::mesh_leaves(const std::vector<Leaf<dim>>    &leaves,
                                   const std::vector<unsigned int> &owners,
                                   const unsigned int               n_layers,
                                   const double                     time)
  {
    AssertDimension(leaves.size(), owners.size());
    Assert(n_layers > 0, ExcInternalError());
    const SimplexMesh<dim> mesh           = forest->set_leaves(leaves, owners);
    auto                   tria_with_mesh = new_triangulation();
    tria_with_mesh->signals.create.connect([this, &tria_with_mesh]() {
      for (const auto &cell : tria_with_mesh->active_cell_iterators())
        cell->set_subdomain_id(
          forest->leaf_owner(forest->leaf_of_cell(cell->active_cell_index())));
    });
    create_triangulation<dim>(
      mesh,
      [this](const unsigned int cell) {
        return forest->material_of_cell(cell);
      },
      *tria_with_mesh);
    tria_with_mesh.swap(tria);
    read_mesh_data(n_layers);
    if (is_moving())
      set_vertices(vertices_at_time(time));
    return tria_with_mesh;
  }



  template <int dim>
  void
  BackgroundGrid<dim>::set_layers(const unsigned int n_layers)
  {
    Assert(n_layers > 0 && this->n_layers() == 1, ExcInternalError());
    if (n_layers == 1)
      return;
    const SimplexGeometry<dim> &geometry = *cached_geometry;
    const unsigned int          n_cells  = geometry.n_cells();
    AssertThrow(n_cells < numbers::invalid_unsigned_int / n_layers,
                ExcMessage("The scene has " + std::to_string(n_layers) +
                           " bodies, each with a copy of the " +
                           std::to_string(n_cells) +
                           " cells of the grid: these are too many cells. Let "
                           "bodies share a name in <Material points/Bodies>, "
                           "or take larger cells."));
    if (is_adaptive())
      {
        std::vector<Leaf<dim>>    leaves;
        std::vector<unsigned int> owners;
        const CoarseGrid<dim>     coarse = grid_source->coarse_cells(groups);
        const auto                one    = forest->leaves();
        for (unsigned int layer = 0; layer < n_layers; ++layer)
          for (unsigned int i = 0; i < one.size(); ++i)
            {
              leaves.push_back(one[i]);
              leaves.back().tree += layer * coarse.cells.size();
              owners.push_back(forest->leaf_owner(i));
            }
        forest = std::make_unique<AdaptiveGrid<dim>>(
          layers_of_coarse_grid(coarse, n_layers));
        mesh_leaves(leaves, owners, n_layers, 0.);
        return;
      }
    auto layers = new_triangulation();
    layers->signals.create.connect([&]() {
      for (const auto &cell : layers->active_cell_iterators())
        cell->set_subdomain_id(
          geometry.owner(cell->active_cell_index() % n_cells));
    });
    create_triangulation<dim>(
      layers_of_mesh(*tria, reference_vertices, n_layers),
      [&](const unsigned int cell) {
        return geometry.cell_iterator(cell % n_cells)->material_id();
      },
      *layers);
    layers.swap(tria);
    read_mesh_data(n_layers);
    if (is_moving())
      set_vertices(vertices_at_time(0.));
  }



  template <int dim>
  std::vector<unsigned int>
  BackgroundGrid<dim>::first_cells_of_layers(const unsigned int n_layers) const
  {
    AssertDimension(cached_geometry->n_cells() % n_layers, 0u);
    const unsigned int        n_cells = cached_geometry->n_cells();
    std::vector<unsigned int> first_cells;
    for (unsigned int layer = 0; layer <= n_layers; ++layer)
      if (!is_adaptive() || layer == n_layers)
        first_cells.push_back(n_cells / n_layers * layer);
      else
        {
          const unsigned int tree = forest->n_trees() / n_layers * layer;
          first_cells.push_back(
            forest->first_cell(find_leaf<dim>(forest->leaves(), tree, {})));
        }
    first_cells.back() = n_cells;
    return first_cells;
  }



  template <int dim>
  void
  BackgroundGrid<dim>::SharedTriangulation::set_owners(
    const std::vector<unsigned int> &owners)
  {
    AssertDimension(owners.size(), this->n_active_cells());
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
    vertex_owners = owners_of_vertices(*cached_geometry);
  }



  template <int dim>
  void
  BackgroundGrid<dim>::read_mesh_data(const unsigned int n_layers)
  {
    ++n_meshes;
    reference_vertices = tria->get_vertices();
    if (cached_geometry)
      cached_geometry->replace(*tria);
    else
      cached_geometry = std::make_unique<SimplexGeometry<dim>>(*tria);
    layers_of_vertices.clear();
    if (n_layers > 1)
      {
        cached_geometry->set_layers(first_cells_of_layers(n_layers));
        layers_of_vertices.assign(reference_vertices.size(), 0);
        for (unsigned int c = 0; c < cached_geometry->n_cells(); ++c)
          for (const unsigned int v : cached_geometry->vertex_indices(c))
            layers_of_vertices[v] = cached_geometry->layer_of_cell(c);
      }
    functions->set_grid(*grid_source, *cached_geometry);
    vertex_owners = owners_of_vertices(*cached_geometry);
    collect_boundary();
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
    AssertDimension(positions.size(), tria->n_vertices());
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



  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace isochor
