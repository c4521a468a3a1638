/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nodal_constraints_h
#define isochor_nodal_constraints_h

#include <deal.II/base/exceptions.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * Nodes all of whose unknowns follow those of other nodes: that of node[k] is
   * the sum of weight[i] times that of master[i], start[k] <= i < start[k + 1],
   * component by component. A master is not tied itself.
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
  };

  /**
   * Unknowns that follow others, the result of NodalConstraints::resolve():
   *   x[entry[k]] = Σ_i weight[i] x[master[i]] + value[k],
   * start[k] <= i < start[k + 1]. Masters are free or prescribed; they don't
   * follow others.
   */
  struct Followers
  {
    enum : unsigned char
    {
      is_tie = 1 ///< of NodalTies
    };

    std::vector<unsigned int>  entry;
    std::vector<std::size_t>   start = {0};
    std::vector<unsigned int>  master;
    std::vector<double>        weight, value;
    std::vector<unsigned char> flags;

    unsigned int
    size() const
    {
      return entry.size();
    }

    void
    clear();

    bool
    has(const unsigned int k, const unsigned char flag) const
    {
      AssertIndexRange(k, flags.size());
      return (flags[k] & flag) != 0;
    }

    /** Σ_i weight[i] x[master[i]], with @p x a function of an entry. */
    template <typename Field>
    double
    sum(const unsigned int k, const Field &x) const
    {
      AssertIndexRange(k, entry.size());
      double result = 0;
      for (std::size_t i = start[k]; i < start[k + 1]; ++i)
        result += weight[i] * x(master[i]);
      return result;
    }

    /** Whether the same unknowns follow the same ones, with whatever weights.
     */
    bool
    same_structure(const Followers &other) const
    {
      return entry == other.entry && start == other.start &&
             master == other.master;
    }
  };

  /**
   * Where several conditions determine the same unknown, the first kind in this
   * list does, and what is left of the others is applied to what is left free.
   */
  enum class Precedence : unsigned char
  {
    displacement, ///< NodalConstraints::constrain()
    wall,         ///< along normals
    periodic,     ///< and other relations between nodes
    tie           ///< NodalTies
  };

  /**
   * What holds for the increments of nodal unknowns over a step. Entry
   * n_components * node + component, nodes as in ActiveNodes. There are
   * - prescribed unknowns, x_i = b: constrain();
   * - linear equations between some of them, Σ_j a_j x_j = b: add();
   * - ties of nodes to others (DiscreteExtension).
   *
   * resolve() eliminates an unknown of each equation, by Gauss' method in the
   * order of Precedence, and of the calls of add() within it: what others have
   * determined before is inserted (chains, several normals at a node), and the
   * *pivot* follows from what is left. All ranks that know the pivot have to
   * add the same equation and know all its unknowns. The unknowns of control
   * nodes, which all ranks know, are pivots only of equations of which nothing
   * else is left, and which all ranks know.
   */
  struct NodalConstraints
  {
    /** How an unknown is constrained. */
    enum : unsigned char
    {
      is_free    = 0,
      prescribed = 1,
      follows    = 2 ///< other unknowns, see Followers
    };

    /** Σ a_j x_j = b, j the entries from first to last of entry[]. */
    struct Equation
    {
      Precedence  precedence = Precedence::displacement;
      std::size_t first = 0, last = 0;
      double      value = 0;
      /** The pivot is one of this many of the first entries; 0: any. */
      unsigned int n_pivots = 1;
      /** Whether all ranks have added it. */
      bool                          known_to_all = false;
      static constexpr unsigned int none = static_cast<unsigned int>(-1);
      /** By resolve(): what follows by this equation. None: all of it is
       * determined by others. */
      unsigned int pivot = none;
    };

    /** An unknown that two conditions determine, and not alike. */
    struct Conflict
    {
      unsigned int entry;
      std::string  winner, loser;
      double       difference; ///< of what they prescribe; 0: not known
      bool         equal_rank; ///< both are of the same precedence
    };

    std::vector<unsigned char> constrained;
    /** Of unknowns that are prescribed. */
    std::vector<double> increment;
    NodalTies           ties;

    std::vector<Equation>     equations;
    std::vector<unsigned int> entry;
    std::vector<double>       coefficient;

    Followers             followers;
    std::vector<Conflict> conflicts;
    /** Who constrains from now on, for messages: "Displacement". */
    std::string source;

    /** @p control: the entries of control nodes. */
    void
    reinit(const unsigned int               n_entries,
           const std::vector<unsigned int> &control = {});

    /** Prescribe an unknown. Of several calls for it the last one counts; that
     * of another source with another value is a conflict. */
    void
    constrain(const unsigned int entry, const double value);

    /** Add Σ a_j x_j = @p value for @p terms (entry, a_j). The Equation
     * returned can be changed until the next call. */
    Equation &
    add(const Precedence                                    precedence,
        const std::vector<std::pair<unsigned int, double>> &terms,
        const double                                        value);

    /** Whether an entry is of a control node. */
    bool
    is_of_control_node(const unsigned int entry) const
    {
      AssertIndexRange(entry, constrained.size());
      return !is_control.empty() && is_control[entry] != 0;
    }

    /** Find the followers. */
    void
    resolve(const unsigned int n_components);

  private:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    unsigned int
    source_number();
    void
    eliminate(Equation &equation, const unsigned int number);
    /** Let the row be the equation without what has been eliminated. */
    void
    set_row(const Equation &equation);
    void
    eliminate_tie(const unsigned int tie, const unsigned int n_components);
    void
    add_to_row(const unsigned int entry, const double coefficient);
    /** Insert followers into the row. */
    void
    substitute();
    unsigned int
    find_pivot(const Equation &equation) const;
    void
    check_pivot(const Equation &equation, const unsigned int number) const;
    void
    note_lost(const Equation &equation, const unsigned int number);
    void
    append_follower(const unsigned int  entry,
                    const unsigned char flags,
                    const double        value);
    /** Insert followers that were found after those that depend on them. */
    void
    resolve_chains();

    /** Names of sources; of equations; of entries, as soon as there are two. */
    std::vector<std::string>   sources;
    std::vector<unsigned int>  source_of_equation;
    std::vector<unsigned char> source_of_entry;
    /** By entry, if there are control nodes. */
    std::vector<unsigned char> is_control;

    /** What resolve() works with: by entry its place in the followers; by
     * follower its equation; the expression Σ row = row_value. */
    std::vector<unsigned int>                    place;
    std::vector<unsigned int>                    equation_of_follower;
    std::vector<std::pair<unsigned int, double>> row;
    double                                       row_value = 0;
  };
} // namespace isochor

#endif
