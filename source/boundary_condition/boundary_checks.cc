/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/explanation.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/boundary_checks.h>
#include <isochor/grid/extent.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace isochor
{
  namespace
  {
    /** Of the body's length along a push, what the gap behind it may have: the
     * forces then lack about as much. */
    constexpr double strain_lost = 0.01;

    /** The vertices of cells with material points, of all ranks: nodes may be
     * active by conditions only. Collective. */
    template <int dim>
    std::set<unsigned int>
    vertices_at_points(const StepContext<dim> &step)
    {
      const SimplexGeometry<dim>     &geometry = step.grid.geometry();
      const std::vector<unsigned int> cells(step.points.cell.begin(),
                                            step.points.cell.begin() +
                                              step.points.n_occupied_cells);
      std::set<unsigned int>          vertices;
      for (const unsigned int cell :
           union_over_ranks(cells, step.grid.communicator()))
        for (const unsigned int v : geometry.vertex_indices(cell))
          vertices.insert(v);
      return vertices;
    }

    /** Whether material points are in cells at the boundary @p id. Collective.
     */
    template <int dim>
    bool
    has_points_at(const StepContext<dim> &step, const types::boundary_id id)
    {
      const auto with_points = vertices_at_points(step);
      for (const BoundaryFace &face : step.grid.boundary_faces())
        for (unsigned int v = 0; v <= dim && face.id == id; ++v)
          if (v != face.opposite_vertex &&
              with_points.count(
                step.grid.geometry().vertex_indices(face.cell)[v]) > 0)
            return true;
      return false;
    }

    /** Whether material is in cells at the boundary @p id, or at any if
     * @p everywhere. Collective. */
    template <int dim>
    bool
    is_touched(const StepContext<dim>  &step,
               const types::boundary_id id,
               const bool               everywhere = false)
    {
      const SimplexGeometry<dim> &geometry = step.grid.geometry();
      bool                        touched  = false;
      for (const BoundaryFace &face : step.grid.boundary_faces())
        if (everywhere || face.id == id)
          for (unsigned int v = 0; v <= dim; ++v)
            touched = touched ||
                      (v != face.opposite_vertex &&
                       step.nodes.node(geometry.vertex_indices(face.cell)[v]) !=
                         numbers::invalid_unsigned_int);
      return Utilities::MPI::max(static_cast<int>(touched),
                                 step.grid.communicator()) != 0;
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
      for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
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



  template <int dim>
  GridSide<dim>
  side_of(const BackgroundGrid<dim> &grid,
          const std::string         &boundary,
          const std::string         &parameter)
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const types::boundary_id    id = grid.boundary_id(boundary, parameter);
    GridSide<dim>               side;
    double                      area = 0;
    for (const BoundaryFace &face : grid.boundary_faces())
      if (face.id == id)
        {
          // ∇N of the opposite vertex is the inverse of its height, and times
          // |e| the face's area over dim
          const Tensor<1, dim> gradient = geometry.gradients(
                                 face.cell)[face.opposite_vertex],
                               normal = geometry.measure(face.cell) * gradient;
          side.inwards += normal;
          area += normal.norm();
          side.cell_size = std::max(side.cell_size, 1 / gradient.norm());
        }
    side.inwards /= area;
    return side;
  }



  template <int dim>
  void
  warn_if_untouched(const StepContext<dim>  &step,
                    const std::string       &parameter,
                    const std::string       &name,
                    const types::boundary_id id,
                    const bool               everywhere,
                    const bool               by_points)
  {
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    Extent<dim>                 boundary, body;
    if (by_points ? has_points_at(step, id) : is_touched(step, id, everywhere))
      return;
    for (const BoundaryFace &face : step.grid.boundary_faces())
      if (everywhere || face.id == id)
        for (unsigned int v = 0; v <= dim; ++v)
          if (v != face.opposite_vertex)
            boundary.include(
              geometry.vertices()[geometry.vertex_indices(face.cell)[v]]);
    const MPI_Comm comm = step.grid.communicator();
    for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
      for (const unsigned int vertex :
           geometry.vertex_indices(step.points.cell[k]))
        body.include(geometry.vertices()[vertex]);
    body.merge(comm);
    step.warnings.add("no material at <" + name + "> of <" + parameter + ">",
                      "no effect at the start: the body's cells lie in " +
                        body.text() + ", the boundary in " + boundary.text() +
                        ". If the body reaches it later, use <Walls = " + name +
                        ": n >= 0>; else check its place.");
  }



  template <int dim>
  void
  warn_of_lost_body(const StepContext<dim>      &step,
                    const std::string           &parameter,
                    const std::string           &boundary,
                    const unsigned int           component,
                    const std::array<double, 2> &push)
  {
    const double inwards =
      side_of(step.grid, boundary, parameter).inwards[component];
    warn_of_body_left_behind(step,
                             boundary,
                             parameter + " = " + boundary + ": " +
                               "xyz"[component] + " = ...",
                             std::max(push[0] * inwards, push[1] * inwards));
  }



  template <int dim>
  void
  warn_of_body_left_behind(const StepContext<dim> &step,
                           const std::string      &boundary,
                           const std::string      &condition,
                           const double            along)
  {
    if (along <= 0)
      return;
    const GridSide<dim> side = side_of(step.grid, boundary, condition);
    const double        size = side.cell_size;
    // with inertia the whole body may go along, and nothing be strained
    const bool strains =
      !step.has_inertia &&
      is_touched(step, step.grid.boundary_id(boundary, condition));
    const double length = strains ? length_along(step, side.inwards) : 0.;
    if (along <= 0.5 * size && !(strains && along > strain_lost * length))
      return;
    step.warnings.add(
      "a boundary that leaves the body behind",
      "until t = " + rounded(step.old_time) + " <" + condition +
        "> has pushed the body by " + rounded(along) + " m away from <" +
        boundary +
        (step.grid.is_moving() ? ">, beyond what <Grid/Stretch> moves it" :
                                 ">") +
        " (a cell has " + rounded(size) + " m" +
        (strains ? ", the body " + rounded(length) + " m" : "") + "): " +
        (along > 0.5 * size ? "the boundary loses the body, forces are" :
                              "forces are") +
        " too small. Use <Grid/Stretch>, or <Grid reset/Steps between resets = "
        "0>.");
  }



  ISOCHOR_EXPLAIN(
    no_material,
    "no material at <boundary> of <parameter>",
    ISOCHOR_ESSENTIAL,
    "an entry of `Displacement`, `Walls`, `Periodic sides` or `Reactions` "
    "names a boundary that the material does not touch at the start: it has"
    " no effect then. What holds nodes stops a body that comes to it up to "
    "a cell early and doesn't let it go",
    "nothing, if the body reaches the wall later (`Walls = name: n >= 0`); "
    "else correct the name, the grid or the place of the body")



  ISOCHOR_EXPLAIN(
    left_behind,
    "a boundary that leaves the body behind",
    ISOCHOR_ESSENTIAL,
    "`Displacement` or `Walls` push the body away from a boundary of a grid"
    " that is reset (`Displacement`: beyond what `Grid/Stretch` moves it, "
    "so that a stretch with a wrong sign is found, too): by more than half "
    "a cell; in statics, if the body touches it, by more than 1 % of the "
    "body's length in this direction. The row of cells with the gap is "
    "strained more than the body, whose forces are too small by up to twice"
    " the share that the way has of its length",
    "`Grid/Stretch`, a kept grid, or `Interaction: name - place`")



  template GridSide<2>
  side_of(const BackgroundGrid<2> &, const std::string &, const std::string &);
  template GridSide<3>
  side_of(const BackgroundGrid<3> &, const std::string &, const std::string &);
  template void
  warn_if_untouched<2>(const StepContext<2> &,
                       const std::string &,
                       const std::string &,
                       const types::boundary_id,
                       const bool,
                       const bool);
  template void
  warn_if_untouched<3>(const StepContext<3> &,
                       const std::string &,
                       const std::string &,
                       const types::boundary_id,
                       const bool,
                       const bool);
  template void
  warn_of_lost_body(const StepContext<2> &,
                    const std::string &,
                    const std::string &,
                    const unsigned int,
                    const std::array<double, 2> &);
  template void
  warn_of_lost_body(const StepContext<3> &,
                    const std::string &,
                    const std::string &,
                    const unsigned int,
                    const std::array<double, 2> &);
  template void
  warn_of_body_left_behind(const StepContext<2> &,
                           const std::string &,
                           const std::string &,
                           const double);
  template void
  warn_of_body_left_behind(const StepContext<3> &,
                           const std::string &,
                           const std::string &,
                           const double);
} // namespace isochor
