/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_stretch_h
#define isochor_grid_stretch_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/expression.h>

#include <vector>

namespace isochor
{
  using namespace dealii;


  /**
   * The prescribed motion of the grid along one axis (`Grid/Stretch`): planes
   * across it move as told, what is between two of them is interpolated
   * linearly, what is outside of all moves as the nearest one.
   */
  template <int dim>
  class GridStretch
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Whether there is a motion. */
    bool
    is_moving() const
    {
      return axis >= 0;
    }

    /** @throws ExcMessage for planes outside of the grid, of which the @p
     * vertices are at t = 0. */
    void
    check_planes(const std::vector<Point<dim>> &vertices) const;

    /** Where the point generated at @p reference is at @p time. */
    Point<dim>
    place(const Point<dim> &reference, const double time) const;

  private:
    int                        axis = -1;
    std::vector<double>        planes; ///< ascending (m)
    std::vector<Expression<1>> displacement;
  };
} // namespace isochor

#endif
