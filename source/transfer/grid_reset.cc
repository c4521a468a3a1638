/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/equations/final_state.h>
#include <isochor/equations/invariants.h>
#include <isochor/transfer/grid_reset.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  GridReset<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Grid reset");
    prm.declare_entry("Steps between resets",
                      "auto",
                      Patterns::Anything(),
                      "Steps after which the deformed grid is reset and the "
                      "points are located anew, or 'auto'. 1: after each, the "
                      "Material Point Method as it is. Between resets the grid "
                      "moves with the body, as in updated Lagrangian finite "
                      "elements. 0: only by 'Smallest element quality' and, of "
                      "bodies that may come into contact, once they have come "
                      "nearer by about a face since the last reset. Then "
                      "bodies that share a field, as with another "
                      "<Quadrature/Type> than CPDI, don't feel each other, nor "
                      "a constrained boundary that they did not touch at the "
                      "last reset. auto: 1, but 0 in dynamics with another "
                      "<Quadrature/Type> than CPDI, where points that change "
                      "cells lose energy, if there is no <Grid/Stretch>. In "
                      "dynamics with another quadrature the run reports "
                      "which.");
    prm.declare_entry("Smallest element quality",
                      "0.3",
                      Patterns::Double(0, 1),
                      "The grid is also reset once the quality of a cell that "
                      "holds material falls below this: d (det A)^(2/d) / "
                      "|A|^2, A the deformation gradient of the cell since the "
                      "last reset; 1 for shapes similar to the undeformed one, "
                      "0 for flat ones. 0: only if a cell is turned inside "
                      "out.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  GridReset<dim>::parse_parameters(ParameterHandler  &prm,
                                   const std::string &why_to_reset)
  {
    prm.enter_subsection("Grid reset");
    const std::string text = prm.get("Steps between resets");
    smallest_quality       = prm.get_double("Smallest element quality");
    prm.leave_subsection();
    is_automatic = (text == "auto");
    if (is_automatic)
      {
        reason   = why_to_reset;
        interval = reason.empty() ? 0 : 1;
        return;
      }
    AssertThrow(Patterns::Integer(0).match(text),
                ExcMessage("The parameter <Grid reset/Steps between resets> "
                           "must be 'auto' or a number of steps, 0 for no "
                           "reset, not '" +
                           text + "'."));
    interval = Utilities::string_to_int(text);
  }



  template <int dim>
  std::string
  GridReset<dim>::describe() const
  {
    if (!is_automatic)
      return {};
    const std::string value = "<Grid reset/Steps between resets = auto>: ";
    return always() ? value + "the grid is reset in each step, " + reason :
                      value + "the grid is reset only where cells are "
                              "distorted";
  }



  template <int dim>
  std::string
  GridReset<dim>::why_always() const
  {
    return is_automatic ?
             "with <Grid reset/Steps between resets = auto>, which is 1 " +
               reason :
             "with <Grid reset/Steps between resets = 1>";
  }



  template <int dim>
  void
  GridReset<dim>::start(const double time)
  {
    reset_time    = time;
    n_steps_since = 0;
  }



  template <int dim>
  void
  GridReset<dim>::advance(const StepContext<dim> &step,
                          const NodalField       &unknowns,
                          const bool              is_asked_for,
                          PointArrays<dim>       &points)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    ++n_steps_since;
    bad_quality = 1;
    is_due      = is_asked_for || n_steps_since == interval;
    if (is_due)
      return;
    advance_stencils(step, unknowns, points);
    const double worst =
      Utilities::MPI::min(advance_cells(step, unknowns, points),
                          step.grid.communicator());
    is_due = !(worst > 0 && worst >= smallest_quality);
    if (is_due)
      bad_quality = worst;
  }



  template <int dim>
  std::string
  GridReset<dim>::why() const
  {
    if (always())
      return {};
    std::string cause =
      "<Grid reset/Steps between resets> = " + std::to_string(interval);
    std::string remedy = "Set it to 0 if no points have to change cells.";
    if (!(bad_quality > 0))
      {
        cause  = "a cell was turned inside out";
        remedy = "Use smaller steps, or a grid that is distorted less.";
      }
    else if (bad_quality < 1)
      {
        cause = "the quality of a cell, " + rounded(bad_quality) +
                ", has fallen below <Grid reset/Smallest element quality> = " +
                rounded(smallest_quality);
        remedy = "With 0 there it goes on moving with the body until a cell is "
                 "turned inside out.";
      }
    return "The grid, which moved with the body, was reset before, since " +
           cause + ". " + remedy;
  }



  template <int dim>
  void
  GridReset<dim>::advance_stencils(const StepContext<dim> &step,
                                   const NodalField       &unknowns,
                                   PointArrays<dim>       &points)
  {
    if (!points.has_stencils())
      return;
    const NodalUnknowns<dim> nodal(step, unknowns);
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        const Tensor<2, dim> inverse = invert(
          nodal.deformation_at(points.stencil(step.grid.geometry(), 0, q)));
        for (std::size_t i = points.stencil_start[q];
             i < points.stencil_start[q + 1];
             ++i)
          points.stencil_gradient[i] = points.stencil_gradient[i] * inverse;
      }
  }



  template <int dim>
  double
  GridReset<dim>::advance_cells(const StepContext<dim> &step,
                                const NodalField       &unknowns,
                                PointArrays<dim>       &points)
  {
    AssertDimension(points.cell_start.size(), points.cell.size() + 1);
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    const NodalUnknowns<dim>    nodal(step, unknowns);
    points.deform_cells(geometry);
    double worst = 1;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      {
        auto       &cell     = points.deformed_cell[k];
        const auto &vertices = geometry.vertex_indices(points.cell[k]);
        if (!std::all_of(vertices.begin(), vertices.end(), [&](const auto v) {
              return nodal.is_active(v);
            }))
          continue; // the points' domains miss a node of the cell
        std::array<Tensor<1, dim>, dim + 1> u;
        for (unsigned int v = 0; v <= dim; ++v)
          u[v] = nodal.increment(vertices[v]);
        const Tensor<2, dim> F = deformation_increment<dim>(
          dim + 1,
          [&](const unsigned int v) { return u[v]; },
          cell.gradients.data());
        if (!(determinant(F) > 0))
          return 0;
        const Tensor<2, dim> inverse = invert(F);
        for (unsigned int v = 0; v <= dim; ++v)
          {
            cell.corners[v] += u[v];
            cell.gradients[v] = cell.gradients[v] * inverse;
          }
        worst = std::min(worst, quality(step, k));
      }
    for (OverlappedCell<dim> &cell : points.overlapped_cells)
      for (unsigned int v = 0; v <= dim; ++v)
        cell.corners[v] +=
          nodal.increment(geometry.vertex_indices(cell.cell)[v]);
    return worst;
  }



  template <int dim>
  double
  GridReset<dim>::quality(const StepContext<dim> &step, const unsigned int k)
  {
    AssertIndexRange(k, step.points.deformed_cell.size());
    const auto &gradients = step.grid.geometry().gradients(step.points.cell[k]);
    const auto &cell      = step.points.deformed_cell[k];
    Tensor<2, dim> A;
    for (unsigned int v = 0; v <= dim; ++v)
      A += outer_product(Tensor<1, dim>(cell.corners[v]), gradients[v]);
    const double J = determinant(A);
    return J > 0 ? dim * std::pow(J, 2. / dim) / A.norm_square() : 0.;
  }



  template class GridReset<2>;
  template class GridReset<3>;
} // namespace isochor
