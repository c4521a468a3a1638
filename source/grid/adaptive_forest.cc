/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/distributed/p4est_wrappers.h>

#include <isochor/grid/adaptive_forest.h>

#include <p4est_connectivity.h>
#include <p8est_connectivity.h>

#include <algorithm>
#include <exception>
#include <numeric>

namespace isochor
{
  namespace
  {
    template <int dim>
    using P4est = dealii::internal::p4est::types<dim>;
    template <int dim>
    using Functions = dealii::internal::p4est::functions<dim>;

    /** p4est's coordinates in 2D have more bits than ours, in 3D fewer. */
    constexpr int
    p4est_bits(const int dim)
    {
      return dim == 2 ? 30 : 19;
    }

    template <int dim>
    std::uint32_t
    from_p4est(const int coordinate)
    {
      constexpr int bits = 20;
      static_assert(Leaf<dim>::resolution == 1u << bits, "");
      if constexpr (p4est_bits(dim) > bits)
        return static_cast<std::uint32_t>(coordinate) >>
               (p4est_bits(dim) - bits);
      else
        return static_cast<std::uint32_t>(coordinate)
               << (bits - p4est_bits(dim));
    }

    template <int dim>
    Leaf<dim>
    to_leaf(const typename P4est<dim>::topidx    tree,
            const typename P4est<dim>::quadrant &quadrant)
    {
      Leaf<dim> leaf;
      leaf.tree      = tree;
      leaf.corner[0] = from_p4est<dim>(quadrant.x);
      leaf.corner[1] = from_p4est<dim>(quadrant.y);
      if constexpr (dim == 3)
        leaf.corner[2] = from_p4est<dim>(quadrant.z);
      leaf.level = quadrant.level;
      return leaf;
    }

    /** What p4est calls back; the criterion is the forest's user pointer. */
    template <int dim>
    int
    refine_callback(typename P4est<dim>::forest   *forest,
                    typename P4est<dim>::topidx    tree,
                    typename P4est<dim>::quadrant *quadrant)
    {
      const auto &is_split =
        *static_cast<const typename AdaptiveForest<dim>::Criterion *>(
          forest->user_pointer);
      return quadrant->level < static_cast<int>(Leaf<dim>::max_level) &&
             is_split(to_leaf<dim>(tree, *quadrant));
    }
  } // namespace



  /** The coordinates' bits in turn, the highest first. */
  template <int dim>
  bool
  is_before(const std::array<std::uint32_t, dim> &a,
            const std::array<std::uint32_t, dim> &b)
  {
    // the axis whose coordinates differ in the highest bit decides, of
    // several the last axis
    unsigned int  axis = dim - 1;
    std::uint32_t most = a[axis] ^ b[axis];
    for (int d = dim - 2; d >= 0; --d)
      {
        const std::uint32_t difference = a[d] ^ b[d];
        if (most < difference && most < (most ^ difference))
          {
            most = difference;
            axis = d;
          }
      }
    return a[axis] < b[axis];
  }



  template <int dim>
  struct AdaptiveForest<dim>::Connectivity
  {
    explicit Connectivity(const CoarseGrid<dim> &coarse)
    {
      // vertices are numbers only: places follow from keys, see
      // ConformingClosure
      const std::vector<double> places(3 * coarse.vertices.size(), 0.);
      const unsigned int        n_trees = coarse.cells.size();
      std::vector<typename P4est<dim>::topidx> tree_to_vertex;
      for (const auto &cell : coarse.cells)
        tree_to_vertex.insert(tree_to_vertex.end(), cell.begin(), cell.end());
      // to begin with, each tree for itself
      std::vector<typename P4est<dim>::topidx> tree_to_tree;
      std::vector<signed char>                 tree_to_face;
      for (unsigned int t = 0; t < n_trees; ++t)
        for (unsigned int f = 0; f < 2 * dim; ++f)
          {
            tree_to_tree.push_back(t);
            tree_to_face.push_back(f);
          }
      const typename P4est<dim>::topidx no_corners = 0;
      if constexpr (dim == 2)
        data = Functions<2>::connectivity_new_copy(coarse.vertices.size(),
                                                   n_trees,
                                                   0,
                                                   places.data(),
                                                   tree_to_vertex.data(),
                                                   tree_to_tree.data(),
                                                   tree_to_face.data(),
                                                   nullptr,
                                                   &no_corners,
                                                   nullptr,
                                                   nullptr);
      else
        data = Functions<3>::connectivity_new_copy(coarse.vertices.size(),
                                                   n_trees,
                                                   0,
                                                   0,
                                                   places.data(),
                                                   tree_to_vertex.data(),
                                                   tree_to_tree.data(),
                                                   tree_to_face.data(),
                                                   nullptr,
                                                   &no_corners,
                                                   nullptr,
                                                   nullptr,
                                                   nullptr,
                                                   &no_corners,
                                                   nullptr,
                                                   nullptr);
      if constexpr (dim == 2)
        p4est_connectivity_complete(data);
      else
        p8est_connectivity_complete(data);
    }

