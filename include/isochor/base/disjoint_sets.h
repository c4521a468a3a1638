/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_disjoint_sets_h
#define isochor_disjoint_sets_h

#include <numeric>
#include <vector>

namespace isochor
{
  /** Numbers 0 ... n - 1 in sets that are merged one by one; at first each is
   * alone. (Boost's disjoint_sets needs property maps of the caller for the
   * same dozen lines.) */
  class DisjointSets
  {
  public:
    explicit DisjointSets(const unsigned int n)
      : parent(n)
      , n_sets(n)
    {
      std::iota(parent.begin(), parent.end(), 0);
    }

    /** A number that stands for the set of @p i. */
    unsigned int
    root(unsigned int i)
    {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    }

    void
    merge(const unsigned int i, const unsigned int j)
    {
      const unsigned int a = root(i), b = root(j);
      if (a == b)
        return;
      parent[a] = b;
      --n_sets;
    }

    unsigned int
    size() const
    {
      return n_sets;
    }

  private:
    std::vector<unsigned int> parent;
    unsigned int              n_sets;
  };
} // namespace isochor

#endif
