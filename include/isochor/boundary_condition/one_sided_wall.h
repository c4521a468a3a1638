/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_one_sided_wall_h
#define isochor_one_sided_wall_h

#include <isochor/boundary_condition/condition_roles.h>

#include <string>
#include <vector>

namespace isochor
{
  /** A boundary of the grid as a wall that bodies may leave and come to. */
  struct OneSidedWall
  {
    std::string parameter; ///< its origin, for messages
    std::string boundary;
    /** How far it is from the boundary of the grid, along the normal into it
     * (m), in x, y(, z) at t = 0 and t; without blanks. */
    std::string formula = "0";
  };

  /** A boundary condition whose parameters may name such walls. */
  class HasOneSidedWalls
  {
  public:
    virtual ~HasOneSidedWalls() = default;

    virtual const std::vector<OneSidedWall> &
    one_sided_walls() const = 0;
  };

  /** Those of all @p conditions, a list of pointers to them. */
  template <typename Conditions>
  std::vector<OneSidedWall>
  find_one_sided_walls(const Conditions &conditions)
  {
    std::vector<OneSidedWall> walls;
    for (const auto *const condition :
         with_role<const HasOneSidedWalls>(conditions))
      walls.insert(walls.end(),
                   condition->one_sided_walls().begin(),
                   condition->one_sided_walls().end());
    return walls;
  }
} // namespace isochor

#endif
