/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_test_locator_tools_h
#define isochor_test_locator_tools_h

// For the tests that search points on a grid: grids, and an oracle that looks
// at all cells and computes barycentric coordinates as ratios of volumes.

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <isochor/grid/simplex_geometry.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <set>
#include <sstream>

using namespace isochor;

constexpr double tolerance = 1e-9;

/** Counts the failures of a test, on all ranks, and prints the first. */
class Check
{
public:
  Check(const std::string &name)
    : name(name)
  {}

  ~Check()
  {
    const unsigned int n = Utilities::MPI::sum(n_failures, MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << name << ": ";
        if (n == 0)
          std::cout << "OK" << std::endl;
        else
          std::cout << n << " failures" << std::endl;
      }
  }

  template <typename... Values>
  void
  require(const bool ok, const Values &...values)
  {
    if (ok)
      return;
    if (n_failures++ < 3)
      {
        std::ostringstream text;
        text.precision(17);
        ((text << values << ' '), ...);
        std::cout << "  " << name << " FAILED: " << text.str() << std::endl;
      }
  }

  void
  require_throw(const std::string           &part_of_message,
                const std::function<void()> &function)
  {
    std::string message = "no exception";
    try
      {
        function();
      }
    catch (const std::exception &exception)
      {
        message = exception.what();
      }
    require(message.find(part_of_message) != std::string::npos,
            "expected an error with '" + part_of_message + "', got",
            message);
  }

private:
  const std::string name;
  unsigned int      n_failures = 0;
};



/** In [0,1), a function of its arguments: the same on all ranks and machines
 * (the finaliser of splitmix64). */
inline double
random(const unsigned int a, const unsigned int b, const unsigned int c)
{
  std::uint64_t z = 0x9e3779b97f4a7c15ull * (1 + a);
  z += 0xd1342543de82ef95ull * (1 + b) + 0x2545f4914f6cdd1dull * (1 + c);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z = z ^ (z >> 31);
  return (z >> 11) * 0x1p-53;
}



template <int dim>
struct Oracle
{
  using Cell = std::array<Point<dim>, dim + 1>;

  Oracle(const Triangulation<dim> &tria)
    : Oracle(tria, tria.get_vertices())
  {}

  Oracle(const Triangulation<dim>      &tria,
         const std::vector<Point<dim>> &vertices)
  {
    for (const auto &cell : tria.active_cell_iterators())
      {
        Cell corners;
        for (unsigned int v = 0; v <= dim; ++v)
          corners[v] = vertices[cell->vertex_index(v)];
        cells.push_back(corners);
      }
  }

  static double
  signed_measure(const Cell &x)
  {
    const Tensor<1, dim> a = x[1] - x[0], b = x[2] - x[0];
    if constexpr (dim == 2)
      return (a[0] * b[1] - a[1] * b[0]) / 2;
    else
      return (cross_product_3d(a, b) * (x[3] - x[0])) / 6;
  }

  std::array<double, dim + 1>
  barycentric(const unsigned int c, const Point<dim> &x) const
  {
    std::array<double, dim + 1> lambda;
    for (unsigned int i = 0; i <= dim; ++i)
      {
        Cell part = cells[c];
        part[i]   = x;
        lambda[i] = signed_measure(part) / signed_measure(cells[c]);
      }
    return lambda;
  }

  double
  lowest(const unsigned int c, const Point<dim> &x) const
  {
    const auto lambda = barycentric(c, x);
    return *std::min_element(lambda.begin(), lambda.end());
  }

  /** The cell that holds x best, and its lowest coordinate. */
  std::pair<unsigned int, double>
  best(const Point<dim> &x) const
  {
    std::pair<unsigned int, double> best(0, -1e300);
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (const double value = lowest(c, x); value > best.second)
        best = {c, value};
    return best;
  }

  /** A point in a random cell. */
  Point<dim>
  random_point(const unsigned int a, const unsigned int b) const
  {
    const auto &cell = cells[random(a, b, 90) * cells.size()];
    Point<dim>  x;
    double      sum = 0;
    for (unsigned int i = 0; i <= dim; ++i)
      {
        const double weight = 0.01 + random(a, b, i);
        x += weight * Tensor<1, dim>(cell[i]);
        sum += weight;
      }
    return Point<dim>(x / sum);
  }

  std::vector<Cell> cells;
};



template <int dim>
void
make_grid(const std::string &name, Triangulation<dim> &tria)
{
  if (name == "box")
    return GridGenerator::subdivided_hyper_rectangle_with_simplices(
      tria,
      std::vector<unsigned int>(dim, dim == 2 ? 12 : 5),
      Point<dim>(),
      dim == 2 ? Point<dim>(3, 2) : Point<dim>(3, 2, 1));

  Triangulation<dim> hypercubes;
  if (name == "L")
    GridGenerator::hyper_L(hypercubes);
  else if (name == "hole")
    {
      // [0,3]^d without [1,2]^d
      Triangulation<dim> full;
      GridGenerator::subdivided_hyper_cube(full, 3, 0., 3.);
      std::set<typename Triangulation<dim>::active_cell_iterator> removed;
      for (const auto &cell : full.active_cell_iterators())
        {
          Point<dim> middle;
          for (unsigned int d = 0; d < dim; ++d)
            middle[d] = 1.5;
          if (cell->center().distance(middle) < 0.1)
            removed.insert(cell);
        }
      GridGenerator::create_triangulation_with_removed_cells(full,
                                                             removed,
                                                             hypercubes);
    }
  else if (name == "shell")
    GridGenerator::hyper_shell(
      hypercubes, Point<dim>(), 0.5, 1., dim == 2 ? 8 : 6);
  else if (name == "ball")
    GridGenerator::hyper_ball(hypercubes);
  if (dim == 2 && name != "hole")
    hypercubes.refine_global(1);
  GridGenerator::convert_hypercube_to_simplex_mesh(hypercubes, tria);
}



template <int dim>
std::vector<Point<dim>>
perturbed_vertices(const Triangulation<dim> &tria, const double size)
{
  std::vector<Point<dim>> vertices    = tria.get_vertices();
  std::vector<bool>       is_boundary = std::vector<bool>(vertices.size());
  for (const auto &cell : tria.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f))
        for (unsigned int v = 0; v < dim; ++v)
          is_boundary[cell->face(f)->vertex_index(v)] = true;
  for (unsigned int v = 0; v < vertices.size(); ++v)
    if (!is_boundary[v])
      for (unsigned int d = 0; d < dim; ++d)
        vertices[v][d] += size * (2 * random(v, d, 0) - 1);
  return vertices;
}



/** A turn about the last axis, a stretch and a shift. */
template <int dim>
Point<dim>
transformed(const Point<dim> &x, const double t)
{
  Point<dim> y = x;
  y[0]         = (1 + t) * (std::cos(t) * x[0] - std::sin(t) * x[1]) + t;
  y[1]         = std::sin(t) * x[0] + std::cos(t) * x[1];
  return y;
}

#endif
