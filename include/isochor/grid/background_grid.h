/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_background_grid_h
#define isochor_background_grid_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping_fe.h>

#include <isochor/grid/adaptive_grid.h>
#include <isochor/grid/grid_source.h>
#include <isochor/grid/grid_stretch.h>
#include <isochor/grid/shape_functions.h>
#include <isochor/grid/simplex_geometry.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** A face of the grid on its boundary. */
  struct BoundaryFace
  {
    unsigned int       cell;            ///< active cell index
    unsigned int       opposite_vertex; ///< the cell's vertex not on the face
    types::boundary_id id;
  };

  /**
   * The computational grid: a simplex triangulation, the names of its
   * boundaries, and the cached affine geometry that everything hot works on.
   * The grid does not know the body: the material points decide which cells
   * take part.
   *
   * A grid that GridSource::is_adaptive() can be replaced, see change(). Cells
   * and vertices then get other numbers: what is kept by number for longer than
   * a step has to be told, or to look at mesh_number(). The cells of any other
   * grid may get other owners, see set_owners().
   *
   * If a scene has several bodies, each has a *layer* of its own, see
   * set_layers(): a copy of the mesh at the same place, which is not connected
   * to the others. A body's points are in cells of its layer, so that all that
   * is kept by cell or vertex is kept by body.
   *
   * Every rank knows the whole mesh (parallel::shared::Triangulation); cells
   * are addressed by their active cell index, nodes by their vertex index.
   */
  template <int dim>
  class BackgroundGrid
  {
  public:
    BackgroundGrid(const MPI_Comm comm);

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Generate or read the mesh. */
    void
    create();

    /**
     * Replace the grid of one layer by @p n_layers copies of it. As long as no
     * change() has been made since, cell_in_layer() and vertex_in_layer() say
     * which ones are copies of each other. All iterators are void, and nothing
     * may be attached to the triangulation yet. Collective.
     */
    void
    set_layers(const unsigned int n_layers);

    unsigned int
    n_layers() const
    {
      return cached_geometry->n_layers();
    }

    unsigned int
    layer_of_cell(const unsigned int cell) const
    {
      return cached_geometry->layer_of_cell(cell);
    }

    unsigned int
    layer_of_vertex(const unsigned int vertex) const
    {
      AssertIndexRange(vertex, reference_vertices.size());
      return layers_of_vertices.empty() ? 0 : layers_of_vertices[vertex];
    }

    /** The copy in @p layer of a @p cell of layer 0. */
    unsigned int
    cell_in_layer(const unsigned int cell, const unsigned int layer) const
    {
      AssertIndexRange(cell, cached_geometry->n_cells_of_first_layer());
      AssertIndexRange(layer, n_layers());
      return cell + layer * cached_geometry->n_cells_of_first_layer();
    }

    /** The copy in @p layer of a @p vertex of layer 0; not on adaptive
     * grids. */
    unsigned int
    vertex_in_layer(const unsigned int vertex, const unsigned int layer) const
    {
      Assert(!is_adaptive(), ExcInternalError());
      AssertIndexRange(layer, n_layers());
      return vertex + layer * (reference_vertices.size() / n_layers());
    }

    /** How the grid is made. */
    const GridSource<dim> &
    source() const
    {
      return *grid_source;
    }

    /** What is between its nodes. */
    const ShapeFunctions<dim> &
    shape_functions() const
    {
      return *functions;
    }

    /** Whether change() can be called. */
    bool
    is_adaptive() const
    {
      return forest != nullptr;
    }

    /** The forest of an adaptive grid. */
    const AdaptiveGrid<dim> &
    adaptive_grid() const
    {
      return *forest;
    }

    /**
     * Replace the mesh by that of @p leaves, which belong to the ranks
     * @p owners, as it is at @p time. geometry() stays the same object with
     * other contents; all iterators and indices are void. The old
     * triangulation is returned, so that what is attached to it can let go
     * first. Collective.
     */
    std::unique_ptr<Triangulation<dim>>
    change(const std::vector<Leaf<dim>>    &leaves,
           const std::vector<unsigned int> &owners,
           const double                     time);

    /** By cell before the last change(): one near it now. */
    const std::vector<unsigned int> &
    cells_after_change() const
    {
      return new_cells;
    }

    /** Let the cells belong to the ranks @p owners from now on. Cells and
     * vertices keep their numbers, geometry() all but the owners. Not for
     * adaptive grids. Collective. */
    void
    set_owners(const std::vector<unsigned int> &owners);

    /** Increases with each change() and set_owners(). */
    unsigned int
    mesh_number() const
    {
      return n_meshes;
    }

    /** Where the vertices are at @p time by the prescribed motion of the grid
     * (parameter "Stretch"); where they were generated if there is none. */
    std::vector<Point<dim>>
    vertices_at_time(const double time) const;

    /** Where the vertices were generated. */
    const std::vector<Point<dim>> &
    generated_vertices() const
    {
      return reference_vertices;
    }

    /** Displace the vertices to @p positions (by vertex index). */
    void
    set_vertices(const std::vector<Point<dim>> &positions);

    /** Whether the parameters prescribe a motion of the grid. */
    bool
    is_moving() const
    {
      return stretch.is_moving();
    }

    /** @throws ExcMessage if that moves a plane that the grid doesn't reach. */
    void
    check_motion() const
    {
      stretch.check_planes(reference_vertices);
    }

    /** The id of the boundary called @p name; throws and lists the names if
     * there is none, naming @p parameter. */
    types::boundary_id
    boundary_id(const std::string &name, const std::string &parameter) const;

    /** Names and ids of all boundaries. */
    const std::map<std::string, types::boundary_id> &
    boundary_names() const
    {
      return groups.faces;
    }

    const std::vector<BoundaryFace> &
    boundary_faces() const
    {
      return faces;
    }

    /** Names and ids of the physical groups of cells of a gmsh grid. */
    const std::map<std::string, types::material_id> &
    group_ids() const
    {
      return groups.cells;
    }

    /** Rank that owns the node at vertex @p vertex. */
    unsigned int
    vertex_owner(const unsigned int vertex) const
    {
      return vertex_owners[vertex];
    }

    const parallel::shared::Triangulation<dim> &
    triangulation() const
    {
      return *tria;
    }
    const SimplexGeometry<dim> &
    geometry() const
    {
      return *cached_geometry;
    }
    const Mapping<dim> &
    mapping() const
    {
      return p1_mapping;
    }
    MPI_Comm
    communicator() const
    {
      return comm;
    }

  private:
    /** One whose cells may get other owners once it has been made. */
    class SharedTriangulation : public parallel::shared::Triangulation<dim>
    {
    public:
      using parallel::shared::Triangulation<dim>::Triangulation;

      void
      set_owners(const std::vector<unsigned int> &owners);
    };

    /** An empty one. */
    std::unique_ptr<SharedTriangulation>
    new_triangulation() const;
    /** Take over what follows from a new mesh of @p n_layers. */
    void
    read_mesh_data(const unsigned int n_layers);
    /** Make the mesh of @p leaves, see change(). */
    std::unique_ptr<Triangulation<dim>>
    mesh_leaves(const std::vector<Leaf<dim>>    &leaves,
                const std::vector<unsigned int> &owners,
                const unsigned int               n_layers,
                const double                     time);
    /** By layer: its first cell; and behind the last one. */
    std::vector<unsigned int>
    first_cells_of_layers(const unsigned int n_layers) const;
    void
                                          collect_boundary();
    const MPI_Comm                        comm;
    std::unique_ptr<GridSource<dim>>      grid_source;
    std::unique_ptr<ShapeFunctions<dim>>  functions;
    GridStretch<dim>                      stretch;
    std::unique_ptr<SharedTriangulation>  tria;
    MappingFE<dim>                        p1_mapping;
    std::unique_ptr<SimplexGeometry<dim>> cached_geometry;
    std::unique_ptr<AdaptiveGrid<dim>>    forest;
    unsigned int                          n_meshes = 0;
    std::vector<unsigned int>             new_cells;
    MeshGroups                            groups; ///< names and their ids
    std::vector<BoundaryFace>             faces;
    std::vector<unsigned int>             vertex_owners;
    std::vector<unsigned int> layers_of_vertices; ///< empty if there is one
    /** Vertices as generated, before any motion of the grid. */
    std::vector<Point<dim>> reference_vertices;
  };
} // namespace isochor

#endif
