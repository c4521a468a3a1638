/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/structured_grid.h>

#include <algorithm>
#include <utility>

namespace isochor
{
  namespace
  {
    /**
     * The d! simplices of Kuhn's triangulation of a unit cube, each the path
     * from corner 0 to the opposite corner along one order of the axes. The
     * cube's diagonal is "/" in 2D. Corners are numbered in binary.
     */
    template <int dim>
    std::vector<std::array<unsigned int, dim + 1>>
    kuhn_simplices()
    {
      std::vector<std::array<unsigned int, dim + 1>> simplices;
      std::array<unsigned int, dim>                  axes;
      for (unsigned int d = 0; d < dim; ++d)
        axes[d] = d;
      do
        {
          std::array<unsigned int, dim + 1> simplex{};
          for (unsigned int d = 0; d < dim; ++d)
            simplex[d + 1] = simplex[d] + (1u << axes[d]);
          simplices.push_back(simplex);
        }
      while (std::next_permutation(axes.begin(), axes.end()));
      return simplices;
    }
  } // namespace



  template <int dim>
  StructuredGrid<dim>::StructuredGrid(
    const std::vector<unsigned int> &subdivisions,
    const std::vector<double>       &offset)
    : offset(offset)
    , n_vertices(1)
    , n_boxes(1)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        n[d]      = subdivisions[d];
        stride[d] = n_vertices;
        n_vertices *= n[d] + 1;
        n_boxes *= n[d];
      }
  }



  template <int dim>
  std::array<unsigned int, dim>
  StructuredGrid<dim>::lattice_indices(unsigned int vertex) const
  {
    std::array<unsigned int, dim> index;
    for (unsigned int d = 0; d < dim; ++d)
      {
        index[d] = vertex % (n[d] + 1);
        vertex /= n[d] + 1;
      }
    return index;
  }



  template <int dim>
  std::array<unsigned int, dim>
  StructuredGrid<dim>::box_indices(unsigned int box) const
  {
    std::array<unsigned int, dim> index;
    for (unsigned int d = 0; d < dim; ++d)
      {
        index[d] = box % n[d];
        box /= n[d];
      }
    return index;
  }



  template <int dim>
  unsigned int
  StructuredGrid<dim>::box_vertex(const std::array<unsigned int, dim> &box,
                                  const unsigned int corner) const
  {
    unsigned int vertex = 0;
    for (unsigned int d = 0; d < dim; ++d)
      vertex += (box[d] + ((corner >> d) & 1u)) * stride[d];
    return vertex;
  }



  template <int dim>
  bool
  StructuredGrid<dim>::on_side(const unsigned int vertex,
                               const unsigned int side) const
  {
    const unsigned int d = side / 2;
    return lattice_indices(vertex)[d] == (side % 2 == 0 ? 0 : n[d]);
  }



  template <int dim>
  std::vector<Point<dim>>
  StructuredGrid<dim>::vertices(
    const std::function<Point<dim>(const Point<dim> &)> &place) const
  {
    std::vector<Point<dim>> vertices(n_vertices);
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        const auto index = lattice_indices(v);
        Point<dim> unit;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const bool   inside = index[d] > 0 && index[d] < n[d];
            const double moved  = (offset.empty() || !inside ? 0. : offset[d]);
            unit[d]             = (index[d] + moved) / n[d];
          }
        vertices[v] = place(unit);
      }
    return vertices;
  }



  template <int dim>
  std::vector<CellData<dim>>
  StructuredGrid<dim>::cells(const std::vector<Point<dim>> &vertices,
                             const std::string             &diagonals) const
  {
    const bool alternating = diagonals == "alternating";
    const bool backslash   = diagonals == "\\" || diagonals == "backslash";
    const auto simplices   = kuhn_simplices<dim>();
    std::vector<CellData<dim>> cells;
    cells.reserve(n_boxes * simplices.size());
    for (unsigned int box = 0; box < n_boxes; ++box)
      {
        // mirroring a box along an axis turns its diagonal
        const auto   index  = box_indices(box);
        unsigned int mirror = 0;
        for (unsigned int d = 0; d < dim; ++d)
          if ((alternating && index[d] % 2 == 1) || (backslash && d == 0))
            mirror |= 1u << d;
        for (const auto &simplex : simplices)
          {
            CellData<dim> cell(dim + 1);
            for (unsigned int i = 0; i <= dim; ++i)
              cell.vertices[i] = box_vertex(index, simplex[i] ^ mirror);
            Tensor<2, dim> edges;
            for (unsigned int d = 0; d < dim; ++d)
              edges[d] =
                vertices[cell.vertices[d + 1]] - vertices[cell.vertices[0]];
            if (determinant(edges) < 0)
              std::swap(cell.vertices[dim - 1], cell.vertices[dim]);
            cells.push_back(cell);
          }
      }
    return cells;
  }



  template <int dim>
  std::vector<Hypercube<dim>>
  StructuredGrid<dim>::boxes() const
  {
    std::vector<Hypercube<dim>> all(n_boxes);
    for (unsigned int box = 0; box < n_boxes; ++box)
      {
        const auto index = box_indices(box);
        for (unsigned int corner = 0; corner < (1u << dim); ++corner)
          all[box].vertices[corner] = box_vertex(index, corner);
        const unsigned int n_parts = all[box].cells.size();
        for (unsigned int part = 0; part < n_parts; ++part)
          all[box].cells[part] = box * n_parts + part;
      }
    return all;
  }



  template class StructuredGrid<2>;
  template class StructuredGrid<3>;
} // namespace isochor
