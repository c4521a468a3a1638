/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_held_by_walls_h
#define isochor_held_by_walls_h

#include <isochor/equations/nodal_constraints.h>
#include <isochor/grid/prescribed_motion.h>

#include <utility>
#include <vector>

namespace isochor
{
  /** The motion of a one-sided wall over the step, by what the scheme follows
   * it with at the start and at the end: what the next step is to start with if
   * the wall goes on like this. */
  struct WallMotion
  {
    MotionAtStart motion;
    double        velocity_at_start, acceleration_at_start;
    double        velocity_at_end, acceleration_at_end;
  };

  /** An entry, of fields with dim components per node, that a one-sided wall
   * holds. */
  struct StoppedAtWall
  {
    unsigned int entry;
    WallMotion   wall;
  };

  /** The same for a wall that holds a combination Σ a_j x_j. */
  struct StoppedAlongWall
  {
    std::vector<std::pair<unsigned int, double>> direction;
    WallMotion                                   wall;
  };

  /** What walls held at the end of the last step: points in cells that the body
   * fills little hardly know of it, and the force of the wall is not among
   * those that accelerations from stresses are made of, so that these nodes
   * start with the velocity and the acceleration of the wall. By components,
   * and by equations of walls; the same in all of the search for contact. */
  struct PressedByWalls
  {
    std::vector<StoppedAtWall> components;
    Followers                  followers;
    std::vector<double>        velocity, acceleration;
  };
} // namespace isochor

#endif
