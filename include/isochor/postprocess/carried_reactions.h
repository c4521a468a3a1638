/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_carried_reactions_h
#define isochor_carried_reactions_h

#include <isochor/equations/equation_term.h>

#include <map>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** An unknown that is held over a step. The mean of its reaction at the end
   * and the one before, times its way, is the work of what holds it. */
  struct HeldUnknown
  {
    unsigned int entry;    ///< dim * vertex + component
    double       reaction; ///< at the end (N)
    double       moved;    ///< its way (m)
  };

  /** Where the vertex of @p entry, see HeldUnknown, is. */
  template <int dim>
  Point<dim>
  place_of_entry(const StepContext<dim> &step, const unsigned int entry);

  /**
   * The grid is another one than in the last step, at the end of which
   * @p reactions (N, by entry) were at the @p places: let them be those of the
   * nearest unknowns of the same component that are @p held now. None is lost,
   * which would leave half of its work out or count the new one's twice. (The
   * work is right as far as neighbours are moved alike.) Collective.
   */
  template <int dim>
  void
  carry_reactions(const StepContext<dim>                   &step,
                  const std::vector<HeldUnknown>           &held,
                  const std::map<unsigned int, Point<dim>> &places,
                  std::map<unsigned int, double>           &reactions);
} // namespace isochor

#endif
