/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/exceptions.h>
#include <deal.II/distributed/tria_base.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <isochor/base/rounding.h>
#include <isochor/grid/simplex_geometry.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** Calls @p function(vertex, face) for each vertex of a cell and the face
     * opposite to it. deal.II numbers the faces of a simplex otherwise. */
    template <typename CellIterator, typename Function>
    void
    for_each_vertex_and_opposite_face(const CellIterator &cell,
                                      const Function     &function)
    {
      for (const unsigned int f : cell->face_indices())
        for (const unsigned int v : cell->vertex_indices())
          {
            bool       is_on_face = false;
            const auto face       = cell->face(f);
            for (unsigned int i = 0; i < face->n_vertices(); ++i)
              is_on_face |= (face->vertex_index(i) == cell->vertex_index(v));
            if (!is_on_face)
              function(v, f);
          }
    }



    template <int dim>
    std::string
    describe_cell(const unsigned int                       cell,
                  const std::array<unsigned int, dim + 1> &indices,
                  const std::vector<Point<dim>>           &vertices)
    {
      std::ostringstream text;
      text.precision(10);
      text << "cell " << cell << " with the vertices";
      for (const unsigned int v : indices)
        text << " (" << vertices[v] << ")";
      return text.str();
    }
  } // namespace



  template <int dim>
  SimplexGeometry<dim>::SimplexGeometry(const Triangulation<dim> &triangulation)
    : tria(&triangulation)
    , n_changes(0)
  {
    read_topology();
    update();
  }



  template <int dim>
  void
  SimplexGeometry<dim>::replace(const Triangulation<dim> &triangulation)
  {
    SimplexGeometry<dim> other(triangulation);
    other.n_changes = n_changes + 1;
    *this           = std::move(other);
  }



  template <int dim>
  void
  SimplexGeometry<dim>::set_owners(const std::vector<unsigned int> &ranks)
  {
    AssertDimension(ranks.size(), owners.size());
    owners = ranks;
  }



  template <int dim>
  void
  SimplexGeometry<dim>::set_layers(const std::vector<unsigned int> &first_cells)
  {
    Assert(first_cells.size() >= 2 && first_cells.front() == 0 &&
             first_cells.back() == n_cells() &&
             std::is_sorted(first_cells.begin(), first_cells.end()),
           ExcMessage("Layers must cover all cells, one after the other."));
    first_cell_of_layer = first_cells;
    if (n_layers() == 1)
      first_cell_of_layer.clear();
#ifdef DEBUG
    for (unsigned int cell = 0; cell < n_cells(); ++cell)
      for (const unsigned int neighbour : cell_neighbours[cell])
        Assert(neighbour == no_cell ||
                 layer_of_cell(neighbour) == layer_of_cell(cell),
               ExcMessage("Layers must not be connected."));
#endif
  }



  template <int dim>
  void
  SimplexGeometry<dim>::read_topology()
  {
    const bool is_parallel =
      dynamic_cast<const parallel::TriangulationBase<dim> *>(tria) != nullptr;
    const bool         is_refined = tria->n_levels() > 1;
    const unsigned int n_cells    = tria->n_active_cells();
    cell_vertices.reserve(n_cells);
    cell_neighbours.reserve(n_cells);
    iterators.reserve(is_refined ? n_cells : 0);
    owners.reserve(n_cells);

    for (const auto &cell : tria->active_cell_iterators())
      {
        AssertThrow(cell->reference_cell().is_simplex(),
                    ExcMessage("The grid must consist of triangles (2D) or "
                               "tetrahedra (3D) only, but cell " +
                               std::to_string(cell->active_cell_index()) +
                               " is a " + cell->reference_cell().to_string() +
                               "."));
        AssertThrow(!cell->is_artificial(),
                    ExcMessage("Each rank must know all cells: use "
                               "parallel::shared::Triangulation with "
                               "allow_artificial_cells = false."));

        std::array<unsigned int, dim + 1> indices;
        for (const unsigned int v : cell->vertex_indices())
          indices[v] = cell->vertex_index(v);
        cell_vertices.push_back(indices);
        if (is_refined)
          iterators.push_back(cell);
        else
          AssertThrow(static_cast<unsigned int>(cell->index()) ==
                        cell->active_cell_index(),
                      ExcInternalError());
        owners.push_back(is_parallel ? cell->subdomain_id() : 0);

        std::array<unsigned int, dim + 1> neighbours;
        for_each_vertex_and_opposite_face(
          cell, [&](const unsigned int v, const unsigned int f) {
            neighbours[v] = no_cell;
            if (cell->at_boundary(f))
              return;
            const auto neighbour = cell->neighbor(f);
            AssertThrow(neighbour->is_active() &&
                          neighbour->level() == cell->level(),
                        ExcMessage("The grid must have no hanging nodes: "
                                   "refine it everywhere or grade it in the "
                                   "mesh generator."));
            neighbours[v] = neighbour->active_cell_index();
          });
        cell_neighbours.push_back(neighbours);
      }
  }



  template <int dim>
  void
  SimplexGeometry<dim>::update()
  {
    set_vertices(tria->get_vertices());
  }



  template <int dim>
  void
  SimplexGeometry<dim>::set_vertices(const std::vector<Point<dim>> &vertices)
  {
    AssertThrow(vertices.size() == tria->n_vertices(),
                ExcMessage("The grid has " +
                           std::to_string(tria->n_vertices()) +
                           " vertices, but " + std::to_string(vertices.size()) +
                           " coordinates were given."));

    // Into new arrays: an error leaves the object as it was.
    std::vector<AffineMap> new_maps(n_cells());
    std::vector<double>    new_determinants(n_cells());
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        const auto &indices = cell_vertices[c];
        AffineMap  &map     = new_maps[c];
        map.origin          = vertices[indices[0]];

        Tensor<2, dim> jacobian;
        double         longest_edge = 0;
        for (unsigned int i = 0; i <= dim; ++i)
          for (unsigned int j = 0; j < i; ++j)
            {
              const Tensor<1, dim> edge =
                vertices[indices[i]] - vertices[indices[j]];
              longest_edge = std::max(longest_edge, edge.norm());
              if (j == 0)
                for (unsigned int d = 0; d < dim; ++d)
                  jacobian[d][i - 1] = edge[d];
            }

        const double det = determinant(jacobian);
        // Below this rounding leaves about four correct digits in the
        // gradients. False too if a coordinate is not a number.
        AssertThrow(std::abs(det) >
                      rounding::arithmetic * std::pow(longest_edge, dim),
                    ExcMessage("Degenerate grid: " +
                               describe_cell<dim>(c, indices, vertices) +
                               " has no (or no finite) measure."));
        AssertThrow(determinants.empty() || (det > 0) == (determinants[c] > 0),
                    ExcMessage("The moved grid is turned inside out at " +
                               describe_cell<dim>(c, indices, vertices) + "."));
        new_determinants[c] = det;

        const Tensor<2, dim> inverse = invert(jacobian);
        for (unsigned int i = 1; i <= dim; ++i)
          {
            map.gradients[i] = inverse[i - 1];
            map.gradients[0] -= inverse[i - 1];
          }
      }

    vertex_coordinates = vertices;
    maps.swap(new_maps);
    determinants.swap(new_determinants);
    ++n_changes;
  }



  template <int dim>
  MPI_Comm
  SimplexGeometry<dim>::communicator() const
  {
#if DEAL_II_VERSION_GTE(9, 7, 0)
    return tria->get_mpi_communicator();
#else
    return tria->get_communicator();
#endif
  }



  template class SimplexGeometry<2>;
  template class SimplexGeometry<3>;
} // namespace isochor
