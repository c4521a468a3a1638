/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_simplex_geometry_h
#define isochor_simplex_geometry_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * The affine geometry of a grid of triangles or tetrahedra, cached in flat
   * arrays that are addressed by `active_cell_index()`. With the vertices
   * $x_0,\dots,x_d$ of a cell, the barycentric coordinates are
   * @f[ \lambda_i(x) = \nabla\lambda_i \cdot (x - x_0), \quad i = 1,\dots,d,
   *     \qquad \lambda_0 = 1 - \sum_{i>0} \lambda_i , @f]
   * with $\nabla\lambda_i$, $i>0$, the rows of $J^{-1}$ and
   * $J = [x_1-x_0, \dots, x_d-x_0]$. They are the shape functions of P1, and
   * $(\lambda_1,\dots,\lambda_d)$ is the point in deal.II's reference simplex.
   *
   * The vertex coordinates are copied from the triangulation and can be
   * replaced (moving grid) without touching the triangulation; ranks that move
   * the grid must set identical coordinates, because each of them locates its
   * points on its own. The topology is that of the triangulation at
   * construction: after refinement or repartitioning build a new object, or
   * call replace().
   */
  template <int dim>
  class SimplexGeometry
  {
  public:
    /** A value for each vertex of a cell, in the cell's vertex order. */
    using Barycentric = std::array<double, dim + 1>;

    using active_cell_iterator =
      typename Triangulation<dim>::active_cell_iterator;

    /** Marks "no cell behind this face" in neighbours(). */
    static constexpr unsigned int no_cell = numbers::invalid_unsigned_int;

    /**
     * Every active cell of @p triangulation must be a simplex, known to this
     * rank (no artificial cells) and without hanging nodes.
     * @throws ExcMessage if not, or if a cell is degenerate: if its measure is
     * below 1e-12 of its longest edge to the power dim.
     */
    explicit SimplexGeometry(const Triangulation<dim> &triangulation);

    /** Become the geometry of another triangulation, as if constructed anew; of
     * generation() the next one. */
    void
    replace(const Triangulation<dim> &triangulation);

    /** Take over the vertices of the triangulation, as they are now. As
     * set_vertices(). */
    void
    update();

    /**
     * Replace all vertex coordinates, numbered as the vertices of the
     * triangulation.
     * @throws ExcMessage if a cell gets degenerate or is turned inside out; the
     * object then keeps its previous coordinates.
     */
    void
    set_vertices(const std::vector<Point<dim>> &vertices);

    /** Let the cells belong to these ranks, as they do in the triangulation. */
    void
    set_owners(const std::vector<unsigned int> &ranks);

    /** Coordinates by global vertex index. */
    const std::vector<Point<dim>> &
    vertices() const;

    /** Increases with each change of coordinates. For caches that depend. */
    unsigned int
    generation() const;

    unsigned int
    n_cells() const;

    /** Global vertex indices of a cell, in deal.II's order. */
    const std::array<unsigned int, dim + 1> &
    vertex_indices(const unsigned int cell) const;

    /** Entry i: the cell across the face *opposite to vertex i* (not deal.II's
     * face i), or no_cell at the boundary. */
    const std::array<unsigned int, dim + 1> &
    neighbours(const unsigned int cell) const;

    /** Whether det J > 0. */
    bool
    is_positively_oriented(const unsigned int cell) const;

    /** Area (2D) or volume (3D), positive whatever the orientation. */
    double
    measure(const unsigned int cell) const;

    /** Entry i: $\nabla\lambda_i$, constant in the cell (1/length). */
    const std::array<Tensor<1, dim>, dim + 1> &
    gradients(const unsigned int cell) const;

    /** Barycentric coordinates of @p x with respect to a cell; they add up to
     * one and are negative beyond the opposite face. */
    Barycentric
    barycentric(const unsigned int cell, const Point<dim> &x) const;

    /** The point in deal.II's reference simplex. */
    static Point<dim>
    reference_location(const Barycentric &lambda);

    /**
     * Tell that the cells form layers, which are not connected to each other:
     * those from @p first_cells[l] to @p first_cells[l + 1] - 1 are layer l. Of
     * a new triangulation, and after replace(), there is one layer.
     */
    void
    set_layers(const std::vector<unsigned int> &first_cells);

    unsigned int
    n_layers() const;

    /** The layer that a cell belongs to. */
    unsigned int
    layer_of_cell(const unsigned int cell) const;

    /** The first cell of a layer; of n_layers() the number of all cells. */
    unsigned int
    first_cell(const unsigned int layer) const;

    /** How many cells the first layer has: all, if there is one. */
    unsigned int
    n_cells_of_first_layer() const;

    /** The triangulation's iterator to a cell. */
    active_cell_iterator
    cell_iterator(const unsigned int cell) const;

    /** Rank that owns a cell, within communicator(). */
    unsigned int
    owner(const unsigned int cell) const;

    /** Of the triangulation; MPI_COMM_SELF if that is serial. */
    MPI_Comm
    communicator() const;

    const Triangulation<dim> &
    triangulation() const;

  private:
    /** Side by side, as they are used together in the innermost loops. */
    struct AffineMap
    {
      Point<dim>                          origin;
      std::array<Tensor<1, dim>, dim + 1> gradients;
    };

    void
    read_topology();

    const Triangulation<dim> *tria;
    unsigned int              n_changes;
    std::vector<Point<dim>>   vertex_coordinates;

    std::vector<std::array<unsigned int, dim + 1>> cell_vertices;
    std::vector<std::array<unsigned int, dim + 1>> cell_neighbours;
    std::vector<unsigned int>                      owners;
    /** Of each layer, and behind the last one; empty if there is one. */
    std::vector<unsigned int> first_cell_of_layer;
    /** Empty if the mesh isn't refined: they then follow from the numbers, and
     * 16 bytes a cell are saved. */
    std::vector<active_cell_iterator> iterators;

    std::vector<AffineMap> maps;
    std::vector<double>    determinants;
  };


  // ----------------------------------------------------- inline functions

  template <int dim>
  inline const std::vector<Point<dim>> &
  SimplexGeometry<dim>::vertices() const
  {
    return vertex_coordinates;
  }

  template <int dim>
  inline unsigned int
  SimplexGeometry<dim>::generation() const
  {
    return n_changes;
  }

  template <int dim>
  inline unsigned int
  SimplexGeometry<dim>::n_layers() const
  {
    return first_cell_of_layer.empty() ? 1 : first_cell_of_layer.size() - 1;
  }

  template <int dim>
  inline unsigned int
  SimplexGeometry<dim>::layer_of_cell(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    if (first_cell_of_layer.empty())
      return 0;
    return std::upper_bound(first_cell_of_layer.begin(),
                            first_cell_of_layer.end(),
                            cell) -
           first_cell_of_layer.begin() - 1;
  }

  template <int dim>
  inline unsigned int
  SimplexGeometry<dim>::first_cell(const unsigned int layer) const
  {
    AssertIndexRange(layer, n_layers() + 1);
    if (first_cell_of_layer.empty())
      return layer * n_cells();
    return first_cell_of_layer[layer];
  }

  template <int dim>
  inline unsigned int
  SimplexGeometry<dim>::n_cells_of_first_layer() const
  {
    return first_cell(1);
  }

  template <int dim>
  inline unsigned int
  SimplexGeometry<dim>::n_cells() const
  {
    return cell_vertices.size();
  }

  template <int dim>
  inline const std::array<unsigned int, dim + 1> &
  SimplexGeometry<dim>::vertex_indices(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return cell_vertices[cell];
  }

  template <int dim>
  inline const std::array<unsigned int, dim + 1> &
  SimplexGeometry<dim>::neighbours(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return cell_neighbours[cell];
  }

  template <int dim>
  inline bool
  SimplexGeometry<dim>::is_positively_oriented(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return determinants[cell] > 0;
  }

  template <int dim>
  inline double
  SimplexGeometry<dim>::measure(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    constexpr double factorial = (dim == 2) ? 2. : 6.;
    return std::abs(determinants[cell]) / factorial;
  }

  template <int dim>
  inline const std::array<Tensor<1, dim>, dim + 1> &
  SimplexGeometry<dim>::gradients(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return maps[cell].gradients;
  }

  template <int dim>
  inline typename SimplexGeometry<dim>::Barycentric
  SimplexGeometry<dim>::barycentric(const unsigned int cell,
                                    const Point<dim>  &x) const
  {
    AssertIndexRange(cell, n_cells());
    const AffineMap     &map      = maps[cell];
    const Tensor<1, dim> distance = x - map.origin;
    Barycentric          lambda;
    lambda[0] = 1.;
    for (unsigned int i = 1; i <= dim; ++i)
      {
        lambda[i] = map.gradients[i] * distance;
        lambda[0] -= lambda[i];
      }
    return lambda;
  }

  template <int dim>
  inline Point<dim>
  SimplexGeometry<dim>::reference_location(const Barycentric &lambda)
  {
    Point<dim> location;
    for (unsigned int d = 0; d < dim; ++d)
      location[d] = lambda[d + 1];
    return location;
  }

  template <int dim>
  inline typename SimplexGeometry<dim>::active_cell_iterator
  SimplexGeometry<dim>::cell_iterator(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return iterators.empty() ? active_cell_iterator(tria, 0, cell) :
                               iterators[cell];
  }

  template <int dim>
  inline unsigned int
  SimplexGeometry<dim>::owner(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return owners[cell];
  }

  template <int dim>
  inline const Triangulation<dim> &
  SimplexGeometry<dim>::triangulation() const
  {
    return *tria;
  }
} // namespace isochor

#endif
