/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/boundary_checks.h>
#include <isochor/grid/extent.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>

namespace isochor
{
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
          // |e| ∇N of the opposite vertex is the face's area over dim
          const Tensor<1, dim> normal =
            geometry.measure(face.cell) *
            geometry.gradients(face.cell)[face.opposite_vertex];
          side.inwards += normal;
          area += normal.norm();
          side.cell_size =
            std::max(side.cell_size, cell_size(geometry, face.cell));
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
                    const bool               everywhere)
  {
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    Extent<dim>                 boundary, body;
    bool                        touched = false;
    for (const BoundaryFace &face : step.grid.boundary_faces())
      {
        if (!everywhere && face.id != id)
          continue;
        for (unsigned int v = 0; v <= dim; ++v)
          if (v != face.opposite_vertex)
            {
              const unsigned int vertex = geometry.vertex_indices(face.cell)[v];
              boundary.include(geometry.vertices()[vertex]);
              touched = touched || step.nodes.node(vertex) !=
                                     numbers::invalid_unsigned_int;
            }
      }
    const MPI_Comm comm = step.grid.communicator();
    if (Utilities::MPI::max(static_cast<int>(touched), comm) != 0)
      return;

    for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
      for (const unsigned int vertex :
           geometry.vertex_indices(step.points.cell[k]))
        body.include(geometry.vertices()[vertex]);
    body.merge(comm);
    step.warnings.add(
      "no material at <" + name + "> of <" + parameter + ">",
      "The entry for <" + name + "> of the parameter <" + parameter +
        "> has no effect at the start, as the material doesn't touch that "
        "boundary: the cells of the body lie in " +
        body.text() + ", the boundary in " + boundary.text() +
        ". That is right for a wall which the body reaches later. Otherwise "
        "check the name of the boundary, <Grid> and the place of the body in "
        "<Material points>.");
  }



  template <int dim>
  void
  warn_of_wall_inside(const StepContext<dim> &step,
                      const std::string      &parameter,
                      const std::string      &boundary,
                      const unsigned int      component,
                      const int               side)
  {
    if (side * side_of(step.grid, boundary, parameter).inwards[component] >=
        -0.5)
      return;
    step.warnings.add(
      "a wall that pushes outwards",
      "<" + parameter + " = " + boundary + ": " + "xyz"[component] + " " +
        (side > 0 ? ">" : "<") +
        "= ...> holds the body only as long as it is pulled away from the "
        "boundary, as if a wall stood inside of it. A wall at this boundary "
        "is '" +
        (side > 0 ? "<" : ">") + "='.");
  }



  template <int dim>
  void
  warn_of_lost_body(const StepContext<dim> &step,
                    const std::string      &parameter,
                    const std::string      &boundary,
                    const unsigned int      component,
                    const double            push)
  {
    warn_of_body_left_behind(
      step,
      boundary,
      parameter + " = " + boundary + ": " + "xyz"[component] + " = ...",
      push * side_of(step.grid, boundary, parameter).inwards[component]);
  }



  template <int dim>
  void
  warn_of_body_left_behind(const StepContext<dim> &step,
                           const std::string      &boundary,
                           const std::string      &condition,
                           const double            along)
  {
    const double size = side_of(step.grid, boundary, condition).cell_size;
    if (along <= 0.5 * size)
      return;
    step.warnings.add(
      "a boundary that leaves the body behind",
      "Until t = " + rounded(step.old_time) + " <" + condition +
        "> has pushed the body by " + rounded(along) +
        " m away from the boundary <" + boundary +
        ">, more than half of a cell (" + rounded(size) +
        " m), but the grid is put back after each step, and the boundary with "
        "it: it loses the body. Let the grid follow (<Grid/Stretch>), keep it "
        "(<Grid reset/Steps between resets>), or move the body's own surface "
        "(<Boundary conditions/Displacement of body>).");
  }



  template GridSide<2>
  side_of(const BackgroundGrid<2> &, const std::string &, const std::string &);
  template GridSide<3>
  side_of(const BackgroundGrid<3> &, const std::string &, const std::string &);
  template void
  warn_if_untouched<2>(const StepContext<2> &,
                       const std::string &,
                       const std::string &,
                       const types::boundary_id,
                       const bool);
  template void
  warn_if_untouched<3>(const StepContext<3> &,
                       const std::string &,
                       const std::string &,
                       const types::boundary_id,
                       const bool);
  template void
  warn_of_wall_inside(const StepContext<2> &,
                      const std::string &,
                      const std::string &,
                      const unsigned int,
                      const int);
  template void
  warn_of_wall_inside(const StepContext<3> &,
                      const std::string &,
                      const std::string &,
                      const unsigned int,
                      const int);
  template void
  warn_of_lost_body(const StepContext<2> &,
                    const std::string &,
                    const std::string &,
                    const unsigned int,
                    const double);
  template void
  warn_of_lost_body(const StepContext<3> &,
                    const std::string &,
                    const std::string &,
                    const unsigned int,
                    const double);
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
