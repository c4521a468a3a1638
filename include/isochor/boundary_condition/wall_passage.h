/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_wall_passage_h
#define isochor_wall_passage_h

#include <isochor/equations/equation_term.h>

#include <string>
#include <vector>

namespace isochor
{
  /** A periodic grid goes on behind its sides: places that differ by a multiple
   * of @p shift (m) are the same. The grid is from @p start on, in the product
   * with the shift, to @p start + |shift|². */
  template <int dim>
  struct Period
  {
    Tensor<1, dim> shift;
    double         start;
  };

  /** A boundary condition that may make sides of the grid the same place. */
  template <int dim>
  class HasPeriods
  {
  public:
    virtual ~HasPeriods() = default;

    virtual void
    append_periods(const BackgroundGrid<dim> &grid,
                   std::vector<Period<dim>>  &periods) const = 0;

    /** All that are the same place as others. */
    virtual std::vector<unsigned int>
    periodic_vertices() const = 0;
  };

  /** Those of all @p conditions, a list of pointers to them. */
  template <int dim, typename Conditions>
  std::vector<unsigned int>
  find_periodic_vertices(const Conditions &conditions)
  {
    std::vector<unsigned int> vertices;
    for (const auto &condition : conditions)
      if (const auto *const has_periods =
            dynamic_cast<const HasPeriods<dim> *>(condition.get()))
        for (const unsigned int v : has_periods->periodic_vertices())
          vertices.push_back(v);
    return vertices;
  }

  /** A flat wall that only pushes; the same on all ranks. */
  template <int dim>
  struct OneSidedWall
  {
    std::string               parameter, boundary;
    Tensor<1, dim>            normal; ///< from the wall towards the body
    std::vector<unsigned int> vertices;
    /** n·x of the wall at the start of the step and at its end (m): the least
     * of its vertices, behind which the body is behind the wall for certain. */
    double at_start, at_end;
    /** The most of its vertices at the start, in front of which it is nowhere.
     */
    double most_at_start;
    /** Of the grid: what leaves it at the side comes back to the wall. */
    std::vector<Period<dim>> periods = {};
  };

  /** A boundary condition that may have walls which only push. */
  template <int dim>
  class HasOneSidedWalls
  {
  public:
    virtual ~HasOneSidedWalls() = default;

    /** Append those that are flat, and face into the grid. */
    virtual void
    append_one_sided_walls(const StepContext<dim>         &step,
                           std::vector<OneSidedWall<dim>> &walls) const = 0;
  };

  /** Those of all @p conditions, a list of pointers to them. */
  template <int dim, typename Conditions>
  std::vector<OneSidedWall<dim>>
  find_one_sided_walls(const StepContext<dim> &step,
                       const Conditions       &conditions)
  {
    std::vector<OneSidedWall<dim>> walls;
    for (const auto &condition : conditions)
      if (const auto *const has_walls =
            dynamic_cast<const HasOneSidedWalls<dim> *>(condition.get()))
        has_walls->append_one_sided_walls(step, walls);
    std::vector<Period<dim>> periods;
    for (const auto &condition : conditions)
      if (const auto *const has_periods =
            dynamic_cast<const HasPeriods<dim> *>(condition.get()))
        has_periods->append_periods(step.grid, periods);
    for (OneSidedWall<dim> &wall : walls)
      wall.periods = periods;
    return walls;
  }

  /**
   * A wall acts through the nodes of its boundary, on material that is in the
   * cells there when a step begins. What comes from further away in a single
   * step goes through it, and if nobody looks, the wall has no force. So does
   * what hardly has a part in these nodes, for the most part.
   *
   * This is why the step has to be made smaller, a phrase; empty if no material
   * went through a wall of @p walls in the step with the displacement
   * increments @p unknowns. Looked at are the material points, and the corners
   * of their domains where shape functions are known on these. One on which the
   * nodes of the wall act at the start, but not enough, is taken back by the
   * next step as long as it is less than half of a cell behind the wall, and
   * points of a grid that is put back are not outside of it; if the step
   * @p may_be_cut, a fiftieth of a cell is enough, as the force of the last
   * step would lack it. Only what is between the faces of the wall's boundary
   * and their continuation along the normal counts: a body may pass beside a
   * wall. Collective.
   */
  template <int dim>
  std::string
  passage_through_walls(const StepContext<dim>               &step,
                        const NodalField                     &unknowns,
                        const std::vector<OneSidedWall<dim>> &walls,
                        const bool                            may_be_cut);

  /** Whether all of the body is more than a cell in front of the walls in
   * @p walls at the start of the step, of which there are some: it has not come
   * to them yet, or has left them. Collective. */
  template <int dim>
  bool
  is_far_from_walls(const StepContext<dim>               &step,
                    const std::vector<OneSidedWall<dim>> &walls);

  /** The first step: warn of @p walls that stand more than half a cell inside
   * of the grid, at boundaries which the body doesn't touch. What comes later
   * is past the wall before it is in a cell of the boundary. Collective. */
  template <int dim>
  void
  warn_of_walls_inside(const StepContext<dim>               &step,
                       const std::vector<OneSidedWall<dim>> &walls);
} // namespace isochor

#endif
