/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <isochor/grid/near_numbers.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>
#include <vector>

namespace isochor
{
  namespace
  {
    /** The new number of each vertex of @p mesh. */
    template <int dim>
    std::vector<types::global_dof_index>
    near_vertex_numbers(const Triangulation<dim> &mesh)
    {
      DynamicSparsityPattern neighbours(mesh.n_vertices(), mesh.n_vertices());
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int i : cell->vertex_indices())
          for (const unsigned int j : cell->vertex_indices())
            if (i != j)
              neighbours.add(cell->vertex_index(i), cell->vertex_index(j));
      std::vector<types::global_dof_index> numbers(mesh.n_vertices());
      SparsityTools::reorder_Cuthill_McKee(neighbours, numbers);
      return numbers;
    }

    /** By the lowest number of a vertex, the next one, and so on. */
    template <int dim>
    void
    sort_by_vertices(std::vector<CellData<dim>> &cells)
    {
      std::vector<std::pair<std::array<unsigned int, dim + 1>, unsigned int>>
        order(cells.size());
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          auto &[vertices, cell] = order[c];
          std::copy_n(cells[c].vertices.begin(), dim + 1, vertices.begin());
          std::sort(vertices.begin(), vertices.end());
          cell = c;
        }
      std::sort(order.begin(), order.end());
      std::vector<CellData<dim>> sorted;
      sorted.reserve(cells.size());
      for (const auto &entry : order)
        sorted.push_back(cells[entry.second]);
      cells.swap(sorted);
    }
  } // namespace



  template <int dim>
  void
  copy_with_near_numbers(const Triangulation<dim> &mesh,
                         Triangulation<dim>       &numbered)
  {
    AssertDimension(mesh.n_levels(), 1u);
    using Face = std::conditional_t<dim == 2, CellData<1>, CellData<2>>;
    const auto              numbers = near_vertex_numbers(mesh);
    std::vector<Point<dim>> vertices(mesh.n_vertices());
    for (unsigned int v = 0; v < vertices.size(); ++v)
      vertices[numbers[v]] = mesh.get_vertices()[v];

    std::vector<CellData<dim>> cells;
    std::vector<Face>          boundary;
    for (const auto &cell : mesh.active_cell_iterators())
      {
        cells.emplace_back(dim + 1);
        for (const unsigned int i : cell->vertex_indices())
          cells.back().vertices[i] = numbers[cell->vertex_index(i)];
        cells.back().material_id = cell->material_id();
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              boundary.emplace_back(dim);
              for (const unsigned int i : face->vertex_indices())
                boundary.back().vertices[i] = numbers[face->vertex_index(i)];
              boundary.back().boundary_id = face->boundary_id();
            }
      }
    sort_by_vertices(cells);

    SubCellData faces;
    if constexpr (dim == 2)
      faces.boundary_lines = boundary;
    else
      faces.boundary_quads = boundary;
    numbered.create_triangulation(vertices, cells, faces);
  }



  template void
  copy_with_near_numbers<2>(const Triangulation<2> &, Triangulation<2> &);
  template void
  copy_with_near_numbers<3>(const Triangulation<3> &, Triangulation<3> &);
} // namespace isochor
