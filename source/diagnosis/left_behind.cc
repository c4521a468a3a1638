/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/diagnosis/touched_boundary.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** A side of the grid: the mean direction into the grid, of length one
     * where it is flat, and the highest cell, from its face on the side to the
     * vertex opposite (m). */
    template <int dim>
    struct GridSide
    {
      Tensor<1, dim> inwards;
      double         cell_size = 0;
    };

    template <int dim>
    GridSide<dim>
    side_of(const BackgroundGrid<dim> &grid, const types::boundary_id id)
    {
      const SimplexGeometry<dim> &geometry = grid.geometry();
      GridSide<dim>               side;
      double                      area = 0;
      for (const BoundaryFace &face : grid.boundary_faces())
        if (face.id == id)
          {
            // ∇N of the opposite vertex is the inverse of its height, and times
            // |e| the face's area over dim
            const Tensor<1, dim> gradient = geometry.gradients(
                                   face.cell)[face.opposite_vertex],
                                 normal =
                                   geometry.measure(face.cell) * gradient;
            side.inwards += normal;
            area += normal.norm();
            side.cell_size = std::max(side.cell_size, 1 / gradient.norm());
          }
      side.inwards /= area;
      return side;
    }

    /** From the first of the material points to the last (m), along
     * @p direction, or of a closed boundary along the longest axis. Collective.
     */
    template <int dim>
    double
    length_along(const StepContext<dim> &step, const Tensor<1, dim> &direction)
    {
      constexpr double            closed = 0.5;
      std::vector<Tensor<1, dim>> axes;
      if (direction.norm() > closed)
        axes.push_back(direction / direction.norm());
      else
        for (unsigned int a = 0; a < dim; ++a)
          axes.push_back(Point<dim>::unit_vector(a));
      std::vector<double> low(axes.size(), 1e300), high(axes.size(), -1e300);
      for (unsigned int k = 0; k < step.points.cell.size(); ++k)
        for (unsigned int q = step.points.cell_start[k];
             q < step.points.cell_start[k + 1];
             ++q)
          for (unsigned int a = 0; a < axes.size(); ++a)
            {
              const double x =
                axes[a] * step.points.location(step.grid.geometry(), k, q);
              low[a]  = std::min(low[a], x);
              high[a] = std::max(high[a], x);
            }
      const MPI_Comm comm = step.grid.communicator();
      Utilities::MPI::min(low, comm, low);
      Utilities::MPI::max(high, comm, high);
      double length = 0;
      for (unsigned int a = 0; a < axes.size(); ++a)
        length = std::max(length, high[a] - low[a]);
      return length;
    }
  } // namespace



  /** On a grid that is reset, a boundary that has pushed the body out of the
   * row of cells there hands hardly anything on to it. In statics its forces
   * are too small before: the row of cells with the gap in it is strained by
   * more than the body. */
  template <int dim>
  class LeftBehind : public Diagnosis<dim>
  {
  public:
    void
    points_moved(const ConvergedStep<dim> &converged) override
    {
      const StepContext<dim> &step = converged.result.step;
      if (step.old_time > 0 && !step.grid_is_kept)
        for (const auto *const condition :
             with_role<const ConstrainsNodes<dim>>(
               converged.scene.boundary_conditions))
          for (const BoundaryPush &push : condition->pushes(step))
            if (push.ways[0] < 0 || push.ways[1] > 0)
              look(step, push);
    }

  private:
    void
    look(const StepContext<dim> &step, const BoundaryPush &push) const
    {
      // of the body's length along a push, what the gap behind it may have: the
      // forces then lack about as much
      constexpr double strain_lost = 0.01;
      const auto id = step.grid.boundary_id(push.boundary, push.condition);
      const GridSide<dim> side = side_of(step.grid, id);
      const double        size = side.cell_size;
      const double        into =
        push.component < dim ? side.inwards[push.component] : 1.;
      const double along = std::max(push.ways[0] * into, push.ways[1] * into);
      if (along <= 0)
        return;
      // with inertia the whole body may go along, and nothing be strained
      const bool   strains = !step.has_inertia && is_touched(step, id);
      const double length  = strains ? length_along(step, side.inwards) : 0.;
      if (along <= 0.5 * size && !(strains && along > strain_lost * length))
        return;
      this->warn(
        "until t = " + rounded(step.old_time) + " <" + push.condition +
        "> has pushed the body by " + rounded(along) + " m away from <" +
        push.boundary +
        (step.grid.is_moving() ? ">, beyond what <Grid/Stretch> moves it" :
                                 ">") +
        " (a cell has " + rounded(size) + " m" +
        (strains ? ", the body " + rounded(length) + " m" : "") + "): " +
        (along > 0.5 * size ? "the boundary loses the body, forces are" :
                              "forces are") +
        " too small. Use <Grid/Stretch>, or <Grid reset/Steps between resets = "
        "0>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    LeftBehind,
    "a boundary that leaves the body behind",
    ISOCHOR_ESSENTIAL,
    "`Displacement` or `Walls` push the body away from a boundary of a grid "
    "that is reset (`Displacement`: beyond what `Grid/Stretch` moves it, so "
    "that a stretch with a wrong sign is found, too): by more than half a "
    "cell; quasi-static, if the body touches it, by more than 1 % of the "
    "body's length in this direction. The row of cells with the gap is "
    "strained more than the body, whose forces are too small by up to twice "
    "the share that the way has of its length",
    "`Grid/Stretch`, a grid without resets, or `Interaction: name - place`")
} // namespace isochor