    Connectivity(const Connectivity &) = delete;
    Connectivity &
    operator=(const Connectivity &) = delete;

    ~Connectivity()
    {
      Functions<dim>::connectivity_destroy(data);
    }

    typename P4est<dim>::connectivity *data;
  };



  template <int dim>
  AdaptiveForest<dim>::AdaptiveForest(const CoarseGrid<dim> &coarse)
    : connectivity(std::make_unique<Connectivity>(coarse))
  {}



  template <int dim>
  AdaptiveForest<dim>::~AdaptiveForest() = default;



  template <int dim>
  std::vector<Leaf<dim>>
  AdaptiveForest<dim>::refine(const Criterion &is_split) const
  {
    // no exception must pass through p4est, which would not free its memory
    std::exception_ptr error;
    Criterion          guarded = [&](const Leaf<dim> &leaf) {
      try
        {
          return !error && is_split(leaf);
        }
      catch (...)
        {
          error = std::current_exception();
          return false;
        }
    };
    auto *const forest = Functions<dim>::new_forest(
      MPI_COMM_SELF, connectivity->data, 0, 0, 1, 0, nullptr, &guarded);
    const int recursively = 1;
    Functions<dim>::refine(forest, recursively, &refine_callback<dim>, nullptr);
    if constexpr (dim == 2)
      Functions<2>::balance(forest, P4EST_CONNECT_FULL, nullptr);
    else
      Functions<3>::balance(forest, P8EST_CONNECT_FULL, nullptr);

    std::vector<Leaf<dim>> leaves;
    leaves.reserve(forest->local_num_quadrants);
    for (std::size_t t = 0; t < forest->trees->elem_count; ++t)
      {
        const auto &tree = *reinterpret_cast<typename P4est<dim>::tree *>(
          forest->trees->array + t * forest->trees->elem_size);
        for (std::size_t q = 0; q < tree.quadrants.elem_count; ++q)
          leaves.push_back(to_leaf<dim>(
            t,
            *reinterpret_cast<typename P4est<dim>::quadrant *>(
              tree.quadrants.array + q * tree.quadrants.elem_size)));
      }
    Functions<dim>::destroy(forest);
    if (error)
      std::rethrow_exception(error);
    return leaves;
  }



  template <int dim>
  unsigned int
  find_leaf(const std::vector<Leaf<dim>>         &leaves,
            const unsigned int                    tree,
            const std::array<std::uint32_t, dim> &place)
  {
    Assert(!leaves.empty(), ExcInternalError());
    Assert(tree <= leaves.back().tree, ExcInternalError());
    const auto behind =
      std::upper_bound(leaves.begin(),
                       leaves.end(),
                       place,
                       [tree](const std::array<std::uint32_t, dim> &x,
                              const Leaf<dim>                      &leaf) {
                         return tree != leaf.tree ?
                                  tree < leaf.tree :
                                  is_before<dim>(x, leaf.corner);
                       });
    Assert(behind != leaves.begin(), ExcInternalError());
    return behind - leaves.begin() - 1;
  }



  template class AdaptiveForest<2>;
  template class AdaptiveForest<3>;
  template bool
  is_before<2>(const std::array<std::uint32_t, 2> &,
               const std::array<std::uint32_t, 2> &);
  template bool
  is_before<3>(const std::array<std::uint32_t, 3> &,
               const std::array<std::uint32_t, 3> &);
  template unsigned int
  find_leaf<2>(const std::vector<Leaf<2>> &,
               const unsigned int,
               const std::array<std::uint32_t, 2> &);
  template unsigned int
  find_leaf<3>(const std::vector<Leaf<3>> &,
               const unsigned int,
               const std::array<std::uint32_t, 3> &);
} // namespace isochor
