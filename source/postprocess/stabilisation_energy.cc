/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/postprocess/stabilisation_energy.h>

#include <algorithm>
#include <istream>
#include <ostream>

namespace isochor
{
  template <int dim>
  void
  StabilisationEnergy<dim>::advance(const StepContext<dim> &step,
                                    const NodalField       &unknowns,
                                    const Tensor<1, dim>   &old_weight)
  {
    if (!step.mixed() || !step.kernel.stabilisation.projects_pressures())
      return;
    if (!any)
      {
        moment = sum(step, nullptr, old_weight).moment;
        weight = old_weight;
        any    = true;
      }
    const Tensor<1, dim> &new_weight =
      step.kernel.stabilisation.hydrostatic_acceleration;
    const auto at_end = sum(step, &unknowns, new_weight);
    work += (weight - new_weight) * (moment + at_end.moment) / 2;
    stored = at_end.stored - work;
    moment = at_end.moment;
    weight = new_weight;
  }



  template <int dim>
  typename PressureStabilisation<dim>::ProjectionEnergy
  StabilisationEnergy<dim>::sum(const StepContext<dim> &step,
                                const NodalField       *unknowns,
                                const Tensor<1, dim>   &weight)
  {
    const PointArrays<dim>     &points   = step.points;
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    std::array<double, dim + 1> sums{};
    const auto                  add = [&](const unsigned int                     cell,
                         const CellCompliance                  &compliance,
                         const std::array<Point<dim>, dim + 1> &corners) {
      Element<dim, dim + 1, dim + 1> element;
      if (unknowns != nullptr)
        NodalUnknowns<dim>(step, *unknowns)
          .gather(dim + 1, geometry.vertex_indices(cell).data(), element);
      else
        std::fill(element.pressure.begin(), element.pressure.end(), 0.);
      const auto of_cell = step.kernel.stabilisation.projection_energy(
        element, compliance, corners, weight);
      sums[dim] += of_cell.stored;
      for (unsigned int d = 0; d < dim; ++d)
        sums[d] += of_cell.moment[d];
    };
    if (points.has_stencils())
      for (const auto &cell : points.overlapped_cells)
        add(cell.cell, cell.compliance, cell.corners);
    else
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        add(points.cell[k],
            step.kernel.compliance_of_points(points,
                                             points.cell_start[k],
                                             points.cell_start[k + 1]),
            points.corners(geometry, k));
    sum_over_ranks(sums, step.grid.communicator());
    typename PressureStabilisation<dim>::ProjectionEnergy result;
    result.stored = sums[dim];
    for (unsigned int d = 0; d < dim; ++d)
      result.moment[d] = sums[d];
    return result;
  }



  template <int dim>
  void
  StabilisationEnergy<dim>::save(std::ostream &out) const
  {
    out << any << ' ' << work << ' ' << weight << ' ' << moment << ' ';
  }



  template <int dim>
  void
  StabilisationEnergy<dim>::load(std::istream &in)
  {
    in >> any >> work;
    for (Tensor<1, dim> *vector : {&weight, &moment})
      for (unsigned int d = 0; d < dim; ++d)
        in >> (*vector)[d];
  }



  template class StabilisationEnergy<2>;
  template class StabilisationEnergy<3>;
} // namespace isochor
