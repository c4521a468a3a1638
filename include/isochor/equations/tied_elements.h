/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tied_elements_h
#define isochor_tied_elements_h

#include <deal.II/base/exceptions.h>

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/element_nodes.h>
#include <isochor/equations/nodal_constraints.h>

#include <vector>

namespace isochor
{
  /**
   * Elimination of unknowns that follow others (see Followers) from elements.
   * With the increments u = C ū + b of an element in terms of those that don't,
   * its matrix becomes Cᵀ K C on the element's nodes and, behind them, the
   * nodes that they follow.
   */
  class TiedElements
  {
  public:
    /** Does nothing but note that nothing follows if that is so on this rank.
     */
    void
    reinit(const ElementNodes &elements,
           const Followers    &followers,
           const unsigned int  n_components,
           const unsigned int  n_nodes);

    /** Take over weights and values of @p followers of the same structure. */
    void
    update(const Followers &followers)
    {
      Assert(all.same_structure(followers), ExcMessage("Others follow."));
      all = followers;
    }

    bool
    empty() const
    {
      return all.size() == 0;
    }

    const Followers &
    followers() const
    {
      return all;
    }

    /** The number of the follower at @p entry, or invalid. */
    unsigned int
    follower(const unsigned int entry) const
    {
      return empty() ? none : follower_at[entry];
    }

    /** The elements' nodes, followed by those they follow. Only if not empty().
     */
    const ElementNodes &
    extended() const
    {
      Assert(!empty(), ExcMessage("Nothing follows."));
      return extended_elements;
    }

    bool
    touches(const unsigned int element) const
    {
      return !empty() && element_is_tied[element];
    }

    /** Cᵀ K C by rows over the nodes of extended(), of an element that touches
     * followers, given K over its own @p n_nodes nodes (of a symmetric one the
     * upper triangle is read). Valid until the next call. */
    const double *
    eliminate(const unsigned int element,
              const unsigned int n_nodes,
              const double      *matrix,
              const bool         symmetric);

    /** Move what acts on this rank's followers to those that they follow, which
     * may be others' (to be summed up then), and keep it if @p remember. */
    void
    hand_on(const unsigned int n_owned_nodes,
            NodalField        &force,
            const bool         remember);

    /** What hand_on() moved away from follower k; zero of other ranks. */
    double
    force(const unsigned int k) const
    {
      return forces[k];
    }

    static constexpr unsigned int none = static_cast<unsigned int>(-1);

  private:
    Followers                  all;
    unsigned int               n_components = 0;
    std::vector<unsigned int>  follower_at; ///< by entry
    ElementNodes               extended_elements;
    std::vector<unsigned char> element_is_tied;
    std::vector<double>        forces;

    /** Rows of C for one element, and the result. */
    std::vector<unsigned int> row_start, row_column;
    std::vector<double>       row_weight, result;
  };
} // namespace isochor

#endif
