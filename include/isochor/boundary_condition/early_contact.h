/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_early_contact_h
#define isochor_early_contact_h

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/wall_gaps.h>

#include <vector>

namespace isochor
{
  /** Whether @p pressure, the sum of max(F_I, 0) of a wall, is a considerable
   * part of @p all, that of |F_I|: a wall that holds a body in tension presses
   * at single nodes of the body's rim, whose gaps are large against its
   * displacements. */
  inline bool
  presses(const double pressure, const double all)
  {
    return all > 0 && pressure >= 0.03 * all;
  }

  /**
   * A wall that knows nothing of the body's surface (BodyAtWalls) holds a node
   * as soon as a cell around it holds material, at a distance g_I from the
   * surface: the body is pressed by so much more than it should be. If the same
   * nodes were held without their gaps, which are displacements, the force F =
   * Σ_I F_I of a linear body would by Betti's theorem be less by Σ_I F_I g_I /
   * δ, as the forces F_I belong to the motion δ of all nodes by which the wall
   * has come nearer. F δ, the product of the forces and of what they have
   * displaced the body by, is Σ_p V_p τ:ε by the principle of virtual work. So
   * the part
   *
   *   s = Σ_I F_I g_I / Σ_p V_p |τ:ε|,   ε = (b - b^{-1})/4,
   *
   * of the forces is due to the gaps of all walls; ε is ln b / 2 but for terms
   * of the third order. That other nodes would be held without gaps, and that
   * other loads deform the body, too, makes it an estimate: forces that a round
   * body exerts on plates were too large by s to 2 s (tests/early_contact).
   *
   * The @p gaps g_I are those at the end of the step. A wall counts if it
   * presses().
   *
   * Sets the column "Share of gaps in contact" of @p statistics to the part of
   * one-sided walls in s, if there are any, and warns from s = 3 % on. @p walls
   * are those of all conditions. Collective.
   */
  template <int dim>
  void
  check_early_contact(const StepContext<dim>               &step,
                      const NodalField                     &unknowns,
                      const std::vector<WallContacts<dim>> &walls,
                      const WallGaps                       &gaps,
                      Statistics                           &statistics);
} // namespace isochor

#endif
