/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_contact_search_h
#define isochor_contact_search_h

#include <isochor/boundary_condition/boundary_condition.h>

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

namespace isochor
{
  /** For gaps that nobody knows. */
  constexpr double gap_unknown = std::numeric_limits<double>::lowest();

  /** A node at a one-sided wall; the same on all ranks. */
  struct WallNode
  {
    bool released     = false; ///< it has left the wall
    bool was_released = false; ///< when the last step was accepted
    bool touched      = true;  ///< it has been at the wall
    /** Its distance from the wall at the start of the step, along the direction
     * that the wall holds (m); may be negative. */
    double gap = 0;
    /** That of the body there, if the step starts with what is known of it, see
     * WallGaps; else gap_unknown. */
    double body_gap = gap_unknown;
    /** When the last step was accepted the node held the body, whose gap was
     * known. */
    bool held_body = false;
    /** The body meets the wall elsewhere first: to begin a step with the node
     * held would pull at the body by the gap, however small the step. */
    bool starts_free = false;
    /** The layer of the grid that the node is in. */
    unsigned int layer = 0;

    bool
    knows_body() const
    {
      return body_gap != gap_unknown;
    }

    /** What has to be closed until the wall holds the node. */
    double
    gap_at_start(const bool grid_is_kept) const
    {
      return knows_body() ? body_gap : grid_is_kept || !touched ? gap : 0.;
    }

    /** The search for the nodes that are held begins. */
    void
    start()
    {
      released = was_released || starts_free;
    }

    /** The step has been accepted. */
    void
    accept()
    {
      was_released = released;
      held_body    = knows_body() && !released;
    }

    void
    save(std::ostream &state) const;
    void
    load(std::istream &state);
  };

  /** What a node at a one-sided wall objects to. */
  enum Objection : unsigned int
  {
    none       = 0,
    pulls      = 1, ///< it is held, and pulls at the wall
    penetrates = 2  ///< it is free, and went through it
  };

  /**
   * The set of nodes at one-sided walls that are held, by the active set method
   * (Hintermüller, Ito & Kunisch 2003): nodes that object change sides in the
   * first iterations of Newton's method, which makes it a semi-smooth Newton
   * method, and then whenever it has converged, until none does. With
   * the safeguard of Júdice & Pires (Computers Ops Res. 21 (1994) 587-596): if
   * changing all nodes that object does not make them fewer, they are changed
   * one by one, which can't cycle in a linear problem with a positive definite
   * matrix.
   */
  class ContactSearch
  {
  public:
    /** Begin the search of a step, or begin again. */
    void
    start();

    /**
     * Change @p nodes according to their @p objections, the same on all ranks,
     * by node. The search fails with a message that names the @p parameter
     * and @p boundaries. With objections to an iterate that has not @p
     * converged all of them change and none is counted.
     */
    ContactChange
    change(const std::vector<unsigned int> &objections,
           const bool                       converged,
           const std::vector<WallNode *>   &nodes,
           const std::string               &parameter,
           const std::string               &boundaries);

  private:
    /** Whether all of @p n_objections may be met at once. */
    bool
    may_change_all(const unsigned int n_objections);

    /** Sets with which the search is given up, and how often it may not get
     * better before nodes are changed one by one. */
    static constexpr unsigned int most_sets = 60, most_patience = 4;

    unsigned int n_sets = 0, fewest_objected = 0, n_patience = 0;
  };

  /** The largest component of the displacement increments @p unknowns (m).
   * Collective. */
  template <int dim>
  double
  largest_increment(const StepContext<dim> &step, const NodalField &unknowns);

  /** By local node, whether it is tied to others for want of material. */
  std::vector<unsigned char>
  tied_nodes(const NodalTies &ties, const unsigned int n_nodes);

  /** The gap of a node that has @p moved in the step, where @p to_wall would
   * have brought it to its wall (m). One that came to it but for rounding is at
   * the wall like a node that is held, whoever moved it, as another one that it
   * follows: gap_unknown. */
  double
  gap_after(const double moved, const double to_wall);
  /** Remember the gaps at the end of a step in @p nodes: @p gaps where the
   * rank that owns the node knows them, gap_unknown elsewhere, from which they
   * are collected. A node nobody knows is at the wall. Collective. */
  void
  update_gaps(std::vector<double>   &gaps,
              const MPI_Comm         comm,
              std::vector<WallNode> &nodes);
} // namespace isochor

#endif
