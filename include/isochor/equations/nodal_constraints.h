/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nodal_constraints_h
#define isochor_nodal_constraints_h

#include <cstddef>
#include <vector>

namespace isochor
{
  /**
   * Nodes whose unknowns follow those of others, component by component: that
   * of node[k] is the sum of weight[i] times that of master[i], start[k] <= i <
   * start[k + 1]. A master is not tied itself.
   */
  struct NodalTies
  {
    std::vector<unsigned int> node;
    std::vector<std::size_t>  start = {0};
    std::vector<unsigned int> master;
    std::vector<double>       weight;

    unsigned int
    size() const
    {
      return node.size();
    }

    void
    clear()
    {
      node.clear();
      start.assign(1, 0);
      master.clear();
      weight.clear();
    }

    bool
    operator==(const NodalTies &other) const
    {
      return node == other.node && start == other.start &&
             master == other.master && weight == other.weight;
    }
  };

  /**
   * Prescribed increments of nodal unknowns over a step: entry
   * n_components * node + component, nodes as in ActiveNodes. If several
   * conditions name the same unknown, the last one counts. A prescribed
   * component of a tied node is not tied.
   */
  struct NodalConstraints
  {
    /** How an unknown is constrained. */
    enum : unsigned char
    {
      is_free    = 0,
      prescribed = 1, ///< always
      in_contact = 2  ///< as long as it presses on a one-sided wall
    };

    std::vector<unsigned char> constrained;
    std::vector<double>        increment;
    NodalTies                  ties;

    void
    reinit(const unsigned int n_entries)
    {
      constrained.assign(n_entries, is_free);
      increment.assign(n_entries, 0.);
      ties.clear();
    }

    void
    constrain(const unsigned int  entry,
              const double        value,
              const unsigned char how = prescribed)
    {
      constrained[entry] = how;
      increment[entry]   = value;
    }
  };
} // namespace isochor

#endif
