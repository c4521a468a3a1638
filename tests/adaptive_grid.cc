/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Forests and their closure into conforming simplices: random forests on coarse
// grids whose cells have axes in any direction.

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <isochor/grid/adaptive_forest.h>
#include <isochor/grid/conforming_closure.h>

#include <cmath>
#include <iostream>
#include <map>
#include <random>

#include "material_test_tools.h"

using namespace isochor;

template <int dim>
struct Scene
{
  CoarseGrid<dim> coarse;
  double          volume;
};

/** Give each cell random axes of its own (a rotation of the cube). */
template <int dim>
void
rotate_axes(CoarseGrid<dim> &coarse, std::mt19937 &random)
{
  for (unsigned int cell = 0; cell < coarse.cells.size(); ++cell)
    {
      std::array<unsigned int, dim> axes;
      unsigned int                  flips = random() % (1u << dim);
      for (unsigned int d = 0; d < dim; ++d)
        axes[d] = d;
      std::shuffle(axes.begin(), axes.end(), random);
      // of determinant one
      bool odd = false;
      for (unsigned int d = 0; d < dim; ++d)
        {
          odd ^= ((flips >> d) & 1u) != 0;
          for (unsigned int e = 0; e < d; ++e)
            odd ^= axes[e] > axes[d];
        }
      if (odd)
        flips ^= 1u;
      const auto old_cell = coarse.cells[cell];
      const auto old_ids  = coarse.boundary_ids[cell];
      for (unsigned int i = 0; i < (1u << dim); ++i)
        {
          unsigned int old_corner = 0;
          for (unsigned int d = 0; d < dim; ++d)
            if ((((i ^ flips) >> d) & 1u) != 0)
              old_corner |= 1u << axes[d];
          coarse.cells[cell][i] = old_cell[old_corner];
        }
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int s = 0; s < 2; ++s)
          coarse.boundary_ids[cell][2 * d + s] =
            old_ids[2 * axes[d] + (s ^ ((flips >> d) & 1u))];
    }
}

/** The box [0, 1]^dim in n^dim cells, numbered at random. */
template <int dim>
Scene<dim>
box(const unsigned int n, const bool distort, std::mt19937 &random)
{
  const auto power = [n](const unsigned int base) {
    unsigned int p = 1;
    for (unsigned int d = 0; d < dim; ++d)
      p *= n + base;
    return p;
  };
  Scene<dim>                scene{{}, 1.};
  auto                     &coarse = scene.coarse;
  std::vector<unsigned int> number(power(1));
  for (unsigned int v = 0; v < number.size(); ++v)
    number[v] = v;
  std::shuffle(number.begin(), number.end(), random);
  std::uniform_real_distribution<double> shift(-0.2 / n, 0.2 / n);
  coarse.vertices.resize(number.size());
  for (unsigned int v = 0; v < number.size(); ++v)
    {
      unsigned int rest   = v;
      bool         inside = true;
      Point<dim>   x;
      for (unsigned int d = 0; d < dim; ++d, rest /= n + 1)
        {
          x[d]   = static_cast<double>(rest % (n + 1)) / n;
          inside = inside && rest % (n + 1) != 0 && rest % (n + 1) != n;
        }
      for (unsigned int d = 0; d < dim && inside && distort; ++d)
        x[d] += shift(random);
      coarse.vertices[number[v]] = x;
    }
  for (unsigned int cell = 0; cell < power(0); ++cell)
    {
      coarse.cells.emplace_back();
      coarse.boundary_ids.emplace_back();
      coarse.material_ids.push_back(0);
      unsigned int                  rest = cell, base = 0, stride = 1;
      std::array<unsigned int, dim> strides;
      for (unsigned int d = 0; d < dim; ++d, rest /= n, stride *= n + 1)
        {
          base += rest % n * stride;
          strides[d] = stride;
          coarse.boundary_ids.back()[2 * d] =
            rest % n == 0 ? 2 * d : numbers::internal_face_boundary_id;
          coarse.boundary_ids.back()[2 * d + 1] =
            rest % n == n - 1 ? 2 * d + 1 : numbers::internal_face_boundary_id;
        }
      for (unsigned int i = 0; i < (1u << dim); ++i)
        {
          unsigned int v = base;
          for (unsigned int d = 0; d < dim; ++d)
            v += ((i >> d) & 1u) * strides[d];
          coarse.cells.back()[i] = number[v];
        }
    }
  rotate_axes(coarse, random);
  return scene;
}

