/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/formula_switches.h>
#include <isochor/dynamics/motion_starts.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  template <int dim>
  void
  MotionStarts<dim>::initialize(
    const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions)
  {
    motions.clear();
    switches.clear();
    for (const auto *const condition :
         with_role<const ConstrainsNodes<dim>>(conditions))
      condition->append_motions(motions);
    for (const auto *const condition :
         with_role<const ActsByAssembly<dim>>(conditions))
      condition->append_motions(motions);
    for (const Expression<dim> &motion : motions)
      for (const std::string &difference : switches_in_time(motion.text()))
        switches.emplace_back(difference,
                              "a switch of the time in " + motion.text());
  }



  template <int dim>
  double
  MotionStarts<dim>::next(const double from, const double to) const
  {
    double first = std::numeric_limits<double>::infinity();
    for (const Expression<dim> &difference : switches)
      {
        const auto is_on = [&](const double t) {
          return difference(Point<dim>(), t) > 0;
        };
        double before = from, after = to;
        if (is_on(before) == is_on(after))
          continue;
        for (;;)
          {
            const double middle = before + (after - before) / 2;
            if (middle <= before || middle >= after)
              break; // to the last digit
            (is_on(middle) == is_on(before) ? before : after) = middle;
          }
        first = std::min(first,
                         std::abs(difference(Point<dim>(), before)) <=
                             std::abs(difference(Point<dim>(), after)) ?
                           before :
                           after);
      }
    return first;
  }



  template <int dim>
  bool
  MotionStarts<dim>::any_moves(const BackgroundGrid<dim> &grid,
                               const double               from,
                               const double               to) const
  {
    const std::vector<Point<dim>> places = grid.vertices_at_time(0.);
    return std::any_of(motions.begin(),
                       motions.end(),
                       [&](const Expression<dim> &motion) {
                         return is_of_time(motion.text()) &&
                                std::any_of(places.begin(),
                                            places.end(),
                                            [&](const Point<dim> &x) {
                                              return motion(x, from) !=
                                                     motion(x, to);
                                            });
                       });
  }



  template class MotionStarts<2>;
  template class MotionStarts<3>;
} // namespace isochor
