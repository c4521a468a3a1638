/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/adaptation/body_state.h>
#include <isochor/equations/final_state.h>
#include <isochor/equations/invariants.h>
#include <isochor/material_model/plastic_strain.h>

namespace isochor
{
  template <int dim>
  BodyState<dim>
  state_of_body(const StepContext<dim> &step, const NodalField &unknowns)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(invariants::is_consistent(step.points),
           ExcMessage("The arrays are of different points."));
    const PointArrays<dim> &points = step.points;
    BodyState<dim>          state{step.grid,
                         static_cast<unsigned int>(
                           step.kernel.materials.size()),
                         step.time,
                         {},
                         {},
                         {},
                         {},
                         {},
                         {},
                         {},
                         {}};
    const auto              plastic_strain =
      entries_of_plastic_strain<dim>(step.kernel.materials);
    std::array<double, max_history> history;
    const NodalUnknowns<dim>        nodal(step, unknowns);
    const unsigned int              n = points.n_points();
    state.cell.reserve(n);
    state.shape.reserve(n);
    state.volume.reserve(n);
    state.stress.reserve(n);
    state.material.reserve(n);
    state.shear_modulus.reserve(n);
    state.inverse_bulk_modulus.reserve(n);
    state.plastic_increment.reserve(n);
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto end =
            final_state<dim>(step, nodal, points, k, q, history.data());
          const unsigned int m = points.material[q];
          state.cell.push_back(points.cell[k]);
          state.shape.push_back(points.shape[q]);
          state.volume.push_back(end.J * points.volume[q] *
                                 points.thickness(q));
          state.stress.push_back(end.cauchy_stress);
          state.material.push_back(m);
          state.shear_modulus.push_back(
            step.kernel.materials[m]->shear_modulus());
          state.inverse_bulk_modulus.push_back(
            step.kernel.materials[m]->inverse_bulk_modulus());
          const unsigned int i = plastic_strain[m];
          state.plastic_increment.push_back(
            i == numbers::invalid_unsigned_int ?
              0. :
              history[i] -
                points
                  .history[q * static_cast<std::size_t>(points.n_history) + i]);
        }
    return state;
  }



  template BodyState<2>
  state_of_body(const StepContext<2> &, const NodalField &);
  template BodyState<3>
  state_of_body(const StepContext<3> &, const NodalField &);
} // namespace isochor