/** A prism over a regular hexagon: three rhombs around its axis, where an odd
 * number of cells meets. */
template <int dim>
Scene<dim>
hexagon(std::mt19937 &random)
{
  Scene<dim>   scene{{}, 1.5 * std::sqrt(3.)};
  auto        &coarse   = scene.coarse;
  unsigned int n_layers = (dim == 3 ? 2 : 1);
  for (unsigned int layer = 0; layer < n_layers; ++layer)
    for (unsigned int v = 0; v < 7; ++v)
      {
        Point<dim> x;
        if (v > 0)
          {
            x[0] = std::cos(numbers::PI / 3 * v);
            x[1] = std::sin(numbers::PI / 3 * v);
          }
        if (dim == 3)
          x[dim - 1] = layer;
        coarse.vertices.push_back(x);
      }
  for (unsigned int k = 0; k < 3; ++k)
    {
      const std::array<unsigned int, 4> rhomb = {
        {0, 2 * k + 1, (2 * k + 2) % 6 + 1, 2 * k + 2}};
      coarse.cells.emplace_back();
      for (unsigned int layer = 0; layer < n_layers; ++layer)
        for (unsigned int i = 0; i < 4; ++i)
          coarse.cells.back()[4 * layer + i] = 7 * layer + rhomb[i];
      coarse.boundary_ids.emplace_back();
      coarse.boundary_ids.back().fill(numbers::internal_face_boundary_id);
      coarse.boundary_ids.back()[1] = 1;
      coarse.boundary_ids.back()[3] = 3;
      if (dim == 3)
        coarse.boundary_ids.back()[2 * dim - 2] =
          coarse.boundary_ids.back()[2 * dim - 1] = 4;
      coarse.material_ids.push_back(0);
    }
  rotate_axes(coarse, random);
  return scene;
}

/** Leaves near some places of the grid are split. */
template <int dim>
std::vector<Leaf<dim>>
random_forest(const CoarseGrid<dim> &coarse,
              const unsigned int     depth,
              std::mt19937          &random)
{
  const AdaptiveForest<dim>    forest(coarse);
  const ConformingClosure<dim> closure(coarse);
  std::vector<Point<dim>>      places;
  for (unsigned int i = 0; i < 2; ++i)
    {
      std::array<std::uint32_t, dim> place;
      for (auto &x : place)
        x = random() % Leaf<dim>::resolution;
      if (i == 0) // on a face of a tree
        place[random() % dim] = 0;
      places.push_back(closure.position(random() % coarse.cells.size(), place));
    }
  const unsigned int noise = random();
  return forest.refine([&](const Leaf<dim> &leaf) {
    if (leaf.level >= depth)
      return false;
    std::array<std::uint32_t, dim> middle = leaf.corner;
    unsigned int                   hash   = noise + 7919 * leaf.tree;
    for (auto &x : middle)
      {
        x += leaf.size() / 2;
        hash = (hash ^ x) * 2654435761u;
      }
    const Point<dim> x = closure.position(leaf.tree, middle);
    for (const auto &place : places)
      if (x.distance(place) < 1.2 * leaf.size() / Leaf<dim>::resolution)
        return true;
    return leaf.level < 2 && (hash >> 16) % 4 == 0;
  });
}

template <int dim>
double
signed_volume(const SimplexMesh<dim> &mesh, const unsigned int cell)
{
  Tensor<2, dim> edges;
  for (unsigned int i = 0; i < dim; ++i)
    edges[i] = mesh.vertices[mesh.cells[cell][i + 1]] -
               mesh.vertices[mesh.cells[cell][0]];
  return determinant(edges) / (dim == 2 ? 2 : 6);
}

