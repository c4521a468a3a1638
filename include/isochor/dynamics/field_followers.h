/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_field_followers_h
#define isochor_field_followers_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/nodal_constraints.h>

namespace isochor
{
  /** The followers of displacements, in fields with dim entries per node. */
  template <int dim>
  Followers
  displacement_followers(const NodalConstraints &constraints,
                         const unsigned int      n_components);
  /** The same of pressures, in fields with one entry per node. */
  template <int dim>
  Followers
  pressure_followers(const NodalConstraints &constraints);

  /** Move what acts on the followers of a field to those they follow.
   * Collective. */
  void
  hand_on(const Followers &followers, NodalField &load);
  /** Update the ghosts of @p field, and set followers to what they follow plus
   * what is @p given, by follower; empty: nothing. Collective. */
  void
  set_followers(const Followers           &followers,
                const std::vector<double> &given,
                NodalField                &field);
} // namespace isochor

#endif
