/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/base/warnings.h>
#include <isochor/equations/connected_parts.h>
#include <isochor/transfer/contact_watch.h>

#include <string>
#include <utility>

namespace isochor
{
  template <int dim>
  void
  ContactWatch<dim>::look(const StepContext<dim> &step,
                          const ElementNodes     &elements,
                          const bool              at_start,
                          const bool              is_kept)
  {
    // bodies with fields of their own share no nodes, only elements of contact
    if ((!at_start && !has_several) || step.grid.n_layers() > 1)
      return;
    const unsigned int n_before =
      std::exchange(n_bodies, number_of_parts(step, elements));
    if (at_start)
      has_several = n_bodies > 1;
    if (at_start && has_several && is_kept)
      step.warnings.add(
        "bodies that don't meet",
        std::to_string(n_bodies) +
          " bodies share no node of the grid, which is kept over several "
          "steps. Until it is put back they go through each other. Use "
          "<Quadrature/Type = CPDI>, or, if they are to meet, <Grid "
          "reset/Steps between resets = 1>.");
    else if (at_start)
      return;
    else if (n_bodies < n_before)
      step.warnings.add(
        "bodies that meet",
        "At t = " + rounded(step.old_time) + " s bodies have come together: " +
          std::to_string(n_before) + " were apart, now there " +
          (n_bodies == 1 ? "is one" : "are " + std::to_string(n_bodies)) +
          ". Where they share nodes of the grid they are as one, from up to a "
          "cell before they touch: they don't slide along each other, and pull "
          "at each other until they share no node any more. If one is pushed "
          "against the other by a given way, the force is too large, by as "
          "much as a cell counts against that way (two discs with 32 cells "
          "over the radius: 1.5 times; blocks by a fraction of a cell: 4.5 "
          "times); bodies that should bounce off each other may stay together. "
          "Use smaller cells where they meet, or let one of them be a wall "
          "(<Boundary conditions/Walls>) or a condition on the other one's "
          "surface.");
  }



  template class ContactWatch<2>;
  template class ContactWatch<3>;
} // namespace isochor
