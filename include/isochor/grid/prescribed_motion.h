/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_prescribed_motion_h
#define isochor_prescribed_motion_h

#include <isochor/base/expression.h>
#include <isochor/base/rounding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochor
{
  /**
   * What a prescribed displacement u(x, t) adds in the step from @p old_time to
   * @p time. A formula gives the displacement since t = 0, where the body is as
   * it was seeded: nothing has been applied then, whatever the formula's value,
   * and the first step makes up for it.
   */
  template <int dim>
  double
  prescribed_increment(const Expression<dim> &displacement,
                       const Point<dim>      &x,
                       const double           old_time,
                       const double           time)
  {
    return displacement(x, time) -
           (old_time > 0 ? displacement(x, old_time) : 0.);
  }

  /** Velocity (m/s), acceleration (m/s²) and its rate (m/s³, constant) of a
   * prescribed motion at the start of a step. */
  struct MotionAtStart
  {
    double velocity = 0, acceleration = 0, jerk = 0;

    /** The same @p dt later. */
    MotionAtStart
    after(const double dt) const
    {
      return {velocity + dt * (acceleration + dt / 2 * jerk),
              acceleration + dt * jerk,
              jerk};
    }
  };

  /** A motion_of_step() is known by its places at the start, at the end and,
   * evenly, between. */
  constexpr unsigned int n_motion_places = 4;

  /**
   * The motion over a step of size @p dt through @p places: the cubic, unless
   * its acceleration would change sign in the step. What motions from rest as
   * t⁴ or bends inside of the step ask for then is more than four places can
   * tell, and the acceleration stays at zero at one of the ends.
   */
  inline MotionAtStart
  motion_of_step(const std::array<double, n_motion_places> &places,
                 const double                               dt)
  {
    const double          h = dt / (n_motion_places - 1);
    std::array<double, 3> d; // increments
    double                size = 0;
    for (unsigned int k = 0; k < d.size(); ++k)
      {
        d[k] = places[k + 1] - places[k];
        size = std::max(size, std::abs(d[k]));
      }
    const auto change = [&](const double from, const double to) {
      return std::abs(to - from) > rounding::arithmetic * size ? to - from : 0.;
    };
    const double bend = change(d[0], d[1]), next_bend = change(d[1], d[2]);
    const double mean_acceleration = (bend + next_bend) / (2 * h * h);
    const double most              = std::abs(2 * mean_acceleration / dt);
    const double jerk =
      std::clamp(change(bend, next_bend) / (h * h * h), -most, most);
    const double acceleration = mean_acceleration - jerk * dt / 2;
    return {(d[0] + d[1] + d[2]) / dt - dt * (acceleration / 2 + dt * jerk / 6),
            acceleration,
            jerk};
  }

  /**
   * What a scheme in time has to start with for its forces to be those of a
   * motion and not to alternate about them: not quite the velocity and
   * acceleration of the motion itself, see TimeIntegrator::smooth_start().
   */
  struct SmoothStart
  {
    /** What is added to the velocity (s²) and acceleration (s), per jerk. */
    double velocity_per_jerk = 0, acceleration_per_jerk = 0;

    std::pair<double, double>
    of(const MotionAtStart &motion) const
    {
      return {motion.velocity + velocity_per_jerk * motion.jerk,
              motion.acceleration + acceleration_per_jerk * motion.jerk};
    }
  };

  /** What is prescribed in the trial steps of dynamics, see
   * BoundaryCondition::set_trial(). */
  struct TrialMotion
  {
    double      start = 0, end = 0; ///< of the step that it is a trial for (s)
    double      size = 0;           ///< of the trial (s); 0: there is none
    SmoothStart smooth;

    /** The value at the end of the trial of what is @p value(t) in time. */
    template <typename Function>
    double
    at_end(const Function &value) const
    {
      const double dt = end - start;
      if (dt == 0)
        return value(start); // nothing moves
      std::array<double, n_motion_places> places;
      for (unsigned int k = 0; k < n_motion_places; ++k)
        places[k] = value(start + k * dt / (n_motion_places - 1));
      const auto [v, a] = smooth.of(motion_of_step(places, dt));
      return places[0] + size * (v + size / 2 * a);
    }
  };
} // namespace isochor

#endif
