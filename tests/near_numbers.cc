/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A mesh whose vertices and cells are numbered by chance gets numbers that are
// near for neighbours, and is the same mesh otherwise.

#include <deal.II/grid/grid_generator.h>

#include <isochor/grid/near_numbers.h>

#include <map>
#include <numeric>
#include <random>

#include "scene.h"

using namespace isochor;

/** A square or cube of n^dim cells, each of some simplices, with ids and in an
 * order by chance. */
template <int dim>
void
make_shuffled_mesh(const unsigned int n, Triangulation<dim> &shuffled)
{
  Triangulation<dim> mesh;
  GridGenerator::subdivided_hyper_cube_with_simplices(mesh, n);
  std::mt19937              random(1);
  std::vector<unsigned int> number(mesh.n_vertices());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), random);

  std::vector<Point<dim>> vertices(mesh.n_vertices());
  for (unsigned int v = 0; v < vertices.size(); ++v)
    vertices[number[v]] = mesh.get_vertices()[v];
  std::vector<CellData<dim>> cells;
  SubCellData                boundary;
  for (const auto &cell : mesh.active_cell_iterators())
    {
      cells.emplace_back(dim + 1);
      for (const unsigned int i : cell->vertex_indices())
        cells.back().vertices[i] = number[cell->vertex_index(i)];
      cells.back().material_id = cell->center()[0] < 0.5 ? 3 : 7;
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          {
            const auto add = [&](auto &faces) {
              faces.emplace_back(dim);
              for (const unsigned int i : face->vertex_indices())
                faces.back().vertices[i] = number[face->vertex_index(i)];
              faces.back().boundary_id = face->center()[0] > 0 ? 4 : 2;
            };
            if constexpr (dim == 2)
              add(boundary.boundary_lines);
            else
              add(boundary.boundary_quads);
          }
    }
  std::shuffle(cells.begin(), cells.end(), random);
  shuffled.create_triangulation(vertices, cells, boundary);
}

/** The ids of all cells and faces, by their centres. */
template <int dim>
std::map<std::array<long, dim>, std::pair<double, std::vector<unsigned int>>>
describe(const Triangulation<dim> &mesh)
{
  const auto place = [](const Point<dim> &x) {
    std::array<long, dim> rounded;
    for (unsigned int d = 0; d < dim; ++d)
      rounded[d] = std::lround(1e6 * x[d]);
    return rounded;
  };
  std::map<std::array<long, dim>, std::pair<double, std::vector<unsigned int>>>
    found;
  for (const auto &cell : mesh.active_cell_iterators())
    {
      auto &[volume, ids] = found[place(cell->center())];
      volume += std::round(1e9 * cell->measure());
      ids.push_back(cell->material_id());
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          found[place(face->center())].second.push_back(face->boundary_id());
    }
  return found;
}

/** The mean over the cells of the largest difference of numbers in a cell, and
 * that of the lowest numbers of successive cells. */
template <int dim>
std::pair<double, double>
distances(const Triangulation<dim> &mesh)
{
  double       within = 0, between = 0;
  unsigned int previous = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    {
      unsigned int lowest = mesh.n_vertices(), highest = 0;
      for (const unsigned int i : cell->vertex_indices())
        {
          lowest  = std::min(lowest, cell->vertex_index(i));
          highest = std::max(highest, cell->vertex_index(i));
        }
      within += highest - lowest;
      between += std::abs(double(lowest) - previous);
      previous = lowest;
    }
  const unsigned int n = mesh.n_active_cells();
  return {within / n, between / n};
}

template <int dim>
void
test_numbers(const unsigned int n)
{
  const std::string  name = "dim " + std::to_string(dim) + ", ";
  Triangulation<dim> shuffled, numbered;
  make_shuffled_mesh(n, shuffled);
  copy_with_near_numbers(shuffled, numbered);
  test::check(name + "the same vertices, cells and ids",
              numbered.n_vertices() == shuffled.n_vertices() &&
                numbered.n_active_cells() == shuffled.n_active_cells() &&
                describe(numbered) == describe(shuffled),
              std::to_string(numbered.n_active_cells()) + " cells");
  // a level of Cuthill & McKee is at most a front through the mesh: its nodes
  // are those of a plane of the lattice, of a diagonal one if it comes worst
  const double front           = dim * std::pow(n + 1, dim - 1);
  const auto [within, between] = distances(numbered);
  const auto [before, then]    = distances(shuffled);
  test::check(name + "numbers in a cell are near",
              within < front && within < before / 3,
              std::to_string(within) + ", before " + std::to_string(before));
  test::check(name + "and so are those of successive cells",
              between <= 1 && then > 1,
              std::to_string(between) + ", before " + std::to_string(then));
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_numbers<2>(32);
  test_numbers<3>(8);
  return 0;
}
