/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_constraint_conflicts_h
#define isochor_constraint_conflicts_h

#include <isochor/equations/equation_term.h>

#include <string>
#include <vector>

namespace isochor
{
  /** The path of the parameter that NodalConstraints::source names, "Walls" or
   * "Walls: name of the section"; with " = item", such as "Walls = top",
   * an item of it. */
  std::string
  parameter_of(const std::string &source);

  /** Two conditions that determine the same unknowns otherwise. */
  struct ConflictOfConditions
  {
    /** As in NodalConstraints::Conflict. */
    std::string winner, loser;
    bool        equal_rank = false;
    /** Of how many unknowns; the largest difference (m), 0: not known; and
     * where, such as "(1, 2)". */
    unsigned int n          = 0;
    double       difference = 0;
    std::string  place;

    /** Both by their parameters, and the number of unknowns with a place. */
    std::string
    names() const;
    std::string
    where() const;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &winner &loser &equal_rank &n &difference &place;
    }
  };

  /** Those of @p constraints on any rank. @throws ExcMessage if two are of the
   * same precedence, so that nothing tells which one is meant. Collective. */
  template <int dim>
  std::vector<ConflictOfConditions>
  find_conflicts(const StepContext<dim> &step,
                 const NodalConstraints &constraints);
} // namespace isochor

#endif
