/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_pressure_groups_h
#define isochor_pressure_groups_h

#include <isochor/equations/equation_term.h>
#include <isochor/equations/material_groups.h>

#include <algorithm>
#include <vector>

namespace isochor
{
  /** Elastic materials of which one is stiffer by less than this don't have
   * pressures so different that warnings tell of it. */
  constexpr double much_stiffer = 1.5;

  /** Whose pressures the nodes have: the first and the last group of materials
   * whose points see the pressure of a vertex. */
  class PressureGroups
  {
  public:
    /** Collective. */
    template <int dim>
    PressureGroups(const StepContext<dim> &step, const MaterialGroups &groups);

    bool
    has_any(const unsigned int vertex) const
    {
      return largest[2 * vertex] > 0;
    }

    /** Whether several see that of @p a or of @p b, which are the same
     * unknown. */
    bool
    has_several(const unsigned int a, const unsigned int b) const
    {
      return std::max(largest[2 * a], largest[2 * b]) +
               std::max(largest[2 * a + 1], largest[2 * b + 1]) >
             n_groups + 1;
    }

    bool
    has_several(const unsigned int vertex) const
    {
      return has_several(vertex, vertex);
    }

  private:
    unsigned int n_groups;
    /** By vertex: the last group, and the first one counted from the end, from
     * 1 on. */
    std::vector<unsigned int> largest;
  };
} // namespace isochor

#endif
