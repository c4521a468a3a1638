/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/base/rounding.h>
#include <isochor/grid/extent.h>
#include <isochor/grid/grid_stretch.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Throw if the grid isn't in its place at t = 0. */
    void
    check_start(const std::vector<double>        &planes,
                const std::vector<Expression<1>> &displacement)
    {
      Assert(!planes.empty(), ExcInternalError());
      AssertDimension(planes.size(), displacement.size());
      const double size = planes.size() > 1 ? planes.back() - planes.front() :
                                              std::abs(planes.front());
      for (unsigned int i = 0; i < planes.size(); ++i)
        {
          const double at_start = displacement[i](Point<1>(planes[i]), 0.);
          AssertThrow(
            std::abs(at_start) <= rounding::places * size,
            ExcMessage(
              "The displacement at the coordinate " + rounded(planes[i]) +
              " of the parameter <Grid/Stretch> is " + rounded(at_start) +
              " m at t = 0, where the grid is in its place: "
              "displacements count from there, and have to be 0 at "
              "t = 0."));
        }
    }
  } // namespace



  template <int dim>
  void
  GridStretch<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Stretch",
      "",
      Patterns::Anything(),
      "A grid that follows a prescribed motion: 'axis: coordinate -> "
      "displacement(t), coordinate -> displacement(t), ...', for example 'y: 0 "
      "-> 0, 0.1 -> 1e-3*t'. The grid planes at the given coordinates move as "
      "given, those between them are interpolated linearly. Empty: the grid "
      "rests.");
  }



  template <int dim>
  void
  GridStretch<dim>::parse_parameters(ParameterHandler &prm)
  {
    for (const auto &motion :
         split_named_list(prm.get("Stretch"), "Grid/Stretch"))
      {
        const std::string axes = "xyz";
        AssertThrow(axis == -1,
                    ExcMessage(
                      "The parameter <Grid/Stretch> moves planes "
                      "across one axis only, but names another one, <" +
                      motion.first + ">."));
        AssertThrow(motion.first.size() == 1 &&
                      axes.substr(0, dim).find(motion.first) !=
                        std::string::npos,
                    ExcMessage("The parameter <Grid/Stretch> must name one "
                               "axis of " +
                               axes.substr(0, dim) + ", not <" + motion.first +
                               ">."));
        axis = axes.find(motion.first);
        for (const auto &plane : split_formulas(motion.second, "Grid/Stretch"))
          {
            const auto arrow = plane.find("->");
            AssertThrow(arrow != std::string::npos,
                        ExcMessage("The entry <" + plane +
                                   "> of the parameter <Grid/Stretch> must "
                                   "have the form <coordinate -> "
                                   "displacement>."));
            planes.push_back(number_in(plane.substr(0, arrow), "Grid/Stretch"));
            displacement.emplace_back(plane.substr(arrow + 2),
                                      "Grid/Stretch",
                                      FormulaVariables::time);
            AssertThrow(planes.size() < 2 ||
                          planes.back() > planes[planes.size() - 2],
                        ExcMessage("The coordinates of <Grid/Stretch> must "
                                   "ascend."));
          }
      }
    if (!planes.empty())
      check_start(planes, displacement);
  }



  template <int dim>
  void
  GridStretch<dim>::check_planes(const std::vector<Point<dim>> &vertices) const
  {
    // a grid may be moved against its planes by part of a cell
    constexpr double slack = 0.1;
    if (!is_moving())
      return;
    Extent<dim> grid;
    for (const Point<dim> &vertex : vertices)
      grid.include(vertex);
    const double low = grid.lower[axis], high = grid.upper[axis];
    for (const double plane : planes)
      AssertThrow(plane >= low - slack * (high - low) &&
                    plane <= high + slack * (high - low),
                  ExcMessage(
                    std::string("The parameter <Grid/Stretch> moves a plane "
                                "at ") +
                    "xyz"[axis] + " = " + rounded(plane) +
                    " m, but the grid reaches from " + rounded(low) + " to " +
                    rounded(high) +
                    " m: name the coordinate of the side that is to move."));
  }



  template <int dim>
  Point<dim>
  GridStretch<dim>::place(const Point<dim> &reference, const double time) const
  {
    AssertDimension(planes.size(), displacement.size());
    const double y     = reference[axis];
    const auto   moved = [&](const unsigned int plane) {
      return displacement[plane](Point<1>(planes[plane]), time);
    };
    const unsigned int above =
      std::upper_bound(planes.begin(), planes.end(), y) - planes.begin();
    Point<dim> x = reference;
    if (above == 0)
      x[axis] += moved(0);
    else if (above == planes.size())
      x[axis] += moved(above - 1);
    else
      {
        const double s =
          (y - planes[above - 1]) / (planes[above] - planes[above - 1]);
        x[axis] += (1 - s) * moved(above - 1) + s * moved(above);
      }
    return x;
  }



  template class GridStretch<2>;
  template class GridStretch<3>;
} // namespace isochor