/** What is wrong with the mesh, nothing if all is well. */
template <int dim>
std::string
check(const SimplexMesh<dim> &mesh, const double volume)
{
  using Facet = std::array<unsigned int, dim>;
  std::map<Facet, unsigned int> count;
  const auto                    sorted = [](Facet facet) {
    std::sort(facet.begin(), facet.end());
    return facet;
  };
  double sum = 0, smallest = 1e10;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    {
      sum += signed_volume(mesh, c);
      smallest = std::min(smallest, signed_volume(mesh, c));
      for (unsigned int opposite = 0; opposite <= dim; ++opposite)
        {
          Facet facet;
          for (unsigned int v = 0, i = 0; v <= dim; ++v)
            if (v != opposite)
              facet[i++] = mesh.cells[c][v];
          ++count[sorted(facet)];
        }
    }
  for (const auto &face : mesh.boundary)
    ++count[sorted(face.vertices)];
  for (const auto &facet : count)
    if (facet.second != 2)
      return "a facet counts " + std::to_string(facet.second) + " times";
  if (!(smallest > 0))
    return "volume " + std::to_string(smallest);
  if (!(std::abs(sum / volume - 1) < 1e-12))
    return "volumes add up to " + std::to_string(sum / volume);
  return "";
}

/** Whether all ranks have the same mesh, bit by bit. */
template <int dim>
bool
is_same_everywhere(const SimplexMesh<dim> &mesh)
{
  std::size_t hash = mesh.cells.size();
  const auto  add  = [&hash](const void *data, const std::size_t n) {
    for (std::size_t i = 0; i < n; ++i)
      hash =
        (hash ^ static_cast<const unsigned char *>(data)[i]) * 1099511628211ull;
  };
  add(mesh.vertices.data(), mesh.vertices.size() * sizeof(mesh.vertices[0]));
  add(mesh.cells.data(), mesh.cells.size() * sizeof(mesh.cells[0]));
  return Utilities::MPI::min(hash, MPI_COMM_WORLD) ==
         Utilities::MPI::max(hash, MPI_COMM_WORLD);
}

template <int dim>
void
test_closures(const std::string                               &name,
              const std::function<Scene<dim>(std::mt19937 &)> &make,
              const unsigned int                               n_forests,
              const unsigned int                               depth)
{
  std::string  problem;
  unsigned int n_hanging = 0, n_cells = 0;
  for (unsigned int seed = 1; seed <= n_forests && problem.empty(); ++seed)
    {
      std::mt19937     random(seed);
      const Scene<dim> scene  = make(random);
      const auto       leaves = random_forest(scene.coarse, depth, random);
      ConformingClosure<dim> closure(scene.coarse);
      const auto             mesh = closure.close(leaves);
      problem                     = check(mesh, scene.volume);
      if (!is_same_everywhere(mesh))
        problem = "ranks differ";
      for (unsigned int i = 0; i < leaves.size(); ++i)
        if (find_leaf<dim>(leaves, leaves[i].tree, leaves[i].corner) != i)
          problem = "a leaf is not found";
      n_hanging += mesh.n_hanging_leaves;
      n_cells += mesh.cells.size();
    }
  if (problem.empty() && (n_hanging == 0 || n_cells < 100 * n_forests))
    problem = "nothing is tested";
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    test::report(name + ", dim " + std::to_string(dim),
                 problem.empty(),
                 problem);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto plain = [](auto dimension, const unsigned int n) {
    constexpr int dim = decltype(dimension)::value;
    return [n](std::mt19937 &random) { return box<dim>(n, false, random); };
  };
  using Two   = std::integral_constant<int, 2>;
  using Three = std::integral_constant<int, 3>;
  test_closures<2>("one tree", plain(Two(), 1), 10, 7);
  test_closures<3>("one tree", plain(Three(), 1), 10, 5);
  test_closures<2>(
    "distorted box",
    [](std::mt19937 &random) { return box<2>(3, true, random); },
    20,
    5);
  test_closures<3>(
    "distorted box",
    [](std::mt19937 &random) { return box<3>(2, true, random); },
    30,
    4);
  test_closures<2>("hexagon", hexagon<2>, 20, 5);
  test_closures<3>("hexagon", hexagon<3>, 30, 4);
  return 0;
}
