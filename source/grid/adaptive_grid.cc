/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/adaptive_grid.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace isochor
{
  template <int dim>
  CoarseGrid<dim>
  coarse_lattice(const std::vector<unsigned int>                     &n,
                 const std::function<Point<dim>(const Point<dim> &)> &place)
  {
    AssertDimension(n.size(), dim);
    CoarseGrid<dim> coarse;
    unsigned int    n_vertices = 1, n_cells = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        n_vertices *= n[d] + 1;
        n_cells *= n[d];
      }
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        Point<dim>   unit;
        unsigned int rest = v;
        for (unsigned int d = 0; d < dim; rest /= n[d] + 1, ++d)
          unit[d] = static_cast<double>(rest % (n[d] + 1)) / n[d];
        coarse.vertices.push_back(place(unit));
      }
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        std::array<types::boundary_id, 2 * dim> ids;
        std::array<unsigned int, dim>           stride;
        unsigned int                            rest = c, lowest = 0;
        for (unsigned int d = 0; d < dim; rest /= n[d], ++d)
          {
            stride[d] = (d == 0 ? 1 : stride[d - 1] * (n[d - 1] + 1));
            lowest += rest % n[d] * stride[d];
            ids[2 * d] =
              rest % n[d] == 0 ? 2 * d : numbers::internal_face_boundary_id;
            ids[2 * d + 1] = rest % n[d] == n[d] - 1 ?
                               2 * d + 1 :
                               numbers::internal_face_boundary_id;
          }
        std::array<unsigned int, CoarseGrid<dim>::n_corners> cell;
        for (unsigned int i = 0; i < cell.size(); ++i)
          {
            cell[i] = lowest;
            for (unsigned int d = 0; d < dim; ++d)
              cell[i] += ((i >> d) & 1u) * stride[d];
          }
        coarse.cells.push_back(cell);
        coarse.boundary_ids.push_back(ids);
        coarse.material_ids.push_back(0);
      }
    return coarse;
  }



  template <int dim>
  CoarseGrid<dim>
  coarse_grid(const Triangulation<dim> &mesh)
  {
    CoarseGrid<dim> coarse;
    coarse.vertices = mesh.get_vertices();
    for (const auto &cell : mesh.active_cell_iterators())
      {
        coarse.cells.emplace_back();
        coarse.boundary_ids.emplace_back();
        for (const unsigned int v : cell->vertex_indices())
          coarse.cells.back()[v] = cell->vertex_index(v);
        for (const unsigned int f : cell->face_indices())
          coarse.boundary_ids.back()[f] = cell->at_boundary(f) ?
                                            cell->face(f)->boundary_id() :
                                            numbers::internal_face_boundary_id;
        coarse.material_ids.push_back(cell->material_id());
      }
    return coarse;
  }



  template <int dim>
  AdaptiveGrid<dim>::AdaptiveGrid(const CoarseGrid<dim> &coarse)
    : forest(coarse)
    , closure(coarse)
    , materials(coarse.material_ids)
  {
    current = forest.refine([](const Leaf<dim> &) { return false; });
    owners.assign(current.size(), 0);
    // volumes of the coarse cells by their simplices
    const SimplexMesh<dim> mesh = closure.close(current);
    for (unsigned int t = 0; t < current.size(); ++t)
      {
        double volume = 0;
        for (unsigned int c = mesh.first_cell[t]; c < mesh.first_cell[t + 1];
             ++c)
          {
            Tensor<2, dim> edges;
            for (unsigned int i = 0; i < dim; ++i)
              edges[i] = mesh.vertices[mesh.cells[c][i + 1]] -
                         mesh.vertices[mesh.cells[c][0]];
            volume += determinant(edges) / (dim == 2 ? 2 : 6);
          }
        tree_sizes.push_back(std::pow(volume, 1. / dim));
      }
  }



  template <int dim>
  std::vector<Leaf<dim>>
  AdaptiveGrid<dim>::refine(
    const typename AdaptiveForest<dim>::Criterion &is_split) const
  {
    return forest.refine(is_split);
  }



  template <int dim>
  SimplexMesh<dim>
  AdaptiveGrid<dim>::set_leaves(const std::vector<Leaf<dim>>    &new_leaves,
                                const std::vector<unsigned int> &new_owners)
  {
    AssertDimension(new_leaves.size(), new_owners.size());
    SimplexMesh<dim> mesh = closure.close(new_leaves);
    current               = new_leaves;
    owners                = new_owners;
    first_cells           = mesh.first_cell;
    n_hanging             = mesh.n_hanging_leaves;
    leaf_of_cells.resize(mesh.cells.size());
    for (unsigned int leaf = 0; leaf < current.size(); ++leaf)
      std::fill(leaf_of_cells.begin() + first_cells[leaf],
                leaf_of_cells.begin() + first_cells[leaf + 1],
                leaf);
    return mesh;
  }



  template <int dim>
  double
  AdaptiveGrid<dim>::size(const unsigned int tree, const double level) const
  {
    return tree_sizes[tree] * std::exp2(-level);
  }



  template <int dim>
  std::string
  AdaptiveGrid<dim>::save_state() const
  {
    std::ostringstream              stream(std::ios::binary);
    boost::archive::binary_oarchive archive(stream);
    archive << current << owners;
    return stream.str();
  }



  template <int dim>
  void
  AdaptiveGrid<dim>::load_state(const std::string         &state,
                                std::vector<Leaf<dim>>    &leaves,
                                std::vector<unsigned int> &owners)
  {
    std::istringstream              stream(state, std::ios::binary);
    boost::archive::binary_iarchive archive(stream);
    archive >> leaves >> owners;
  }



  std::vector<unsigned int>
  partition_leaves(const std::vector<double> &weights,
                   const unsigned int         n_ranks)
  {
    Assert(n_ranks > 0, ExcInternalError());
    double sum = 0;
    for (const double weight : weights)
      sum += weight;
    std::vector<unsigned int> owners(weights.size());
    double                    before = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
      {
        const double middle = (before + weights[i] / 2) / sum;
        owners[i] = std::min<unsigned int>(n_ranks - 1, middle * n_ranks);
        before += weights[i];
      }
    return owners;
  }



  template <int dim>
  std::vector<unsigned int>
  partition_leaves(const std::vector<Leaf<dim>> &leaves,
                   const std::vector<double>    &weights,
                   const unsigned int            n_trees,
                   const unsigned int            n_ranks)
  {
    AssertDimension(leaves.size(), weights.size());
    if (leaves.back().tree < n_trees)
      return partition_leaves(weights, n_ranks);
    std::vector<unsigned int> order(leaves.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const unsigned int a, const unsigned int b) {
                       const unsigned int tree_a = leaves[a].tree % n_trees,
                                          tree_b = leaves[b].tree % n_trees;
                       return tree_a != tree_b ?
                                tree_a < tree_b :
                                is_before<dim>(leaves[a].corner,
                                               leaves[b].corner);
                     });
    std::vector<double> ordered;
    for (const unsigned int i : order)
      ordered.push_back(weights[i]);
    const auto                of_ordered = partition_leaves(ordered, n_ranks);
    std::vector<unsigned int> owners(leaves.size());
    for (unsigned int i = 0; i < order.size(); ++i)
      owners[order[i]] = of_ordered[i];
    return owners;
  }



  template std::vector<unsigned int>
  partition_leaves(const std::vector<Leaf<2>> &,
                   const std::vector<double> &,
                   const unsigned int,
                   const unsigned int);
  template std::vector<unsigned int>
  partition_leaves(const std::vector<Leaf<3>> &,
                   const std::vector<double> &,
                   const unsigned int,
                   const unsigned int);
  template class AdaptiveGrid<2>;
  template class AdaptiveGrid<3>;
  template CoarseGrid<2>
  coarse_lattice<2>(const std::vector<unsigned int> &,
                    const std::function<Point<2>(const Point<2> &)> &);
  template CoarseGrid<3>
  coarse_lattice<3>(const std::vector<unsigned int> &,
                    const std::function<Point<3>(const Point<3> &)> &);
  template CoarseGrid<2>
  coarse_grid<2>(const Triangulation<2> &);
  template CoarseGrid<3>
  coarse_grid<3>(const Triangulation<3> &);
} // namespace isochor
