/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_adaptive_forest_h
#define isochor_adaptive_forest_h

#include <isochor/grid/coarse_grid.h>

#include <functional>
#include <memory>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Forests of quadtrees or octrees over a coarse grid, made by p4est
   * (Burstedde, Wilcox & Ghattas, SIAM J. Sci. Comput. 33 (2011) 1103-1133).
   * Every rank makes the whole forest: all ranks know the whole grid anyway,
   * and deciding the same on the same numbers needs no communication.
   */
  template <int dim>
  class AdaptiveForest
  {
  public:
    /** @p coarse is used by the constructor only. */
    explicit AdaptiveForest(const CoarseGrid<dim> &coarse);
    ~AdaptiveForest();

    /** Whether a leaf is to be split into its 2^dim parts. */
    using Criterion = std::function<bool(const Leaf<dim> &)>;

    /**
     * The forest in which every leaf is split for which @p is_split is true,
     * beginning with the trees' roots, and beyond that as many as it takes that
     * neighbours across faces, edges and vertices differ by one level at most.
     * Leaves of Leaf::max_level are not split. The same on all ranks if the
     * criterion is.
     */
    std::vector<Leaf<dim>>
    refine(const Criterion &is_split) const;

  private:
    struct Connectivity;
    std::unique_ptr<Connectivity> connectivity;
  };

  /** Whether the place @p a of a tree comes before @p b along its
   * space-filling curve. */
  template <int dim>
  bool
  is_before(const std::array<std::uint32_t, dim> &a,
            const std::array<std::uint32_t, dim> &b);

  /** The index of the leaf that holds the place @p corner of @p tree: the last
   * one along the curve that doesn't begin behind it. @p leaves are those of a
   * whole forest. */
  template <int dim>
  unsigned int
  find_leaf(const std::vector<Leaf<dim>>         &leaves,
            const unsigned int                    tree,
            const std::array<std::uint32_t, dim> &place);
} // namespace isochor

#endif
